// The numbers of a run's rig that a parameter moves, and how much of each per unit of it.
#ifndef PLENUM_CALIBRATION_FIT_RIG_DIRECTION_H_
#define PLENUM_CALIBRATION_FIT_RIG_DIRECTION_H_

#include <cstddef>

#include "calibration/values/dataset.h"
#include "calibration/values/model_state.h"
#include "model/simulate/sensitivity.h"

namespace plenum::calibration {

// Of run `index` with the rig that RigOfRun (run_rig.h) made of that state; empty where it moves
// nothing there.
model::Direction DirectionOf(const Parameter& parameter, const Run& run, std::size_t index,
                             const ModelState& state, model::Rig& rig);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RIG_DIRECTION_H_
