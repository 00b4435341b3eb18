// The declared rig of a run with a model's numbers in it (forward.h).
//
// Of several chambers each is a group of its own; the first one has the run's line and valve, and
// links lead from each to those that it feeds.
#ifndef PLENUM_CALIBRATION_FIT_RIG_RUN_RIG_H_
#define PLENUM_CALIBRATION_FIT_RIG_RUN_RIG_H_

#include <cstddef>

#include "calibration/fit/recorded/driving.h"
#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"
#include "model/simulate/simulate.h"

namespace plenum::calibration {

double FactorOf(const ModelState& state, Declared number);
double BoreOf(const LinePiece& piece, const ModelState& state);

// By how much the declared compressor raises its reservoir's pressure when the run begins, Pa/s.
double PumpingRate(const Run& run);

// Of run `index` of the data set, on its own clock shifted to start at 0.
model::Rig RigOfRun(const Run& run, std::size_t index, const ModelState& state,
                    const DrivingRecords& driving);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RIG_RUN_RIG_H_
