// The outline of a table: delimiter, header, and rows that are no parts.
#ifndef PLENUM_CATALOG_TABLES_LAYOUT_H_
#define PLENUM_CATALOG_TABLES_LAYOUT_H_

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/tables/understanding.h"

namespace plenum::catalog {

// comma, semicolon, tab, pipe.
const std::vector<std::string>& DelimiterNames();
char DelimiterOf(std::string_view name);  // one of DelimiterNames()

// The records at the front of a table, with their numbers.
struct Record {
  CsvRow cells;
  int row = 0;
};
std::vector<Record> FirstRecords(std::string_view text, char delimiter);

// Whether a heading is known, whatever kind of table it is. One that is blank or starts with a
// digit is not asked for.
using KnownHeading = std::function<bool(const std::string& heading)>;
KnownHeading HeadingsOf(const Family& family);

// Where the header is: the record with most headings that are known, the first of equals. Without
// two that are, the first of the records that have as many cells as most.
struct Header {
  std::size_t index = 0;  // of the records
  int known = 0;          // headings that are known, or that the options name
};
Header FindHeader(const KnownHeading& is_known, const std::vector<Record>& records,
                  const TableOptions& options);

// Sets reading.delimiter, or asks.
void FindDelimiter(const KnownHeading& is_known, std::string_view text, const TableOptions& options,
                   TableReading& reading);

bool IsBlank(std::string_view cell);
std::size_t CountFilled(const CsvRow& cells);

// Why a row below the header is no part: a label and sums, a title, the header again. Null: it may
// be one. Blank rows are told by IsBlank.
const char* WhyNoPart(const Family& family, const std::vector<ColumnRead>& columns,
                      const CsvRow& cells);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_LAYOUT_H_
