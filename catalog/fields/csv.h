// Parts as CSV (RFC 4180, UTF-8, header row), one family per file.
//
// Columns: id, manufacturer, part_number, notes, series, orderable (true, false, empty: not known),
// aliases, offers, documents (lists, see catalog/fields/part_lists.h), then for each field F of the
// family F, F.provenance, F.source and, for a number, F.uncertainty; for families with a curve also
// `curve` (points "kPa_gauge:L/min:A" joined by ';') and .provenance, .source, .uncertainty of
// free_air and current. A column may be missing; an empty cell means no value. Without a provenance
// a number counts as third_party. A number may carry a unit of its own (catalog/units/quantity.h),
// also in a curve, and some stand as they are printed: "Cv 0.05", a body "70 x 30 x 50 mm", a curve
// "free flow 12 L/min", a current "25C". A part with offers has the price of the newest
// (catalog/fields/price.h). What WriteCsv writes is read back exactly and written again byte for
// byte.
#ifndef PLENUM_CATALOG_FIELDS_CSV_H_
#define PLENUM_CATALOG_FIELDS_CSV_H_

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/csv_table.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part.h"

namespace plenum::catalog {

// Not empty: nothing of the file may be used.
struct CsvErrors {
  std::vector<CsvError> errors;  // the first of them, at most kCsvErrorsMax
  std::size_t count = 0;         // of all
};

struct CsvParts {
  std::vector<Part> parts;
  std::vector<int> rows;  // of the parts
  std::vector<CsvError> errors;
};

// Parses and validates; every error of the file is found, not only the first. The parts come one by
// one, so that a file of any length takes little memory: after an error they are of no use.
using TakePart = std::function<void(Part part, int row)>;
CsvErrors ReadCsv(std::string_view family, std::string_view text, const TakePart& take);
// The same of rows that come from elsewhere, the header first; each with its number in the file.
// With `complete`, required numbers that a row lacks are estimated where a law gives them
// (catalog/fields/laws/estimate_missing.h).
using RowSource = std::function<void(const TakeRow& take, const TakeError& fail)>;
CsvErrors ReadRows(std::string_view family, const RowSource& rows, const TakePart& take,
                   bool complete = true);
// The same at once.
CsvParts ReadCsv(std::string_view family, std::string_view text);

// Every column of a family, in the order in which they are written.
std::vector<std::string> CsvColumns(const Family& family);
// Whether it is one of them.
bool IsCsvColumn(const Family& family, std::string_view name);

// `parts` are all of `family`.
std::string WriteCsv(std::string_view family, const std::vector<Part>& parts);
// One row of it, with the end of its line.
std::string WriteCsvRow(const Part& part);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_CSV_H_
