#include <algorithm>
#include <cmath>

#include "tests/support/effects/effect_kinds.h"

namespace plenum::test {
namespace {

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

}  // namespace

const std::map<std::string, Kind>& ListedKinds() {
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

}  // namespace plenum::test
