// What is told of a model that no search led to: a saved one, or the base model of a record that is
// not settled.
#ifndef PLENUM_CALIBRATION_NAMES_WITHOUT_NAMES_H_
#define PLENUM_CALIBRATION_NAMES_WITHOUT_NAMES_H_

#include "calibration/judge/errors.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

// What a saved model leaves, its verdict and sentence.
void StatePrediction(const Bench& bench, const Fit& aligned, Diagnosis& diagnosis);

// What the base model leaves of a record that looks as if it held a slip of the pen: no effect is
// named before Diagnosis::slips are settled.
void StateUnsettled(const Bench& bench, const Fit& base, Diagnosis& diagnosis);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NAMES_WITHOUT_NAMES_H_
