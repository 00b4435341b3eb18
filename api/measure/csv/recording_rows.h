// The rows of a recording as readings of runs.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_ROWS_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_ROWS_H_

#include "api/measure/csv/recording.h"

namespace plenum::api {

// Without a column of runs all rows are one run of this name.
inline constexpr std::string_view kOnlyRun = "run";

// Fills recording.runs in the units of the fields; a cell that is empty, "NaN", "-", "∞" and the
// like is a missing reading. What is wrong becomes errors of the table with their lines: the first
// of them, then one that says so.
void ReadRecordingRows(Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_ROWS_H_
