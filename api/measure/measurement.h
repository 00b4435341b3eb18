// measurement/1: measured runs of one rig, from JSON or CSV to values in SI.
//
// A run's own "rig" is laid over the shared one member by member (RFC 7386), so that it holds only
// what differs. Long CSV has one row a sample with columns run, t_s, valve (hold, inflate, deflate)
// and pressure_kpa_gauge, and the channels by name; an empty cell is a missing sample. Its rig file
// is either a rig, or a measurement whose runs, by id, hold everything but samples and schedule.
//
// measurement_csv.cc: from CSV.
#ifndef PLENUM_API_MEASURE_MEASUREMENT_H_
#define PLENUM_API_MEASURE_MEASUREMENT_H_

#include <string_view>

#include "api/json/json.h"
#include "api/json/remarks.h"
#include "api/measure/measured_run.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// Every error at once, each with its pointer; at most kSeriesErrors of one list of samples.
// `remarks`, if asked for, belong to a document without errors.
Parsed<calibration::Dataset> ParseMeasurement(const Json& document, Remarks* remarks = nullptr);

// The same document from CSV and its rig file. Errors of the table point at its line: "line 7".
Parsed<Json> MeasurementFromCsv(std::string_view csv, const Json& rig);

// Several documents as one: the first one's name, uncertainties and rig; a run of a document with
// another rig carries that rig as its own. Uncertainties that differ and run ids that recur are
// errors.
Parsed<Json> MergeMeasurements(const std::vector<Json>& documents);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MEASUREMENT_H_
