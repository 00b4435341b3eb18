#include "calibration/values/effect_sets.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "calibration/values/crossing.h"
#include "model/effects/registry.h"

namespace plenum::calibration {
namespace {

constexpr double kEvacuated = 0.5;  // of the ambient pressure

using NumberSpecs = std::array<model::EffectSpec, kDeclaredCount>;

model::EffectPlace PlaceOf(Declared number) {
  switch (number) {
    case Declared::kSourcePressure:
    case Declared::kReservoirVolume:
      return model::EffectPlace::kSupply;
    case Declared::kSonicConductance:
    case Declared::kCriticalRatio:
    case Declared::kTubeInnerDiameter:
      return model::EffectPlace::kLine;
    case Declared::kAmbientPressure:
      return model::EffectPlace::kChamber;
    case Declared::kSensorZero:
    case Declared::kSensorGain:
      return model::EffectPlace::kSensor;
    case Declared::kRestVolume:
    case Declared::kExpansionRatio:
    case Declared::kOperatingPressure:
      break;
  }
  return model::EffectPlace::kVolume;
}

const NumberSpecs& Numbers() {
  static const std::array<std::string, kDeclaredCount> kIds = [] {
    std::array<std::string, kDeclaredCount> ids;
    for (std::size_t k = 0; k < ids.size(); ++k)
      ids[k] = "number:" + std::string(Name(static_cast<Declared>(k)));
    return ids;
  }();
  static const NumberSpecs kSpecs = [] {
    NumberSpecs specs;
    for (std::size_t k = 0; k < specs.size(); ++k)
      specs[k] = {kIds[k], {}, PlaceOf(static_cast<Declared>(k)), {}};
    return specs;
  }();
  return kSpecs;
}

// Of the actuator's own numbers, by chamber.
using ChamberSpecs = std::array<std::array<model::EffectSpec, kChambersMax>, kOfActuator>;

const ChamberSpecs& NumbersOfChambers() {
  static const std::array<std::array<std::string, kChambersMax>, kOfActuator> kIds = [] {
    std::array<std::array<std::string, kChambersMax>, kOfActuator> ids;
    for (std::size_t k = 0; k < ids.size(); ++k)
      for (std::size_t i = 0; i < kChambersMax; ++i)
        ids[k][i] = std::string(Numbers()[k].id) + "[" + std::to_string(i + 1) + "]";
    return ids;
  }();
  static const ChamberSpecs kSpecs = [] {
    ChamberSpecs specs;
    for (std::size_t k = 0; k < specs.size(); ++k)
      for (std::size_t i = 0; i < kChambersMax; ++i)
        specs[k][i] = {kIds[k][i], {}, PlaceOf(static_cast<Declared>(k)), {}};
    return specs;
  }();
  return kSpecs;
}

std::size_t Place(const model::EffectSpec* spec) {
  const auto all = model::Effects();
  if (const std::optional<Declared> number = FreedBy(*spec))
    return all.size() + static_cast<std::size_t>(*number);
  const model::EffectSpec* known = &WithoutChamber(*spec);
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), known) - all.begin());
}

// Whether a factor on the critical ratios is one on anything: not where all are 0.
bool HasRatio(const Run& run) {
  return std::any_of(run.line.begin(), run.line.end(), [](const LinePiece& piece) {
    return !piece.tube && (piece.fill.critical_ratio > 0.0 || piece.exhaust.critical_ratio > 0.0);
  });
}

// Only then does what comes out of walls and pockets show.
bool WasEvacuated(const Run& run) {
  return std::any_of(run.pressure_pa.begin(), run.pressure_pa.end(),
                     [&](double pa) { return pa < kEvacuated * run.ambient.pressure_pa; });
}

// Whether no command that turns the valve has an instant of which anything is known: all may come
// as late as they like.
bool AnyTimeWillDo(const Run& run) {
  model::ValveState state = model::ValveState::kHold;
  for (std::size_t k = 0; k < run.valve.size(); ++k)
    if (std::exchange(state, run.valve[k].state) != run.valve[k].state &&
        InstantUncertainty(run, k) != kUnknown)
      return false;
  return true;
}

// Whether the volume is the same at any pressure: there effects on its law do nothing.
bool HasOneVolume(const model::Chamber& chamber) {
  return chamber.expansion_ratio == 1.0 && chamber.volume_curve.empty();
}
bool IsRigid(const Run& run) {
  return run.blocked || (HasOneVolume(run.chamber) &&
                         std::all_of(run.several.all.begin(), run.several.all.end(),
                                     [](const auto& one) { return HasOneVolume(one.chamber); }));
}

bool ActsOnVolumeLaw(const model::EffectSpec& spec) {
  for (const std::string_view id : {"inertia", "creep", "hysteresis", "nonlinear_compliance"})
    if (spec.id == id) return true;
  return false;
}

bool Opens(const Run& run) {
  return std::any_of(run.valve.begin(), run.valve.end(), [](const model::ValveCommand& command) {
    return command.state != model::ValveState::kHold;
  });
}

// Whether what the line conducts shows: what a flow controller lets in passes whatever it is.
bool ShowsConductance(const Run& run) {
  if (run.supply != Supply::kFlow || RecordsNode(run)) return Opens(run);
  return std::any_of(run.valve.begin(), run.valve.end(), [](const model::ValveCommand& command) {
    return command.state == model::ValveState::kDeflate;
  });
}

