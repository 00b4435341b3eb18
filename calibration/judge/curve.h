// The curve of a stated model in one run, as the sensors should have read it, and its error: what a
// diagnosis says of the model, made again from its numbers alone.
#ifndef PLENUM_CALIBRATION_JUDGE_CURVE_H_
#define PLENUM_CALIBRATION_JUDGE_CURVE_H_

#include <functional>
#include <string>

#include "calibration/judge/errors.h"
#include "calibration/values/model_state.h"

namespace plenum::calibration {

struct Curve {
  model::SimulateStatus status = model::SimulateStatus::kNotRun;
  std::string detail;  // for any status but kDone
  Reading reading;     // at the run's sample times; channels that the run itself has
  Squares error;       // measured − model, Pa, without the readings left out
};

// `cancelled` may be empty.
Curve CurveOf(const ForwardModel& forward, const StatedModel& model, std::size_t run,
              const StatedRun& how, const std::function<bool()>& cancelled);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_JUDGE_CURVE_H_
