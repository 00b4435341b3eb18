// A part measured with several bottles: a check that a wrong volume does not pass.
//
// A conductance, or what a pump delivers, is as wrong as the declared volume of the bottle behind
// it, and no reading shows that. Where runs of one recording are of several bottles, each named as
// its `specimen`, those of each bottle are diagnosed by themselves: their walls give off heat each
// in its own way. What the bottle with the most runs measures counts; the others must agree with
// it within the uncertainties of both.
#ifndef PLENUM_API_MEASURE_FITTED_BOTTLES_H_
#define PLENUM_API_MEASURE_FITTED_BOTTLES_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

struct BottleRuns {
  std::string bottle;             // "": of runs that name none
  std::vector<std::size_t> runs;  // by place in the data set and the document
};

// By number of runs, the most first. One entry or none where there is nothing to compare: no
// conductance or delivery is measured, or all runs are of one bottle.
std::vector<BottleRuns> RunsByBottle(const calibration::Dataset& dataset);

calibration::Dataset OnlyRuns(calibration::Dataset dataset, const std::vector<std::size_t>& runs);
Json OnlyRuns(Json measurement, const std::vector<std::size_t>& runs);

// { "specimen", "runs", "rest_volume_ml", "verdict", "numbers": [{ "number",
//   "pressure_kpa_gauge", "fitted", "uncertainty", "agrees" }] } of another bottle's answer against
// that of the first; reasons against the measured numbers are added to `refused`.
Json CompareBottles(const Json& first, const BottleRuns& first_runs, const Json& other,
                    const BottleRuns& other_runs, const calibration::Dataset& dataset,
                    Json& refused);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_FITTED_BOTTLES_H_
