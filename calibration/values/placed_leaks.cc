#include "calibration/values/placed_leaks.h"

#include <array>
#include <string>
#include <vector>

namespace plenum::calibration {
namespace {

struct PlacedLeak {
  model::EffectSpec spec;
  const model::EffectSpec* without;
  std::size_t chamber;
};

const std::vector<PlacedLeak>& PlacedLeaks() {
  static const std::array<std::string, kChambersMax> kIds = [] {
    std::array<std::string, kChambersMax> ids;
    for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = "leak[" + std::to_string(i + 1) + "]";
    return ids;
  }();
  static const std::vector<PlacedLeak> kLeaks = [] {
    std::vector<PlacedLeak> leaks;
    for (const model::EffectSpec* spec : model::Effects())
      for (std::size_t i = 0; IsLeak(*spec) && i < kChambersMax; ++i)
        leaks.push_back({{kIds[i], spec->law, spec->place, spec->parameters}, spec, i});
    return leaks;
  }();
  return kLeaks;
}

const PlacedLeak* Find(const model::EffectSpec& spec) {
  for (const PlacedLeak& leak : PlacedLeaks())
    if (&leak.spec == &spec) return &leak;
  return nullptr;
}

}  // namespace

bool IsLeak(const model::EffectSpec& spec) { return spec.id == "leak"; }

const model::EffectSpec& InChamber(const model::EffectSpec& leak, std::size_t chamber) {
  for (const PlacedLeak& one : PlacedLeaks())
    if (one.without == &leak && one.chamber == chamber) return one.spec;
  return leak;
}

std::optional<std::size_t> ChamberOfLeak(const model::EffectSpec& spec) {
  const PlacedLeak* leak = spec.id.starts_with("leak[") ? Find(spec) : nullptr;
  return leak ? std::optional(leak->chamber) : std::nullopt;
}

const model::EffectSpec& WithoutChamber(const model::EffectSpec& spec) {
  const PlacedLeak* leak = spec.id.starts_with("leak[") ? Find(spec) : nullptr;
  return leak ? *leak->without : spec;
}

}  // namespace plenum::calibration
