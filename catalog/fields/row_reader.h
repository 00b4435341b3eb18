// One row of a table of parts being turned into a part.
#ifndef PLENUM_CATALOG_FIELDS_ROW_READER_H_
#define PLENUM_CATALOG_FIELDS_ROW_READER_H_

#include <string>
#include <vector>

#include "catalog/fields/csv_table.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part.h"

namespace plenum::catalog {

struct RowRead {
  Part part;
  std::vector<CsvError> errors;
};

// Reads the cells under a header of CsvColumns; numbers may be written as they are printed
// (catalog/fields/laws/printed_part.h, catalog/units/printed_flow.h). With `complete` the required
// numbers that the row lacks are estimated where a law gives them
// (catalog/fields/laws/estimate_missing.h).
RowRead ReadRow(const Family& family, const std::vector<std::string>& header, const CsvRow& cells,
                int row, bool complete);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_ROW_READER_H_
