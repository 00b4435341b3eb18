// The rows of a table in the columns and units of the catalogue.
#ifndef PLENUM_CATALOG_TABLES_PART_ROWS_H_
#define PLENUM_CATALOG_TABLES_PART_ROWS_H_

#include <string>
#include <string_view>

#include "catalog/fields/csv.h"
#include "catalog/tables/understanding.h"

namespace plenum::catalog {

// The rows of a table that leaves no question open, header first, for ReadRows. `reading` and
// `bytes` must outlive what is made of them.
RowSource RowsOf(const TableReading& reading, std::string_view bytes);

// The heading that stands for a column of CsvColumns, or its own name.
std::string HeadingOf(const TableReading& reading, std::string_view column);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_PART_ROWS_H_
