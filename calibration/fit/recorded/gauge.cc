#include "calibration/fit/recorded/gauge.h"

namespace plenum::calibration {

void TakeGauge(const Run& run, const ModelState& state, std::span<const Parameter> parameters,
               const std::function<std::vector<double>*(std::size_t)>& slope,
               std::vector<double>& pressure_pa) {
  if (!Has(run, Declared::kSensorZero)) return;
  const double ambient_pa = run.ambient.pressure_pa;
  const double gain = state.factor[static_cast<std::size_t>(Declared::kSensorGain)];
  const double zero = state.factor[static_cast<std::size_t>(Declared::kSensorZero)];
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    std::vector<double>& of_parameter = *slope(j);
    for (double& pa : of_parameter) pa *= gain;
    if (parameters[j] == Parameter{.declared = Declared::kSensorZero})
      of_parameter.assign(pressure_pa.size(), kSensorZeroPa);
    if (!(parameters[j] == Parameter{.declared = Declared::kSensorGain})) continue;
    of_parameter = pressure_pa;
    for (double& pa : of_parameter) pa -= ambient_pa;
  }
  for (double& pa : pressure_pa)
    pa = ambient_pa + gain * (pa - ambient_pa) + (zero - 1.0) * kSensorZeroPa;
}

}  // namespace plenum::calibration
