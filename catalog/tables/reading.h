// Any table of parts, as people have it: which encoding and delimiter it is in, where its header
// is, what its columns mean. What the table leaves open is a question, never guessed; the options
// answer it.
#ifndef PLENUM_CATALOG_TABLES_READING_H_
#define PLENUM_CATALOG_TABLES_READING_H_

#include <string_view>

#include "catalog/tables/understanding.h"

namespace plenum::catalog {

// Looks at the whole table once; catalog/tables/part_rows.h then reads its rows.
TableReading ReadTable(std::string_view family, std::string_view bytes,
                       const TableOptions& options = {});

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_READING_H_
