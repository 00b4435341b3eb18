#include "calibration/judge/wider_laws.h"

#include <algorithm>
#include <string_view>

#include "calibration/judge/evidence.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

bool HasNumber(const model::EffectSpec& spec, std::string_view name) {
  return std::any_of(spec.parameters.begin(), spec.parameters.end(),
                     [&](const model::ParameterSpec& parameter) { return parameter.name == name; });
}

bool Widens(const model::EffectSpec& wide, const model::EffectSpec& narrow) {
  return !FreedBy(narrow) && wide.place == narrow.place &&
         wide.parameters.size() > narrow.parameters.size() &&
         std::all_of(narrow.parameters.begin(), narrow.parameters.end(),
                     [&](const model::ParameterSpec& p) { return HasNumber(wide, p.name); });
}

double Misfit(const Fit& fit, double memory) { return BicWith(fit, memory) - Penalty(fit, memory); }

// Whether a fit comes to that misfit with one number of an effect held at a usual size, from the
// other numbers as they are and as they usually are.
bool FitsWith(const Bench& bench, const ModelState& found, const model::Effect& usual,
              std::size_t effect, std::size_t number, double misfit, double memory) {
  ModelState held = found, afresh = found;
  held.effects[effect].parameters[number] = usual.parameters[number];
  afresh.effects[effect] = usual;
  FitOptions options = bench.tight;
  options.fixed = {.kind = Parameter::Kind::kEffect, .effect = effect, .number = number};
  for (const ModelState& start : {held, afresh}) {
    const Fit fit = FitModel(bench.data, start, options);
    if (!fit.Usable() || Misfit(fit, memory) <= misfit) return true;
  }
  return false;
}

}  // namespace

const model::EffectSpec* WiderIn(const EffectSet& wide, const EffectSet& narrow) {
  for (const model::EffectSpec* wider : wide)
    for (const model::EffectSpec* spec : narrow)
      if (Widens(*wider, *spec) && Without(wide, wider) == Without(narrow, spec)) return wider;
  return nullptr;
}

bool StandsAtLimitAlone(const Bench& bench, const Contender& wide, const Contender& narrow,
                        double memory) {
  const model::EffectSpec* wider = WiderIn(wide.effects, narrow.effects);
  const double misfit = Misfit(narrow.fit, memory);
  if (!wider || Misfit(wide.fit, memory) < misfit - kSameOptimum) return false;
  const auto at = static_cast<std::size_t>(
      std::find(wide.effects.begin(), wide.effects.end(), wider) - wide.effects.begin());
  for (std::size_t number = 0; number < wider->parameters.size(); ++number) {
    const auto known = [&](const model::EffectSpec* spec) {
      return HasNumber(*spec, wider->parameters[number].name);
    };
    if (std::any_of(narrow.effects.begin(), narrow.effects.end(), known)) continue;
    const std::vector<model::Effect> usual = EffectStarts(*wider, bench.data.sizes);
    const bool refuted = std::none_of(usual.begin(), usual.end(), [&](const model::Effect& start) {
      return FitsWith(bench, wide.fit.state, start, at, number, misfit + kAccept, memory);
    });
    if (refuted) return true;
  }
  return false;
}

}  // namespace plenum::calibration
