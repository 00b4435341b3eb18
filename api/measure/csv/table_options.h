// The answers of a person to what a table of a recording leaves open, out of a document.
#ifndef PLENUM_API_MEASURE_CSV_TABLE_OPTIONS_H_
#define PLENUM_API_MEASURE_CSV_TABLE_OPTIONS_H_

#include <string>

#include "api/json/reader.h"
#include "catalog/tables/understanding.h"

namespace plenum::api {

// { "encoding", "delimiter", "decimal", "header_row", "columns": { HEADING: "field [unit]" } }, all
// optional. What `options` already holds is kept: those that are given with the table go first.
void ReadTableOptions(Reader& reader, catalog::TableOptions& options);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_TABLE_OPTIONS_H_
