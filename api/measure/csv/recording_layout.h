// Encoding, delimiter, headings, units and decimal mark of a recording.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_LAYOUT_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_LAYOUT_H_

#include <string_view>
#include <vector>

#include "api/measure/csv/recording.h"

namespace plenum::api {

// Those of the catalogue's tables, and blanks.
const std::vector<std::string>& RecordingDelimiters();

// Fills recording.table but for its rows, and recording.scales. What is open becomes a question:
//   an unknown heading near the name of a field, a time or pressure without a unit, a unit that the
//   field cannot have, two columns for one field, no time, no pressure, decimal marks.
// A column of no field is left out. Lines above the headings and lines that begin with #, % or //
// are no readings; a first block of such lines may hold the headings.
void ReadRecordingLayout(std::string_view bytes, const catalog::TableOptions& options,
                         Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_LAYOUT_H_
