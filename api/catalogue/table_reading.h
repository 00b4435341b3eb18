// Tables of parts as people have them: the answers to their questions out of a request, what was
// understood into an answer.
#ifndef PLENUM_API_CATALOGUE_TABLE_READING_H_
#define PLENUM_API_CATALOGUE_TABLE_READING_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/tables/encoding.h"
#include "catalog/tables/layout.h"
#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"

namespace plenum::api {

// Adds "HEADING=COLUMN [UNIT]" and "COLUMN=VALUE" to the options; complains of others.
void ReadTableColumns(const std::vector<std::string>& given, catalog::TableOptions& options,
                      Errors& errors);
void ReadTableSet(const std::vector<std::string>& given, catalog::TableOptions& options,
                  Errors& errors);

// Null where nothing was understood: no text, row 0.
inline Json TextOrNull(const std::string& text) {
  return text.empty() ? Json(nullptr) : Json(text);
}
inline Json RowOrNull(int row) { return row == 0 ? Json(nullptr) : Json(row); }

// Questions and errors of a reading; pointers are /option, and /column/HEADING of a column.
Errors ErrorsOf(const catalog::TableReading& reading);

// [ { option, heading, question, answers } ].
Json RenderQuestions(const catalog::TableReading& reading);

// { as_exported, encoding, delimiter, header_row, units_row, ids, columns: [ { key, heading,
// targets, decimal, samples } ], set, left_out: [ { row, why } ], left_out_count }.
Json RenderUnderstood(const catalog::TableReading& reading);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_TABLE_READING_H_
