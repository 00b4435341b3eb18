// What was understood of the table of a recording, as a document.
#ifndef PLENUM_API_MEASURE_CSV_UNDERSTOOD_H_
#define PLENUM_API_MEASURE_CSV_UNDERSTOOD_H_

#include "api/json/json.h"
#include "api/measure/csv/recording.h"

namespace plenum::api {

// { encoding, delimiter, decimal, heading_line, units_line, ambient_kpa_abs, columns: [ { key,
// heading, field, unit, factor, offset, meaning, first } ], runs: [ { id, readings, missing,
// begin_s, end_s } ], notes }. A reading of the field is factor · cell + offset; null: no number.
// ambient_kpa_abs is null where no pressure was absolute.
Json UnderstoodOf(const Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_UNDERSTOOD_H_
