// measurement/1: measured runs of one rig, from JSON to values in SI. CSV becomes such a document
// first (api/measure/csv/measurement_csv.h).
//
// A run's own "rig" is laid over the shared one member by member (RFC 7386), so that it holds only
// what differs.
#ifndef PLENUM_API_MEASURE_MEASUREMENT_H_
#define PLENUM_API_MEASURE_MEASUREMENT_H_

#include <string_view>

#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/measure/measured_run.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// Of a bottle's volume of which nothing is said, one standard deviation.
inline constexpr double kAssumedVolumeShare = 0.02;

// Every error at once, each with its pointer; at most kSeriesErrors of one list of samples.
// `remarks`, if asked for, belong to a document without errors.
Parsed<calibration::Dataset> ParseMeasurement(const Json& document, Remarks* remarks = nullptr);

// Several documents as one: the first one's name, uncertainties and rig; a run of a document with
// another rig carries that rig as its own. Uncertainties that differ and run ids that recur are
// errors.
Parsed<Json> MergeMeasurements(const std::vector<Json>& documents);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MEASUREMENT_H_
