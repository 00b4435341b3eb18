// The independent simulator of effects: its balances, its laws recomputed from its curves, its
// closed forms and its steps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/model/effects/effect_rigs.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::test {
namespace effect_form_laws_test {

constexpr double kR = 287.05;

#ifdef PLENUM_SANITIZED
constexpr int kDraws = 4;
#else
constexpr int kDraws = 24;
#endif

// Gas and energy in the curves against what passed the borders.
TEST(EffectForm, KeepsMassAndEnergyUnderAnyEffects) {
  RandomEffectRigs rigs(7);
  for (int draw = 0; draw < kDraws; ++draw) {
    SCOPED_TRACE(draw);
    const EffectRig rig = rigs.Draw();
    const EffectResult r = SimulateEffects(rig, Every(2e-4, 1.4), 2e-4);
    const double p = r.pressure_pa.back(), v = r.volume_m3.back(), t = r.temperature_k.back();
    const double line_m3 = rig.line ? BoreVolume(*rig.line) : 0.0;
    const double droop_m3 = rig.supply_droop ? rig.supply_droop->volume_m3 : 0.0;
    const double gas_kg =
        p * v / (kR * t) +
        (line_m3 * r.node_pa.back() + droop_m3 * r.supply_pa.back()) / (kR * rig.ambient_k);
    EXPECT_NEAR(r.gas_kg, gas_kg, 1e-9 * gas_kg);
    EXPECT_NEAR(gas_kg, r.gas_start_kg + r.source_kg - r.exhaust_kg - r.leak_kg, 1e-9 * gas_kg);
    EXPECT_GT(*std::max_element(r.pressure_pa.begin(), r.pressure_pa.end()),
              rig.ambient_pa + 0.3e5);
    if (rig.source == EffectRig::Source::kReservoir && !rig.supply_droop) {
      const double drawn_kg =
          (rig.source_pa - r.supply_pa.back()) * rig.reservoir_m3 / (kR * rig.ambient_k);
      EXPECT_NEAR(r.source_kg, drawn_kg, 1e-9 * gas_kg);
    }
    // Work and heat by the trapezium rule on the curves.
    double work_j = 0.0, heat_j = 0.0;
    const double wall_w_per_k = rig.heat_time_constant_s
                                    ? 2.5 * rig.operating_pa * rig.rest_volume_m3 *
                                          rig.expansion_ratio /
                                          (rig.ambient_k * *rig.heat_time_constant_s)
                                    : 0.0;
    for (std::size_t i = 1; i < r.t_s.size(); ++i) {
      work_j +=
          0.5 * (r.pressure_pa[i] + r.pressure_pa[i - 1]) * (r.volume_m3[i] - r.volume_m3[i - 1]);
      heat_j += wall_w_per_k *
                (rig.ambient_k - 0.5 * (r.temperature_k[i] + r.temperature_k[i - 1])) *
                (r.t_s[i] - r.t_s[i - 1]);
    }
    const double scale_j = 2.5 * p * v;
    EXPECT_NEAR(r.work_j, work_j, 1e-5 * scale_j);
    if (!rig.heat_time_constant_s) continue;
    EXPECT_NEAR(r.heat_j, heat_j, 1e-5 * scale_j);
    EXPECT_NEAR(r.energy_j, 2.5 * p * v, 1e-9 * scale_j);
    EXPECT_NEAR(r.energy_j - r.energy_start_j, r.enthalpy_in_j - r.enthalpy_out_j + heat_j - work_j,
                2e-5 * scale_j);
  }
}

TEST(EffectForm, HalvingTheStepChangesNothing) {
  RandomEffectRigs rigs(11);
  for (int draw = 0; draw < kDraws / 2; ++draw) {
    SCOPED_TRACE(draw);
    const EffectRig rig = rigs.Draw();
    const std::vector<double> times = Every(0.02, 1.4);
    const EffectResult once = SimulateEffects(rig, times, 1e-4);
    const EffectResult twice = SimulateEffects(rig, times, 5e-5);
    EXPECT_LT(LargestDifference(once.pressure_pa, twice.pressure_pa), 1e-7 * rig.ambient_pa);
    EXPECT_LT(LargestDifference(once.measured_pa, twice.measured_pa), 1e-7 * rig.ambient_pa);
  }
}

// The volume recomputed from the pressure curve: the play as the clamp of its last value, the creep
// by the trapezium rule, the wall's equation of motion by central differences.
TEST(EffectForm, VolumeObeysPlayCreepAndInertiaTogether) {
  for (const bool inertia : {false, true}) {
    SCOPED_TRACE(inertia);
    constexpr double kStep = 1e-4, kHalfWidth = 4e3;
    const EffectRig rig = Bench([&](EffectRig& r) {
      r.hysteresis_half_width_pa = kHalfWidth;
      r.creep = {0.2, 0.4};
      r.compliance = {0.3, 0.2};
      r.dead_volume_m3 = 5e-6;
      r.heat_time_constant_s = 0.5;
      r.schedule = {{0.0, 1}, {0.6, -1}, {0.8, 1}, {1.2, 0}, {1.5, -1}};
      if (inertia) r.inertia = {30.0, 0.2};
    });
    const EffectResult r = SimulateEffects(rig, Every(kStep, 2.5), kStep);
    double play_pa = rig.initial_pa, creep_m3 = 0.0, last_m3 = 50e-6, worst_m3 = 0.0;
    for (std::size_t i = 0; i + 1 < r.t_s.size(); ++i) {
      play_pa = std::clamp(play_pa, r.pressure_pa[i] - kHalfWidth, r.pressure_pa[i] + kHalfWidth);
      const double x = (play_pa - 1e5) / 1e5;
      const double quasi_static_m3 =
          50e-6 * (1.0 + x + 0.3 * x * (x - 1.0) + 0.2 * std::sin(6.283185307 * x) / 6.283185307);
      const double pull_m3 = 0.2 * (0.5 * (quasi_static_m3 + last_m3) - 50e-6);
      last_m3 = quasi_static_m3;
      if (i > 0) {
        creep_m3 = (creep_m3 * (1.0 - kStep / 0.8) + pull_m3 * kStep / 0.4) / (1.0 + kStep / 0.8);
      }
      double volume_m3 = quasi_static_m3 + creep_m3 + 5e-6;
      if (inertia && i > 0) {
        const double rate = (r.volume_m3[i + 1] - r.volume_m3[i - 1]) / (2.0 * kStep);
        const double acceleration =
            (r.volume_m3[i + 1] - 2.0 * r.volume_m3[i] + r.volume_m3[i - 1]) / (kStep * kStep);
        volume_m3 -= (acceleration + 2.0 * 0.2 * 30.0 * rate) / 900.0;
      }
      worst_m3 = std::max(worst_m3, std::abs(r.volume_m3[i] - volume_m3));
    }
    // Second differences are off by V'·Δ(dp/dt)·h/6 where a valve or the play turns.
    EXPECT_LT(worst_m3, (inertia ? 1e-4 : 1e-7) * 50e-6);
  }
}

// The measured pressure recomputed from the true one: lag, then gain, then offset.
TEST(EffectForm, SensorLagsThenScalesThenShifts) {
  constexpr double kStep = 1e-4, kLag = 0.03;
  const EffectRig rig = Bench([](EffectRig& r) {
    r.initial_pa = 1.2e5;
    r.sensor_lag_s = kLag;
    r.sensor_gain = 1.05;
    r.sensor_offset_pa = -700.0;
  });
  const EffectResult r = SimulateEffects(rig, Every(kStep, 8.0), kStep);
  double lagging_pa = 1.2e5;
  for (std::size_t i = 0; i < r.t_s.size(); ++i) {
    if (i > 0) {
      const double mean_pa = 0.5 * (r.pressure_pa[i] + r.pressure_pa[i - 1]);
      lagging_pa = mean_pa + (lagging_pa - mean_pa) * std::exp(-kStep / kLag);
    }
    ASSERT_NEAR(r.measured_pa[i], 1e5 + 1.05 * (lagging_pa - 1e5) - 700.0, 0.5) << r.t_s[i];
  }
}

// Choked flow into and out of a chamber so large that its pressure stays: the gas that passes is
// the area under the openings. Inflate at 0, deflate at 50 ms: the fill opens to one half and shuts
// by 100 ms, 25 ms of full opening; the exhaust opens from 50 to 150 ms.
TEST(EffectForm, RampsOverlapAndDelaysShiftThem) {
  EffectRig rig = Bench();
  rig.rest_volume_m3 = 1e3;
  rig.expansion_ratio = 1.0;
  rig.initial_pa = 4e5;
  rig.source_pa = 2e6;
  rig.schedule = {{0.0, 1}, {0.05, -1}};
  rig.valve_ramp_s = 0.1;
  rig.valve_delay_s = 0.03;
  const double conductance = 0.05 * kUnitC * kReferenceDensity;
  const EffectResult early = SimulateEffects(rig, {0.03, 0.08}, 1e-3);
  EXPECT_NEAR(early.source_kg, conductance * 2e6 * 0.0125, 1e-12);
  EXPECT_EQ(early.exhaust_kg, 0.0);
  const EffectResult late = SimulateEffects(rig, {0.08 + 0.15}, 1e-3);
  EXPECT_NEAR(late.source_kg, conductance * 2e6 * 0.025, 1e-12);
  EXPECT_NEAR(late.exhaust_kg, conductance * 4e5 * 0.1, 1e-10);
}

// Rigid, isothermal at 310 K, nothing but a leak: each law has a closed form.
TEST(EffectForm, LeaksDecayInClosedForm) {
  EffectRig rig;
  rig.blocked = true;
  rig.source = EffectRig::Source::kNone;
  rig.ambient_k = 310.0;
  rig.initial_pa = 5e5;
  const double v = rig.rest_volume_m3, per_mass = kR * 310.0;
  const std::vector<double> times = Every(0.5, 10.0);
  const auto pressure = [&](auto leak) {
    rig.leak = leak;
    return SimulateEffects(rig, times, 1e-3).pressure_pa;
  };
  // G and a: (p − p_a)/(p + p_a) decays exponentially. c: p = p_a·cosh. Choked: p decays.
  const double g = 0.01 * kUnitC, a = 2e5 / (kReferenceDensity * g), c = 1e21;
  const double choked =
      0.005 * kUnitC * kReferenceDensity * std::sqrt(293.15 / 310.0) * per_mass / v;
  const auto laminar = pressure(LaminarLeak{g});
  const auto viscous = pressure(PorousLeak{a, 0.0});
  const auto inertial = pressure(PorousLeak{0.0, c});
  const auto orifice = pressure(OrificeLeak{0.005 * kUnitC, 0.3});
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double y = 4.0 / 6.0 * std::exp(-per_mass / v * 2e5 / a * times[i]);
    EXPECT_NEAR(laminar[i], 1e5 * (1.0 + y) / (1.0 - y), 1e-3);
    EXPECT_NEAR(viscous[i], laminar[i], 1e-3);
    const double angle = std::acosh(5.0) - per_mass / (v * std::sqrt(c)) * times[i];
    ASSERT_GT(angle, 0.0);
    EXPECT_NEAR(inertial[i], 1e5 * std::cosh(angle), 1e-3);
    const double still_choked = 5e5 * std::exp(-choked * times[i]);
    if (still_choked > 1e5 / 0.3) {
      EXPECT_NEAR(orifice[i], still_choked, 1e-3);
    }
  }
  EXPECT_LT(laminar.back(), 3e5);
  EXPECT_LT(inertial.back(), 3e5);
  EXPECT_LT(orifice[4], 4.9e5);
}

