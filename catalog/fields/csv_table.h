// Comma-separated tables as such (RFC 4180, UTF-8), without knowing what the columns mean.
#ifndef PLENUM_CATALOG_FIELDS_CSV_TABLE_H_
#define PLENUM_CATALOG_FIELDS_CSV_TABLE_H_

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

inline constexpr std::size_t kCsvColumnsMax = 1'000;
inline constexpr std::size_t kCsvCellBytesMax = 64 << 10;
inline constexpr std::size_t kCsvErrorsMax = 1'000;

struct CsvError {
  int row = 0;  // counts records; 1 is the header
  std::string column;
  std::string detail;
  bool operator==(const CsvError&) const = default;
};

using CsvRow = std::vector<std::string>;

struct CsvTable {
  std::vector<CsvRow> rows;
  std::vector<CsvError> errors;
};

// Rows end in LF or CRLF; a byte-order mark and empty lines at the end are dropped. Text inside
// quotes is kept as it is. What is beyond these limits is an error and left out.
CsvTable ParseTable(std::string_view text);

// The same row by row, 1 the first: takes no more memory than one row.
using TakeRow = std::function<void(CsvRow cells, int row)>;
using TakeError = std::function<void(CsvError error)>;
void ForEachRow(std::string_view text, const TakeRow& take, const TakeError& fail,
                char delimiter = ',');

std::string FormatRow(const CsvRow& cells);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_CSV_TABLE_H_
