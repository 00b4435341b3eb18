// From measured runs to a diagnosis: the base model re-fitted, the effects that it lacks, and how
// sure that is.
#ifndef PLENUM_CALIBRATION_DIAGNOSE_H_
#define PLENUM_CALIBRATION_DIAGNOSE_H_

#include <limits>
#include <utility>
#include <vector>

#include "calibration/search/effect_search.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// `cancelled` may be asked by several threads at once.
struct DiagnoseOptions : SearchOptions {
  double time_limit_s = std::numeric_limits<double>::infinity();
};

// Cancelled or out of time before the verdict: kUndecided, no effects and estimates, the errors
// and candidates so far, the residual untested. Later, the verdict stands, and a warning names what
// was left undone (a learned term, the next experiment, held-out errors of candidates). Either way
// within a fraction of a second. Without runs to hold out, the finalists are fitted again without
// each run in turn and judged by the runs left out.
Diagnosis Diagnose(const Dataset& dataset, const DiagnoseOptions& options);

// What a known model makes of the runs: its effects and the factors on declared numbers stand; only
// what no other run can tell, each run's clock and an initial pressure that was not declared, is
// fitted. `before` and `after` are both its errors, `declared` those of the declared base model.
// kAdequate where only noise is left, else kUnexplained.
struct KnownModel {
  std::vector<model::Effect> effects;
  std::vector<std::pair<Declared, double>> factors;
};
Diagnosis Predict(const Dataset& dataset, const KnownModel& known, const DiagnoseOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_DIAGNOSE_H_
