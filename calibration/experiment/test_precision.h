// How precise a test of a part will be, before it is made.
//
// The runs are simulated with what the rig declares, and the Fisher information of their readings
// for the measured numbers, the declared numbers of known uncertainty and the effects beside them
// gives the covariance of all (calibration/fit/fit.h, Covariance), with the room's temperature as a
// diagnosis of the recording will state it. The noise of the readings is white. Valid to first
// order: for numbers near those that the rig declares.
#ifndef PLENUM_CALIBRATION_EXPERIMENT_TEST_PRECISION_H_
#define PLENUM_CALIBRATION_EXPERIMENT_TEST_PRECISION_H_

#include <optional>
#include <vector>

#include "calibration/values/dataset.h"
#include "calibration/values/diagnosis.h"

namespace plenum::calibration {

struct TestPrecision {
  std::vector<MeasuredEstimate> numbers;  // with `deviation`: one standard deviation
  std::vector<double> from_noise;         // the part of it that is left of a rig known exactly
};

// Of runs that have schedule and sample times, and no readings. None where a run cannot be
// simulated.
std::optional<TestPrecision> PrecisionOf(Dataset dataset, const std::vector<model::Effect>& effects,
                                         double noise_pa);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_EXPERIMENT_TEST_PRECISION_H_
