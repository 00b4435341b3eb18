#include "calibration/values/model_state.h"

namespace plenum::calibration {

double& NumberOf(ModelState& state, const Parameter& parameter) {
  switch (parameter.kind) {
    case Parameter::Kind::kMeasured:
      return state.measured[parameter.number];
    case Parameter::Kind::kEffect:
      return state.effects[parameter.effect].parameters[parameter.number];
    case Parameter::Kind::kInitialPressure:
      return state.initial_pressure_pa[parameter.run];
    case Parameter::Kind::kInitialTemperature:
      return state.initial_temperature_k[parameter.run];
    case Parameter::Kind::kClock:
      return state.clock_s[parameter.run];
    case Parameter::Kind::kPhase:
      return state.phase_rad[parameter.run];
    case Parameter::Kind::kLateness:
      return state.late_s[parameter.run][parameter.number];
    case Parameter::Kind::kInstant:
      return state.moved_s[parameter.run][parameter.number];
    case Parameter::Kind::kDeclared:
      break;
  }
  return state.factor[static_cast<std::size_t>(parameter.declared)];
}

double NumberOf(const ModelState& state, const Parameter& parameter) {
  return NumberOf(const_cast<ModelState&>(state), parameter);
}

double AmbientShift(const Run& run, const ModelState& state) {
  if (!Has(run, Declared::kAmbientPressure)) return 0.0;
  const double factor = state.factor[static_cast<std::size_t>(Declared::kAmbientPressure)];
  return (factor - 1.0) * run.ambient.pressure_pa;
}

void CopyRun(const ModelState& from, std::size_t run, ModelState& to) {
  to.initial_pressure_pa[run] = from.initial_pressure_pa[run];
  to.initial_temperature_k[run] = from.initial_temperature_k[run];
  to.clock_s[run] = from.clock_s[run];
  to.phase_rad[run] = from.phase_rad[run];
  to.late_s[run] = from.late_s[run];
  to.moved_s[run] = from.moved_s[run];
}

}  // namespace plenum::calibration
