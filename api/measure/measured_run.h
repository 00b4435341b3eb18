// One run of a measurement/1 document: schedule, samples, channels (contract.md).
#ifndef PLENUM_API_MEASURE_MEASURED_RUN_H_
#define PLENUM_API_MEASURE_MEASURED_RUN_H_

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "api/json/reader.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

inline constexpr std::size_t kSeriesErrors = 5;  // at most, of one list of samples

// The run at `element` on the document's `shared` rig, in SI and absolute pressures. Its id joins
// `ids`, in which it must be new. What the readings cannot be (too few, constant, far above all
// that could cause them) and what the rig cannot do is an error. Numbers of parts that the run
// measures join `measured`, unless an earlier run did so; runs of the gauges of other chambers join
// `of_gauges`.
calibration::Run ReadRun(const Element& element, const Json& shared, std::set<std::string>& ids,
                         calibration::Dataset& dataset, std::vector<calibration::Run>& of_gauges,
                         Errors& errors);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_MEASURED_RUN_H_
