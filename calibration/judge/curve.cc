#include "calibration/judge/curve.h"

#include <algorithm>
#include <utility>

namespace plenum::calibration {

Curve CurveOf(const ForwardModel& forward, const StatedModel& model, std::size_t run,
              const StatedRun& how, const std::function<bool()>& cancelled) {
  Prediction prediction = forward.Predict(run, OfRun(model, run), {},
                                          {.relative_tolerance = how.relative_tolerance,
                                           .cancelled = cancelled,
                                           .recorded_alone = true});
  Curve curve{prediction.status, prediction.detail, std::move(prediction.reading), {}};
  if (curve.status != model::SimulateStatus::kDone) return curve;
  const std::vector<double>& measured_pa = forward.dataset().runs[run].pressure_pa;
  for (std::size_t i = 0; i < measured_pa.size(); ++i)
    if (!std::binary_search(how.left_out.begin(), how.left_out.end(), i))
      curve.error.Add(measured_pa[i] - curve.reading.pressure_pa[i]);
  return curve;
}

}  // namespace plenum::calibration
