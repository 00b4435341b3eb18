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
    case Parameter::Kind::kSharedInstant:
      return state.shared_sigmas[parameter.number];
    case Parameter::Kind::kDeclared:
      break;
  }
  const auto at = static_cast<std::size_t>(parameter.declared);
  if (OfEachSpecimen(state, parameter.declared))
    return state.specimen_factor[at][parameter.specimen];
  return state.factor[at];
}

double NumberOf(const ModelState& state, const Parameter& parameter) {
  return NumberOf(const_cast<ModelState&>(state), parameter);
}

bool OfEachSpecimen(const ModelState& state, Declared number) {
  const auto at = static_cast<std::size_t>(number);
  return at < state.specimen_factor.size() && !state.specimen_factor[at].empty();
}

Factors FactorsOf(const Run& run, const ModelState& state) {
  return FactorsOf(run, state, run.specimen);
}

Factors FactorsOf(const Run& run, const ModelState& state, std::size_t specimen) {
  Factors factors = state.factor;
  if (run.several.empty()) specimen = run.specimen;
  for (std::size_t k = 0; k < state.specimen_factor.size(); ++k)
    if (!state.specimen_factor[k].empty()) factors[k] = state.specimen_factor[k][specimen];
  return factors;
}

bool Concerns(const Parameter& parameter, const Run& run, const ModelState& state) {
  return parameter.specimen == run.specimen || !run.several.empty() ||
         !OfEachSpecimen(state, parameter.declared);
}

void SetFactor(Declared number, double factor, ModelState& state) {
  const auto at = static_cast<std::size_t>(number);
  state.factor[at] = factor;
  if (!OfEachSpecimen(state, number)) return;
  std::vector<double>& of_specimens = state.specimen_factor[at];
  of_specimens.assign(of_specimens.size(), factor);
}

double MovedBy(const Run& run, std::size_t index, std::size_t command, const ModelState& state) {
  const std::vector<double>& moved_s = state.moved_s[index];
  double by_s = command < moved_s.size() ? moved_s[command] : 0.0;
  if (SharesInstant(run, command))
    by_s += state.shared_sigmas[static_cast<std::size_t>(run.valve[command].state)] *
            InstantUncertainty(run, command);
  return by_s;
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
