// The models of a diagnosis as numbers, in its answer and back: "effects" and "factors" stand with
// "declared", "before", "after" and "learned", what each run has of its own under "runs":
//   { "id": "r1", "held_out": false, "relative_tolerance": 1e-8, "left_out": [ 17 ],
//     "before": { "initial_pressure_kpa_gauge", "initial_temperature_k", "clock_s" }, "after": … }
// and where a model has them "phase_rad", "late_s" (by command), "valve_s" (the instants of the
// commands, where they are not known exactly), "factors" (those of a run held out
// whose line is of no other run) and "fitted_alone" (what was fitted to a run held out).
#ifndef PLENUM_API_MEASURE_STATED_DOCUMENT_H_
#define PLENUM_API_MEASURE_STATED_DOCUMENT_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::api {

inline constexpr const char* kModelsOfADiagnosis[] = {"declared", "before", "after", "learned"};

// Puts them into a rendered answer. A diagnosis that states no models gets empty lists.
void AddStatedModels(const calibration::Diagnosis& diagnosis, const calibration::Dataset& dataset,
                     Json& answer);

struct StatedAnswer {
  calibration::StatedModel model;
  std::vector<calibration::StatedRun> runs;
};

// One of the models of an answer on the data set. Errors point into the answer.
Parsed<StatedAnswer> ParseStatedModel(const Json& answer, const std::string& model,
                                      const calibration::Dataset& dataset);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_STATED_DOCUMENT_H_
