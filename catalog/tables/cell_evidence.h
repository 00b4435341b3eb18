// What the cells of a table show: which mark stands before decimals, whether units are missing, and
// which rows are no parts.
#ifndef PLENUM_CATALOG_TABLES_CELL_EVIDENCE_H_
#define PLENUM_CATALOG_TABLES_CELL_EVIDENCE_H_

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/tables/understanding.h"

namespace plenum::catalog {

// Of the numbers of a column, the first cell that shows it; empty: none does.
struct ColumnEvidence {
  std::string point, comma;                             // a decimal point, a decimal comma
  std::string either_comma, either_point;               // 1,234 and 1.234: decimals or thousands
  std::string bare;                                     // a number without a unit
  double bare_least = HUGE_VAL, bare_most = -HUGE_VAL;  // of all of them that leave no doubt
};

// Notes what one cell shows, if it starts with a number.
void NoteCell(const std::string& cell, ColumnEvidence& evidence);

// Goes over all rows: fills samples and left_out of the reading.
std::vector<ColumnEvidence> LookAtCells(const Family& family, std::string_view text,
                                        TableReading& reading);

// Sets the decimal mark of each column, or asks:
//   a column that shows one has it; one that shows both is asked for;
//   a column with nothing but 1,234 is asked for; with nothing but 1.234 it has a decimal point, as
//   everywhere in the program, unless the table looks like one with decimal commas: it has them in
//   another column, or is not delimited by commas and shows no decimal point anywhere.
void FindDecimals(const std::vector<ColumnEvidence>& evidence, const TableOptions& options,
                  TableReading& reading);

// Asks for the unit of bare numbers whose heading names a field with a unit in other words. Of
// voltages it is the only one, if there is one, with which all are in the range of the field.
void AskForUnits(const Family& family, const std::vector<ColumnEvidence>& evidence,
                 TableReading& reading);

// Asks for the currency of bare prices that no column gives, and whether the price of a tube is
// that of a metre.
void AskForCurrency(const Family& family, const std::vector<ColumnEvidence>& evidence,
                    TableReading& reading);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_CELL_EVIDENCE_H_
