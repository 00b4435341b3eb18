// From measured runs to a diagnosis: the base model re-fitted, the effects that it lacks, and how
// sure that is.
#ifndef PLENUM_CALIBRATION_DIAGNOSE_H_
#define PLENUM_CALIBRATION_DIAGNOSE_H_

#include "calibration/diagnosis.h"
#include "calibration/effect_search.h"

namespace plenum::calibration {

using DiagnoseOptions = SearchOptions;

// Cancelled or cut short: the best so far, with kUndecided. Without runs to hold out, the finalists
// are fitted again without each run in turn and judged by the runs left out.
Diagnosis Diagnose(const Dataset& dataset, const DiagnoseOptions& options);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_DIAGNOSE_H_