// Below ambient the leaks let gas in: a choked orifice at a constant rate.
TEST(EffectForm, LeaksFillWhatIsBelowAmbient) {
  EffectRig rig;
  rig.blocked = true;
  rig.source = EffectRig::Source::kNone;
  rig.initial_pa = 1e4;
  const double g = 0.01 * kUnitC, a = 2e5 / (kReferenceDensity * g);
  rig.leak = OrificeLeak{g, 0.3};
  EXPECT_NEAR(SimulateEffects(rig, {0.5}, 1e-3).pressure_pa[0],
              1e4 + 0.5 * 1e5 * g * 1e5 / rig.rest_volume_m3, 1e-3);
  const double y = -0.9 / 1.1 * std::exp(-2.0 * g * 1e5 / rig.rest_volume_m3);
  rig.leak = LaminarLeak{g};
  EXPECT_NEAR(SimulateEffects(rig, {2.0}, 1e-3).pressure_pa[0], 1e5 * (1.0 + y) / (1.0 - y), 1e-3);
  rig.leak = PorousLeak{a, 0.0};
  EXPECT_NEAR(SimulateEffects(rig, {2.0}, 1e-3).pressure_pa[0], 1e5 * (1.0 + y) / (1.0 - y), 1e-3);
}

// A closed rigid chamber cools by its wall alone, T − T_a ~ exp(−hA·t/(m·c_v)); the wall is that of
// the unblocked actuator at the operating pressure.
TEST(EffectForm, BlockedChamberKeepsTheWallOfTheFreeOne) {
  EffectRig rig;
  rig.blocked = true;
  rig.source = EffectRig::Source::kNone;
  rig.initial_pa = 1.5e5;
  rig.initial_k = 400.0;
  rig.heat_time_constant_s = 2.0;
  const double rate_per_s = 2e5 * rig.expansion_ratio / (293.15 * 2.0) * 400.0 / 1.5e5;
  const EffectResult r = SimulateEffects(rig, {0.25, 0.5}, 1e-3);
  for (std::size_t i = 0; i < r.t_s.size(); ++i) {
    const double expected_k = 293.15 + (400.0 - 293.15) * std::exp(-rate_per_s * r.t_s[i]);
    EXPECT_NEAR(r.temperature_k[i], expected_k, 1e-6);
    EXPECT_NEAR(r.pressure_pa[i], 1.5e5 * expected_k / 400.0, 1e-3);
  }
}

// The ramp opens the valve, not the restriction behind it. With b = 0 conductances in series add as
// 1/C² and  q = C·√(p² − p_a²): the gas that leaves a large chamber while the valve opens is
// √(p² − p_a²)·t·(C2/C1)·(√(C1² + C2²) − C2).
TEST(EffectForm, RampLeavesTheRestrictionAlone) {
  EffectRig rig = Bench();
  rig.rest_volume_m3 = 1e3;
  rig.expansion_ratio = 1.0;
  rig.initial_pa = 4e5;
  const double c1 = 0.05 * kUnitC, c2 = 0.04 * kUnitC;
  rig.exhaust = {{c1, 0.0}};
  rig.exhaust_restriction = {c2, 0.0};
  rig.valve_ramp_s = 0.1;
  rig.schedule = {{0.0, -1}};
  const double expected_kg =
      kReferenceDensity * std::sqrt(15.0) * 1e5 * 0.1 * c2 / c1 * (std::hypot(c1, c2) - c2);
  EXPECT_NEAR(SimulateEffects(rig, {0.1}, 1e-3).exhaust_kg, expected_kg, 1e-6 * expected_kg);
}

}  // namespace effect_form_laws_test
}  // namespace plenum::test
