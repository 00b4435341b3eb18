// What the columns of a table mean, and the questions where that is open.
#ifndef PLENUM_CATALOG_TABLES_COLUMNS_H_
#define PLENUM_CATALOG_TABLES_COLUMNS_H_

#include "catalog/tables/understanding.h"

namespace plenum::catalog {

// Of a column that has no heading of its own: "#1".
std::string NumberKey(std::size_t index);
// What the options say of a column; null: nothing.
const std::string* GivenFor(const ColumnRead& column, std::size_t index,
                            const TableOptions& options);

// Headings that may mean several fields, or none, wait until the cells were seen: a column without
// cells needs no answer.
struct OpenColumn {
  std::size_t index = 0;  // of reading.columns
  HeadingMatch match;
};

// Fills reading.columns from the header, with the units of a row below it where that has nothing
// else; sets reading.units_row.
std::vector<OpenColumn> MapColumns(const Family& family, const CsvRow& header, const CsvRow& below,
                                   const TableOptions& options, TableReading& reading);

// Asks what the open columns are that have cells, and where two columns give one field.
void AskForColumns(const Family& family, const std::vector<OpenColumn>& open,
                   const TableOptions& options, TableReading& reading);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_COLUMNS_H_
