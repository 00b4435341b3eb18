// Readings of a gauge whose zero and gain are known to an accuracy (Sensor of dataset.h).
#ifndef PLENUM_CALIBRATION_FIT_RECORDED_GAUGE_H_
#define PLENUM_CALIBRATION_FIT_RECORDED_GAUGE_H_

#include <functional>
#include <span>
#include <vector>

#include "calibration/values/model_state.h"

namespace plenum::calibration {

// From what an exact gauge would have read, absolute, to the readings of the run's; `slope` is the
// derivative to parameter number j, empty where it is 0. Nothing changes where no accuracy is
// stated.
void TakeGauge(const Run& run, const ModelState& state, std::span<const Parameter> parameters,
               const std::function<std::vector<double>*(std::size_t)>& slope,
               std::vector<double>& pressure_pa);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RECORDED_GAUGE_H_
