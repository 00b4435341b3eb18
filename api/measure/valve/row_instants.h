// Commands of a valve that were read off the rows of a log.
//
// Where every command of a measurement stands at a time of its readings, and none says how well it
// is known, the instants may be known to a row only, as those of a CSV are
// (csv/measurement_csv.cc): a command a row late is taken for effects that are none. So where a
// diagnosis with exact instants leaves structure, or needs kManyCauses causes or more, the same
// measurement with instants known to a row is diagnosed, too, and stands where it leaves only noise
// with fewer causes; with one at most, where nothing could be named. "uncertainty_s": 0 says that
// an instant is exact.
#ifndef PLENUM_API_MEASURE_VALVE_ROW_INSTANTS_H_
#define PLENUM_API_MEASURE_VALVE_ROW_INSTANTS_H_

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

inline constexpr std::size_t kManyCauses = 3;

// One standard deviation of an instant that is told by a row `row_s` after the one before: that,
// from the later row, of what lies anywhere between the two.
double UncertaintyOfRow(double row_s);

// Whether every command that may be a row late stands at a reading and says nothing of its instant.
bool AreOfRows(const Json& measurement, const calibration::Dataset& dataset);

// Says of these commands, in the document and in its data set, that they are known to a row.
void SayOfRows(Json& measurement, calibration::Dataset& dataset);

bool AsksForRows(const calibration::Diagnosis& exact);
bool IsBetterOfRows(const calibration::Diagnosis& exact, const calibration::Diagnosis& of_rows);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_VALVE_ROW_INSTANTS_H_
