#include "calibration/fit/rig/rig_effects.h"

#include <algorithm>

#include "calibration/values/effect_sets.h"

namespace plenum::calibration {
namespace {

bool ActsOn(const model::EffectSpec& spec, const Several& several, std::size_t gauge,
            std::size_t group) {
  using enum model::EffectPlace;
  if (several.empty()) return true;
  if (const std::optional<std::size_t> chamber = ChamberOfLeak(spec))
    return group == several.first() + *chamber;
  switch (spec.place) {
    case kValve:
    case kLine:
    case kSupply:
      return group == 0;
    case kSensor:
      return group == gauge;
    case kChamber:
      return group == several.first();
    case kVolume:
    case kEnergy:
      break;
  }
  return spec.id == "dead_volume" ? group == several.first() : group >= several.first();
}

}  // namespace

std::vector<model::Effect> EffectsOn(const std::vector<model::Effect>& effects, const Run& run,
                                     std::size_t group) {
  std::vector<model::Effect> on;
  for (const model::Effect& effect : effects)
    if (ActsOn(*effect.spec, run.several, run.several.gauge, group))
      on.push_back({&WithoutChamber(*effect.spec), effect.parameters});
  return on;
}

std::vector<const double*> NumbersOfEffect(const std::vector<model::Effect>& effects,
                                           std::size_t effect, std::size_t number, const Run& run,
                                           const model::Rig& rig) {
  std::vector<const double*> numbers;
  for (std::size_t g = 0; g < rig.groups.size(); ++g) {
    if (!ActsOn(*effects[effect].spec, run.several, run.several.gauge, g)) continue;
    const model::EffectSpec* spec = &WithoutChamber(*effects[effect].spec);
    for (const model::Effect& one : rig.groups[g].effects)
      if (one.spec == spec) numbers.push_back(&one.parameters[number]);
  }
  return numbers;
}

double* NumberNamed(model::Effect& effect, std::string_view name) {
  for (std::size_t i = 0; i < effect.parameters.size(); ++i)
    if (effect.spec->parameters[i].name == name) return &effect.parameters[i];
  return nullptr;
}

}  // namespace plenum::calibration