bool IsOfConductance(const model::EffectSpec& spec) {
  for (const std::string_view id :
       {"valve_ramp", "directional_conductance", "cracking_pressure", "exhaust_restriction",
        "number:sonic_conductance", "number:critical_ratio"})
    if (spec.id == id) return true;
  return false;
}

bool Exercised(const model::EffectSpec& spec, const std::vector<Run>& runs) {
  using enum model::EffectPlace;
  if (spec.id == "outgassing") return std::any_of(runs.begin(), runs.end(), WasEvacuated);
  if (spec.id == "valve_delay" && std::all_of(runs.begin(), runs.end(), AnyTimeWillDo))
    return false;
  if (ActsOnVolumeLaw(spec) && std::all_of(runs.begin(), runs.end(), IsRigid)) return false;
  const bool fed = spec.place == kValve || spec.place == kLine || spec.place == kSupply;
  return !fed ||
         std::any_of(runs.begin(), runs.end(), IsOfConductance(spec) ? ShowsConductance : Opens);
}

}  // namespace

const model::EffectSpec& Freeing(Declared number) {
  return Numbers()[static_cast<std::size_t>(number)];
}

const model::EffectSpec& Freeing(Declared number, std::size_t chamber) {
  return NumbersOfChambers()[static_cast<std::size_t>(number)][chamber];
}

std::optional<Declared> FreedBy(const model::EffectSpec& spec) {
  if (!spec.id.starts_with("number:")) return {};
  const NumberSpecs& numbers = Numbers();
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (&spec == &numbers[k]) return static_cast<Declared>(k);
    for (std::size_t i = 0; k < kOfActuator && i < kChambersMax; ++i)
      if (&spec == &NumbersOfChambers()[k][i]) return static_cast<Declared>(k);
  }
  return {};
}

std::optional<std::size_t> ChamberFreedBy(const model::EffectSpec& spec) {
  for (const auto& of_chambers : NumbersOfChambers())
    for (std::size_t i = 0; i < kChambersMax; ++i)
      if (&spec == &of_chambers[i]) return i;
  return {};
}

void Free(const model::EffectSpec& spec, Freed& freed) {
  const std::optional<Declared> number = FreedBy(spec);
  if (!number) return;
  const auto k = static_cast<std::size_t>(*number);
  if (const std::optional<std::size_t> chamber = ChamberFreedBy(spec))
    freed.of_chamber[k][*chamber] = true;
  else
    freed[k] = true;
}

EffectSet SpecsOf(const Freed& freed) {
  EffectSet specs;
  for (std::size_t k = 0; k < kDeclaredCount; ++k) {
    if (freed[k]) specs.push_back(&Numbers()[k]);
    for (std::size_t i = 0; k < kOfActuator && i < kChambersMax; ++i)
      if (freed.of_chamber[k][i]) specs.push_back(&NumbersOfChambers()[k][i]);
  }
  return specs;
}

EffectSet EffectsAlone(EffectSet set) {
  std::erase_if(set, [](const model::EffectSpec* spec) { return FreedBy(*spec).has_value(); });
  return set;
}

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

bool HasPlace(const model::EffectSpec& spec, const std::vector<Run>& runs) {
  const bool supply = spec.place == model::EffectPlace::kSupply;
  const bool one_way =
      supply || spec.id == "exhaust_restriction" || spec.id == "directional_conductance";
  return std::none_of(runs.begin(), runs.end(), [&](const Run& run) {
    return (one_way && Evacuates(run)) || (supply && run.supply == Supply::kFlow);
  });
}

EffectSet NamedEffects(const std::vector<Run>& runs) {
  EffectSet named;
  const std::size_t chambers = runs.empty() ? 0 : runs.front().several.pieces();
  for (const model::EffectSpec* spec : model::Effects()) {
    if (IsLearned(*spec) || !HasPlace(*spec, runs) || !Exercised(*spec, runs)) continue;
    if (!IsLeak(*spec) || chambers == 0) named.push_back(spec);
    for (std::size_t i = 0; IsLeak(*spec) && i < chambers; ++i)
      named.push_back(&InChamber(*spec, i));
  }
  return named;
}

EffectSet NumbersThatMayBeWrong(const Dataset& dataset) {
  EffectSet numbers;
  for (std::size_t k = 0; k < kOfTheRig; ++k) {
    const auto number = static_cast<Declared>(k);
    const model::EffectSpec& spec = Freeing(number);
    const bool known = dataset.relative_uncertainty[k] != kUnknown;
    const bool has = std::any_of(dataset.runs.begin(), dataset.runs.end(), [&](const Run& run) {
      return Has(run, number) && (number != Declared::kCriticalRatio || HasRatio(run));
    });
    if (!known || !has || number == Declared::kOperatingPressure || !Exercised(spec, dataset.runs))
      continue;
    const bool own = dataset.several && k < kOfActuator;
    if (!own) numbers.push_back(&spec);
    for (std::size_t i = 0; own && i < dataset.specimens.size(); ++i)
      if (Has(dataset.runs.front(), number, i)) numbers.push_back(&Freeing(number, i));
  }
  return numbers;
}

EffectSet Nameable(const Dataset& dataset) {
  EffectSet named = NamedEffects(dataset.runs);
  const EffectSet numbers = NumbersThatMayBeWrong(dataset);
  named.insert(named.end(), numbers.begin(), numbers.end());
  return named;
}

std::size_t NumbersOf(const EffectSet& set) {
  std::size_t numbers = 0;
  for (const model::EffectSpec* spec : set)
    numbers += FreedBy(*spec) ? 1u : spec->parameters.size();
  return numbers;
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
