// Comma-separated tables as such (RFC 4180, UTF-8), without knowing what the columns mean.
#ifndef PLENUM_CATALOG_CSV_TABLE_H_
#define PLENUM_CATALOG_CSV_TABLE_H_

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/csv.h"

namespace plenum::catalog {

using CsvRow = std::vector<std::string>;

struct CsvTable {
  std::vector<CsvRow> rows;
  std::vector<CsvError> errors;
};

// Rows end in LF or CRLF; a byte-order mark and empty lines at the end are dropped. Text inside
// quotes is kept as it is. What is beyond the limits of csv.h is an error and left out.
CsvTable ParseTable(std::string_view text);

// The same row by row, 1 the first: takes no more memory than one row.
using TakeRow = std::function<void(CsvRow cells, int row)>;
using TakeError = std::function<void(CsvError error)>;
void ForEachRow(std::string_view text, const TakeRow& take, const TakeError& fail);

std::string FormatRow(const CsvRow& cells);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_CSV_TABLE_H_
