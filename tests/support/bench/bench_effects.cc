#include "tests/support/bench/bench_effects.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "tests/support/effects/effect_kinds.h"

namespace plenum::test {
namespace {

Parameters DrawLeak(const std::string& law, const Bench& b) {
  const double share = b.random.LogUniform(0.003, 0.03);
  if (law == "orifice") {
    return {{"sonic_conductance_dm3_per_s_bar", share * b.LineC()},
            {"critical_ratio", b.AnyRatio()}};
  }
  if (law == "laminar") {
    const double g = 1.3 * share * b.rig.fill.conductance;
    return {{"conductance_l_per_min_bar", g / kLaminarUnit}};
  }
  const double p = b.rig.ambient_pa + b.rig.operating_gauge_pa, p_a = b.rig.ambient_pa;
  const double flow = kReferenceDensity * share * b.rig.fill.conductance * p;
  const double viscous = b.random.Uniform(0.3, 0.7), squares = p * p - p_a * p_a;
  return {{"viscous_pa2_s_per_kg", viscous * squares / flow},
          {"inertial_pa2_s2_per_kg2", (1.0 - viscous) * squares / (flow * flow)}};
}

// Strokes at random open or close late.
void Stick(const TrueEffect& e, std::uint64_t stream, EffectRig& plant) {
  Random random(stream);
  auto& schedule = plant.schedule;
  for (std::size_t i = 1; i < schedule.size(); ++i) {
    if (!random.Coin(e["share_of_strokes"])) continue;
    const double room_s =
        i + 1 < schedule.size() ? schedule[i + 1].time_s - schedule[i].time_s : 1.0;
    schedule[i].time_s += std::min(e["delay_s"] * random.Uniform(0.5, 1.5), 0.8 * room_s);
  }
}

void Swing(const TrueEffect& e, std::uint64_t stream, EffectRig& plant) {
  Random random(stream);
  const double phase = random.Uniform(0.0, 2.0 * std::numbers::pi);
  const double turn = 2.0 * std::numbers::pi * e["frequency_hz"], amplitude = e["amplitude"];
  const double level_pa = plant.source_pa;
  plant.source_course = [=](double t_s) {
    return level_pa * (1.0 + amplitude * std::sin(turn * t_s + phase));
  };
}

const Kind& KindOf(const std::string& id) {
  const auto listed = ListedKinds().find(id);
  return listed != ListedKinds().end() ? listed->second : OutsideKinds().at(id);
}

std::vector<std::string> Ids(const std::map<std::string, Kind>& kinds) {
  std::vector<std::string> ids;
  for (const auto& [id, kind] : kinds) ids.push_back(id);
  return ids;
}

}  // namespace

double& TrueEffect::operator[](std::string_view name) {
  for (auto& [known, value] : parameters) {
    if (known == name) return value;
  }
  throw std::out_of_range(id + " has no " + std::string(name));
}

double TrueEffect::operator[](std::string_view name) const {
  return const_cast<TrueEffect&>(*this)[name];
}

const std::vector<std::string>& ListedEffects() {
  static const std::vector<std::string> ids = Ids(ListedKinds());
  return ids;
}

const std::vector<std::string>& OutsideEffects() {
  static const std::vector<std::string> ids = Ids(OutsideKinds());
  return ids;
}

bool Shows(const std::string& id, BenchSupply supply) {
  if (supply == BenchSupply::kNone) {
    return id != "supply_droop" && id != "directional_conductance" && id != "softening" &&
           id != "swinging_regulator" && id != "line_dynamics";
  }
  if (supply == BenchSupply::kMeasured) return id != "supply_droop" && id != "swinging_regulator";
  if (supply == BenchSupply::kCompressor) return id != "swinging_regulator";
  return true;
}

TrueEffect DrawEffect(const std::string& id, const BenchRig& rig, double rise_s, Random& random) {
  const Bench bench{rig, rise_s, random};
  TrueEffect effect{id, "", {}};
  if (id == "leak") {
    effect.law = random.Pick<std::string>({"orifice", "laminar", "porous"});
    effect.parameters = DrawLeak(effect.law, bench);
  } else {
    effect.parameters = KindOf(id).draw(bench);
  }
  return effect;
}

TrueEffect Sized(const TrueEffect& effect, double size) {
  TrueEffect sized = effect;
  KindOf(effect.id).resize(sized, size);
  return sized;
}

bool Possible(const TrueEffect& e, const BenchRig& rig) {
  if (e.id == "nonlinear_compliance") {
    return std::abs(e["curvature"]) + std::abs(e["s_amplitude"]) < 0.8;
  }
  if (e.id == "creep") return e["fraction"] < 0.6;
  if (e.id == "softening" || e.id == "snap_through") return e["share"] < 0.6;
  if (e.id == "kinking_line") return e["loss"] < 0.9;
  if (e.id == "cracking_pressure") return e["pressure_kpa"] * kKpa < 0.15 * rig.operating_gauge_pa;
  if (e.id == "hysteresis") return e["half_width_kpa"] * kKpa < 0.15 * rig.operating_gauge_pa;
  if (e.id == "swinging_regulator") return e["amplitude"] < 0.2;
  if (e.id == "inertia") return e["natural_frequency_rad_per_s"] < 250.0;
  return true;
}

void Apply(const TrueEffect& effect, const BenchRig& rig, std::uint64_t stream, EffectRig& plant) {
  KindOf(effect.id).apply(effect, rig, plant);
  if (effect.id == "sticking_valve") Stick(effect, stream, plant);
  if (effect.id == "swinging_regulator") Swing(effect, stream, plant);
}

double Drift(const TrueEffect& effect, double session_s) {
  if (effect.id != "drifting_sensor") return 0.0;
  const double turns = session_s / effect["period_s"];
  return effect["amplitude_pa"] * std::sin(2.0 * std::numbers::pi * turns + effect["phase"]);
}

}  // namespace plenum::test
