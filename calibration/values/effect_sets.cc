#include "calibration/values/effect_sets.h"

#include <algorithm>

#include "model/effects/registry.h"

namespace plenum::calibration {
namespace {

std::size_t Place(const model::EffectSpec* spec) {
  const auto all = model::Effects();
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), spec) - all.begin());
}

bool Exercised(const model::EffectSpec& spec, const std::vector<Run>& runs) {
  using enum model::EffectPlace;
  const auto opens = [](const Run& run) {
    return std::any_of(run.valve.begin(), run.valve.end(), [](const model::ValveCommand& command) {
      return command.state != model::ValveState::kHold;
    });
  };
  const bool fed = spec.place == kValve || spec.place == kLine || spec.place == kSupply;
  return !fed || std::any_of(runs.begin(), runs.end(), opens);
}

}  // namespace

bool Precedes(const model::EffectSpec* a, const model::EffectSpec* b) {
  return Place(a) < Place(b);
}

EffectSet With(EffectSet set, const model::EffectSpec* in) {
  set.insert(std::upper_bound(set.begin(), set.end(), in, Precedes), in);
  return set;
}

EffectSet Without(EffectSet set, const model::EffectSpec* out) {
  std::erase(set, out);
  return set;
}

bool HoldsId(const EffectSet& set, std::string_view id) {
  return std::any_of(set.begin(), set.end(),
                     [&](const model::EffectSpec* spec) { return spec->id == id; });
}

bool IsLearned(const model::EffectSpec& spec) { return spec.id.starts_with("learned"); }

EffectSet NamedEffects(const std::vector<Run>& runs) {
  EffectSet named;
  for (const model::EffectSpec* spec : model::Effects())
    if (!IsLearned(*spec) && Exercised(*spec, runs)) named.push_back(spec);
  return named;
}

bool ActsInTime(const model::EffectSpec& spec) {
  for (const std::string_view id : {"valve_delay", "valve_ramp", "sensor_lag", "line_dynamics"})
    if (spec.id == id) return true;
  return false;
}

bool Rings(const model::EffectSpec& spec) { return spec.id == "line_dynamics"; }

bool AnyRings(const EffectSet& set) {
  return std::any_of(set.begin(), set.end(),
                     [](const model::EffectSpec* spec) { return Rings(*spec); });
}

}  // namespace plenum::calibration
