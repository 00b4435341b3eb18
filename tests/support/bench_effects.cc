#include "tests/support/bench_effects.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>

namespace plenum::test {
namespace {

constexpr double kUnitC = 1e-8;                     // m³/(s·Pa) in 1 dm³/(s·bar)
constexpr double kLaminarUnit = 1e-3 / 60.0 / 1e5;  // m³/(s·Pa) in 1 L/(min·bar)
constexpr double kMl = 1e-6, kKpa = 1e3;

using Parameters = std::vector<std::pair<std::string, double>>;

struct Bench {
  const BenchRig& rig;
  double rise_s;
  Random& random;

  double LineC() const { return rig.fill.conductance / kUnitC; }
  double RestMl() const { return rig.rest_volume_m3 / kMl; }
  double OperatingKpa() const { return rig.operating_gauge_pa / kKpa; }
  double AnyRatio() const { return random.Uniform(0.1, 0.5); }
};

struct Kind {
  std::function<Parameters(const Bench&)> draw;
  std::function<void(TrueEffect&, double)> resize;
  std::function<void(const TrueEffect&, const BenchRig&, EffectRig&)> apply;
};

auto Times(std::string name) {  // the named parameter in proportion to the size
  return [=](TrueEffect& e, double size) { e[name] *= size; };
}
auto TimesAboutOne(std::string name) {
  return [=](TrueEffect& e, double size) { e[name] = 1.0 + size * (e[name] - 1.0); };
}
auto ByRoot(std::string name) {  // 1/parameter² in proportion to the size
  return [=](TrueEffect& e, double size) { e[name] /= std::sqrt(size); };
}

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

void ResizeLeak(TrueEffect& e, double size) {
  for (auto& [name, value] : e.parameters) {
    if (name == "viscous_pa2_s_per_kg") value /= size;
    if (name == "inertial_pa2_s2_per_kg2") value /= size * size;
    if (name == "sonic_conductance_dm3_per_s_bar" || name == "conductance_l_per_min_bar") {
      value *= size;
    }
  }
}

void ApplyLeak(const TrueEffect& e, const BenchRig&, EffectRig& plant) {
  if (e.law == "orifice") {
    plant.leak = OrificeLeak{e["sonic_conductance_dm3_per_s_bar"] * kUnitC, e["critical_ratio"]};
  } else if (e.law == "laminar") {
    plant.leak = LaminarLeak{e["conductance_l_per_min_bar"] * kLaminarUnit};
  } else {
    plant.leak = PorousLeak{e["viscous_pa2_s_per_kg"], e["inertial_pa2_s2_per_kg2"]};
  }
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

const std::map<std::string, Kind>& Listed() {
  static const std::map<std::string, Kind> kinds = {
      {"leak", {nullptr, ResizeLeak, ApplyLeak}},
      {"inertia",
       {[](const Bench& b) {
          const double w = b.random.LogUniform(4.0, 25.0) / b.rise_s;
          return Parameters{{"natural_frequency_rad_per_s", std::clamp(w, 5.0, 120.0)},
                            {"damping_ratio", b.random.Uniform(0.1, 0.7)}};
        },
        ByRoot("natural_frequency_rad_per_s"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.inertia = {e["natural_frequency_rad_per_s"], e["damping_ratio"]};
        }}},
      {"creep",
       {[](const Bench& b) {
          return Parameters{{"fraction", b.random.Uniform(0.05, 0.25)},
                            {"time_constant_s", b.random.LogUniform(0.4, 4.0)}};
        },
        Times("fraction"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.creep = {e["fraction"], e["time_constant_s"]};
        }}},
      {"hysteresis",
       {[](const Bench& b) {
          return Parameters{{"half_width_kpa", b.OperatingKpa() * b.random.Uniform(0.01, 0.05)}};
        },
        Times("half_width_kpa"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.hysteresis_half_width_pa = e["half_width_kpa"] * kKpa;
        }}},
      {"heat_transfer",
       {[](const Bench& b) {
          const double tau_s = b.rise_s * b.random.LogUniform(0.1, 3.0);
          return Parameters{{"time_constant_s", std::clamp(tau_s, 0.03, 3.0)}};
        },
        Times("time_constant_s"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.heat_time_constant_s = e["time_constant_s"];
        }}},
      {"valve_delay",
       {[](const Bench& b) {
          return Parameters{{"delay_s", b.rise_s * b.random.Uniform(0.02, 0.08)}};
        },
        Times("delay_s"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.valve_delay_s = e["delay_s"];
        }}},
      {"valve_ramp",
       {[](const Bench& b) {
          return Parameters{{"duration_s", b.rise_s * b.random.Uniform(0.05, 0.3)}};
        },
        Times("duration_s"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.valve_ramp_s = e["duration_s"];
        }}},
      {"dead_volume",
       {[](const Bench& b) {
          return Parameters{{"volume_ml", b.RestMl() * b.random.Uniform(0.05, 0.25)}};
        },
        Times("volume_ml"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.dead_volume_m3 += e["volume_ml"] * kMl;
        }}},
      {"supply_droop",
       {[](const Bench& b) {
          const double stroke_ml = b.RestMl() * b.rig.expansion_ratio;
          return Parameters{
              {"volume_ml", stroke_ml * b.random.LogUniform(0.5, 5.0)},
              {"sonic_conductance_dm3_per_s_bar", b.LineC() * b.random.LogUniform(0.3, 2.0)},
              {"critical_ratio", b.AnyRatio()}};
        },
        ByRoot("sonic_conductance_dm3_per_s_bar"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.supply_droop = {e["volume_ml"] * kMl, e["sonic_conductance_dm3_per_s_bar"] * kUnitC,
                                e["critical_ratio"]};
        }}},
      {"exhaust_restriction",
       {[](const Bench& b) {
          return Parameters{
              {"sonic_conductance_dm3_per_s_bar", b.LineC() * b.random.Uniform(0.8, 2.5)},
              {"critical_ratio", b.AnyRatio()}};
        },
        ByRoot("sonic_conductance_dm3_per_s_bar"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.exhaust_restriction = {e["sonic_conductance_dm3_per_s_bar"] * kUnitC,
                                       e["critical_ratio"]};
        }}},
      {"nonlinear_compliance",
       {[](const Bench& b) {
          return Parameters{{"curvature", b.random.Sign() * b.random.Uniform(0.1, 0.4)},
                            {"s_amplitude", b.random.Sign() * b.random.Uniform(0.1, 0.4)}};
        },
        [](TrueEffect& e, double size) {
          e["curvature"] *= size;
          e["s_amplitude"] *= size;
        },
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.compliance = {e["curvature"], e["s_amplitude"]};
        }}},
      {"sensor_lag",
       {[](const Bench& b) {
          return Parameters{{"time_constant_s", b.rise_s * b.random.Uniform(0.02, 0.08)}};
        },
        Times("time_constant_s"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.sensor_lag_s = e["time_constant_s"];
        }}},
      {"sensor_offset",
       {[](const Bench& b) {
          const double share = b.random.Sign() * b.random.Uniform(0.005, 0.02);
          return Parameters{{"offset_kpa", share * b.OperatingKpa()}};
        },
        Times("offset_kpa"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.sensor_offset_pa = e["offset_kpa"] * kKpa;
        }}},
      {"sensor_gain",
       {[](const Bench& b) {
          return Parameters{{"gain", 1.0 + b.random.Sign() * b.random.Uniform(0.01, 0.04)}};
        },
        TimesAboutOne("gain"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.sensor_gain = e["gain"];
        }}},
      {"cracking_pressure",
       {[](const Bench& b) {
          return Parameters{{"pressure_kpa", b.OperatingKpa() * b.random.Uniform(0.01, 0.08)}};
        },
        Times("pressure_kpa"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.cracking_pa = e["pressure_kpa"] * kKpa;
        }}},
      {"directional_conductance",
       {[](const Bench& b) {
          return Parameters{{"fill_factor", 1.0 + b.random.Sign() * b.random.Uniform(0.04, 0.15)}};
        },
        TimesAboutOne("fill_factor"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.fill_factor = e["fill_factor"];
        }}},
      {"line_dynamics",
       {[](const Bench& b) {
          return Parameters{{"length_m", b.random.Uniform(0.5, 4.0)},
                            {"inner_diameter_mm", b.random.Uniform(1.2, 4.0)}};
        },
        Times("length_m"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.line = {e["inner_diameter_mm"] * 1e-3, e["length_m"]};
        }}},
  };
  return kinds;
}

const std::map<std::string, Kind>& Outside() {
  static const std::map<std::string, Kind> kinds = {
      {"softening",
       {[](const Bench& b) {
          return Parameters{{"share", b.random.Uniform(0.1, 0.3)}};
        },
        Times("share"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.softening = {e["share"]};
        }}},
      {"kinking_line",
       {[](const Bench& b) {
          return Parameters{{"loss", b.random.Uniform(0.2, 0.6)}};
        },
        Times("loss"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.kinking_line = {e["loss"]};
        }}},
      {"second_chamber",
       {[](const Bench& b) {
          return Parameters{
              {"volume_m3", b.rig.rest_volume_m3 * b.random.Uniform(0.1, 0.5)},
              {"conductance", b.rig.fill.conductance * b.random.LogUniform(0.01, 0.1)},
              {"critical_ratio", b.AnyRatio()}};
        },
        Times("volume_m3"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.second_chamber = {e["volume_m3"], e["conductance"], e["critical_ratio"]};
        }}},
      {"gaping_seam",
       {[](const Bench& b) {
          return Parameters{
              {"open_share", b.random.Uniform(0.4, 0.8)},
              {"conductance", b.rig.fill.conductance * b.random.LogUniform(0.01, 0.1)},
              {"critical_ratio", b.AnyRatio()}};
        },
        Times("conductance"),
        [](const TrueEffect& e, const BenchRig& rig, EffectRig& plant) {
          plant.unlisted.gaping_seam = {rig.ambient_pa + e["open_share"] * rig.operating_gauge_pa,
                                        0.02 * rig.operating_gauge_pa, e["conductance"],
                                        e["critical_ratio"]};
        }}},
      {"snap_through",
       {[](const Bench& b) {
          return Parameters{{"share", b.random.Uniform(0.1, 0.3)},
                            {"centre", b.random.Uniform(0.25, 0.7)},
                            {"width", b.random.Uniform(0.01, 0.03)}};
        },
        Times("share"),
        [](const TrueEffect& e, const BenchRig&, EffectRig& plant) {
          plant.unlisted.snap_through = {e["share"], e["centre"], e["width"]};
        }}},
      {"sticking_valve",
       {[](const Bench& b) {
          return Parameters{{"delay_s", b.rise_s * b.random.Uniform(0.05, 0.2)},
                            {"share_of_strokes", b.random.Uniform(0.3, 0.5)}};
        },
        Times("delay_s"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
      {"swinging_regulator",
       {[](const Bench& b) {
          return Parameters{{"amplitude", b.random.Uniform(0.02, 0.08)},
                            {"frequency_hz", b.random.LogUniform(0.5, 3.0) / b.rise_s}};
        },
        Times("amplitude"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
      {"drifting_sensor",
       {[](const Bench& b) {
          return Parameters{
              {"amplitude_pa", b.rig.operating_gauge_pa * b.random.Uniform(0.01, 0.04)},
              {"period_s", b.random.Uniform(5.0, 20.0)},
              {"phase", b.random.Uniform(0.0, 2.0 * std::numbers::pi)}};
        },
        Times("amplitude_pa"), [](const TrueEffect&, const BenchRig&, EffectRig&) {}}},
  };
  return kinds;
}

const Kind& KindOf(const std::string& id) {
  const auto listed = Listed().find(id);
  return listed != Listed().end() ? listed->second : Outside().at(id);
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
  static const std::vector<std::string> ids = Ids(Listed());
  return ids;
}

const std::vector<std::string>& OutsideEffects() {
  static const std::vector<std::string> ids = Ids(Outside());
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
