// The independent simulator of effects against published and separately computed numbers.
#include "tests/support/effects/effect_form.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "tests/model/effects/effect_rigs.h"

namespace plenum::test {
namespace effect_form_test {

// --- Published residuals ---------------------------------------------------------------------

struct Oracle {
  std::string effect;
  Change change;
  std::array<double, 4> residual_kpa;  // mid-rise, after closing, end of hold, in the fall
};

void PrintTo(const Oracle& oracle, std::ostream* out) { *out << oracle.effect; }

const std::array<Oracle, 14> kOracles{{
    {"dead_volume", [](EffectRig& r) { r.dead_volume_m3 = 10e-6; }, {-3.45, -4.37, -4.37, -0.21}},
    {"heat_0.3_s", [](EffectRig& r) { r.heat_time_constant_s = 0.3; }, {2.58, 2.82, -0.35, -1.12}},
    {"heat_2_s", [](EffectRig& r) { r.heat_time_constant_s = 2.0; }, {6.15, 8.05, 0.22, -4.88}},
    {"inertia",
     [](EffectRig& r) {
       r.inertia = {15.0, 0.3};
     },
     {0.91, 0.88, -0.20, -0.42}},
    {"creep",
     [](EffectRig& r) {
       r.creep = {0.15, 3.0};
     },
     {-0.40, -1.24, -5.87, -2.15}},
    {"hysteresis",
     [](EffectRig& r) { r.hysteresis_half_width_pa = 4e3; },
     {1.91, 1.76, 1.76, -1.15}},
    {"leak",
     [](EffectRig& r) {
       r.leak = OrificeLeak{0.0005 * kUnitC, 0.3};
     },
     {-0.16, -0.33, -2.71, -2.73}},
    {"valve_delay", [](EffectRig& r) { r.valve_delay_s = 0.02; }, {-1.78, -1.16, 0.0, 0.78}},
    {"valve_ramp", [](EffectRig& r) { r.valve_ramp_s = 0.1; }, {-4.50, -3.11, 0.0, 1.95}},
    {"supply_droop",
     [](EffectRig& r) {
       r.supply_droop = {500e-6, 0.01 * kUnitC, 0.3};
     },
     {-1.40, -4.58, -4.58, -3.65}},
    {"sensor_lag", [](EffectRig& r) { r.sensor_lag_s = 0.03; }, {-2.71, -1.82, 0.0, 1.17}},
    {"sensor_gain", [](EffectRig& r) { r.sensor_gain = 1.02; }, {1.20, 2.00, 2.00, 0.69}},
    {"exhaust_restriction",
     [](EffectRig& r) {
       r.exhaust_restriction = {0.075 * kUnitC, 0.3};
     },
     {0.0, 0.0, 0.0, 8.49}},
    {"cracking_pressure", [](EffectRig& r) { r.cracking_pa = 5e3; }, {-0.90, -1.50, -1.50, 1.53}},
}};

std::array<double, 4> ResidualKpa(const Change& change) {
  const std::vector<double> times{kCloseS / 2.0, kCloseS + 2e-3, kCloseS + 4.99,
                                  kCloseS + 5.0 + 1.475663};
  const EffectResult base = SimulateEffects(Bench(), times, 5e-4);
  const EffectResult with = SimulateEffects(Bench(change), times, 5e-4);
  std::array<double, 4> residual_kpa{};
  for (std::size_t i = 0; i < times.size(); ++i) {
    residual_kpa[i] = 1e-3 * (with.measured_pa[i] - base.measured_pa[i]);
  }
  return residual_kpa;
}

class ResidualOracle : public ::testing::TestWithParam<Oracle> {};

TEST_P(ResidualOracle, IsReproduced) {
  const std::array<double, 4> residual_kpa = ResidualKpa(GetParam().change);
  for (std::size_t i = 0; i < residual_kpa.size(); ++i) {
    // The table has two decimals.
    EXPECT_NEAR(residual_kpa[i], GetParam().residual_kpa[i], 0.006) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, ResidualOracle, ::testing::ValuesIn(kOracles));

// The table of signatures: 7 % more conductance when filling. (Its last column is sampled at
// another instant of the fall than the residuals above.)
TEST(Residual, OfDirectionalConductanceIsReproduced) {
  const std::array<double, 4> residual_kpa =
      ResidualKpa([](EffectRig& rig) { rig.fill_factor = 1.07; });
  EXPECT_NEAR(residual_kpa[0], 3.3, 0.06);
  EXPECT_NEAR(residual_kpa[1], 4.7, 0.06);
  EXPECT_NEAR(residual_kpa[2], 4.7, 0.06);
}

// --- A 1 L tank, 1 dm³/(s·bar), b 0.3, 6 bar gauge ----------------------------------------------

constexpr double kAdiabatic = std::numeric_limits<double>::infinity();

EffectRig Tank(int direction, std::optional<double> heat_time_constant_s) {
  EffectRig rig;
  rig.rest_volume_m3 = 1e-3;
  rig.expansion_ratio = 1.0;
  rig.operating_pa = rig.source_pa = 7e5;
  rig.initial_pa = direction > 0 ? 1e5 : 7e5;
  rig.fill = rig.exhaust = {{kUnitC, 0.3}};
  rig.schedule = {{0.0, direction}};
  rig.heat_time_constant_s = heat_time_constant_s;
  return rig;
}

double TimeAt(const EffectResult& r, double pressure_pa) {
  for (std::size_t i = 1; i < r.t_s.size(); ++i) {
    const double before = r.pressure_pa[i - 1] - pressure_pa;
    const double after = r.pressure_pa[i] - pressure_pa;
    if (before * after <= 0.0) {
      return r.t_s[i - 1] + (r.t_s[i] - r.t_s[i - 1]) * before / (before - after);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

struct TankOracle {
  std::string name;
  std::optional<double> heat_time_constant_s;
  double fill_s, empty_s;  // to 98 % and to 2 % of the gauge pressure
};

void PrintTo(const TankOracle& oracle, std::ostream* out) { *out << oracle.name; }

class TankTimes : public ::testing::TestWithParam<TankOracle> {};

TEST_P(TankTimes, AreReproduced) {
  const std::vector<double> times = Every(1e-3, 3.0);
  const auto& [name, tau_s, fill_s, empty_s] = GetParam();
  const double fill = TimeAt(SimulateEffects(Tank(1, tau_s), times, 1e-3), 1e5 + 0.98 * 6e5);
  const double empty = TimeAt(SimulateEffects(Tank(-1, tau_s), times, 1e-3), 1e5 + 0.02 * 6e5);
  EXPECT_NEAR(fill, fill_s, 0.01 * fill_s);
  EXPECT_NEAR(empty, empty_s, 0.01 * empty_s);
  RecordProperty("fill_s", std::to_string(fill));
  RecordProperty("empty_s", std::to_string(empty));
}

INSTANTIATE_TEST_SUITE_P(Walls, TankTimes,
                         ::testing::Values(TankOracle{"isothermal", std::nullopt, 1.100, 1.976},
                                           TankOracle{"adiabatic", kAdiabatic, 0.79, 1.63},
                                           TankOracle{"wall of 4 s", 4.0, 0.85, 1.96}));

TEST(Tank, ReachesTheTemperaturesOfAdiabaticFillAndBlowdown) {
  const std::vector<double> times = Every(1e-3, 3.0);
  const EffectResult fill = SimulateEffects(Tank(1, kAdiabatic), times, 1e-3);
  const auto& hot = fill.temperature_k;
  EXPECT_NEAR(*std::max_element(hot.begin(), hot.end()) - 273.15, 115.0, 1.0);
  // Closed when full, the gas cools to ambient: 4.3 bar gauge are left.
  ASSERT_NEAR(fill.pressure_pa.back(), 7e5, 1.0);
  EXPECT_NEAR(fill.gas_kg * kGasConstant * 293.15 / 1e-3, 5.3e5, 0.01 * 4.3e5);
  // The published lowest temperature is that at 2 % of the pressure.
  const EffectResult empty = SimulateEffects(Tank(-1, kAdiabatic), times, 1e-3);
  const double emptied_s = TimeAt(empty, 1e5 + 0.02 * 6e5);
  const auto at = static_cast<std::size_t>(std::lround(emptied_s / 1e-3));
  EXPECT_NEAR(empty.temperature_k[at] - 273.15, -99.0, 1.0);
}

// Out of a full tank: T/T(0) = (p/p(0))^(2/7). Into one: m·T = p·V/R and, with gas at T_a coming
// in, the first law m·T − m(0)·T_a = γ·(m − m(0))·T_a.
TEST(Tank, FollowsTheFirstLawWithoutHeat) {
  const std::vector<double> times = Every(0.05, 1.6);
  const EffectResult empty = SimulateEffects(Tank(-1, kAdiabatic), times, 1e-3);
  const EffectResult fill = SimulateEffects(Tank(1, kAdiabatic), times, 1e-3);
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double out_k = 293.15 * std::pow(empty.pressure_pa[i] / 7e5, 2.0 / 7.0);
    EXPECT_NEAR(empty.temperature_k[i], out_k, 1e-6);
    const double p_bar = fill.pressure_pa[i] / 1e5;
    EXPECT_NEAR(fill.temperature_k[i], 293.15 * p_bar / (1.0 + (p_bar - 1.0) / 1.4), 1e-6);
  }
}

// --- Tube: 0.5 m at 50 mL ----------------------------------------------------------------------

// Small oscillation of the column between the closed tube's node and a rigid chamber:
// ω² = (A·R·T/L)·(1/V + 1/V_l) isothermally, γ/V adiabatically; damped by half the friction.
TEST(Tube, ColumnRingsAtItsNaturalFrequency) {
  for (const double gamma : {1.0, 1.4}) {
    SCOPED_TRACE(gamma);
    EffectRig rig = Bench();
    rig.blocked = true;
    rig.line = {4e-3, 0.5};
    if (gamma > 1.0) rig.heat_time_constant_s = kAdiabatic;
    rig.initial_pa = 1.5e5;
    rig.source_pa = 1.52e5;
    rig.schedule = {{0.0, 1}, {0.002, 0}};
    const EffectResult r = SimulateEffects(rig, Every(5e-5, 0.06), 5e-5);
    std::vector<double> crossings;  // of node and chamber
    for (std::size_t i = 60; i < r.t_s.size(); ++i) {
      const double before = r.node_pa[i - 1] - r.pressure_pa[i - 1];
      const double after = r.node_pa[i] - r.pressure_pa[i];
      if (before * after < 0.0)
        crossings.push_back(r.t_s[i - 1] + 5e-5 * before / (before - after));
    }
    ASSERT_GE(crossings.size(), 6u);
    const double period_s = (crossings[4] - crossings[0]) / 2.0;
    const double bore_m2 = std::numbers::pi * 16e-6 / 4.0;
    const double square = bore_m2 * 287.05 * 293.15 / 0.5 * (gamma / 50e-6 + 2.0 / bore_m2);
    const double damping = 16.0 * 1.81e-5 / (16e-6 * 1.5 * kReferenceDensity);
    EXPECT_NEAR(2.0 * std::numbers::pi / period_s, std::sqrt(square - damping * damping),
                2e-3 * std::sqrt(square));
  }
}

// In 1.2 mm friction rules: R·C 59 ms at 1.5 bar, 54.5 ms with the column's inertia.
TEST(Tube, NarrowTubeRelaxesByFriction) {
  EffectRig rig = Bench();
  rig.blocked = true;
  rig.line = {1.2e-3, 0.5};
  rig.initial_pa = 1.49e5;
  rig.source_pa = 1.51e5;
  rig.fill = {{kUnitC, 0.3}};
  const EffectResult r = SimulateEffects(rig, {0.1, 0.2}, 1e-5);
  const double left = (rig.source_pa - r.pressure_pa[1]) / (rig.source_pa - r.pressure_pa[0]);
  EXPECT_NEAR(-0.1 / std::log(left), 54.5e-3, 0.03 * 54.5e-3);
}

// Gas of a hot chamber is at ambient temperature by the time it reaches the tube's end.
TEST(Tube, CoolsTheGasThatLeaves) {
  EffectRig rig = Bench();
  rig.rest_volume_m3 = 1e3;
  rig.blocked = true;
  rig.heat_time_constant_s = kAdiabatic;
  rig.initial_pa = 4e5;
  rig.initial_k = 400.0;
  rig.line = {4e-3, 0.5};
  rig.schedule = {{0.0, -1}};
  const EffectResult before = SimulateEffects(rig, {2.0}, 1e-4);
  const EffectResult after = SimulateEffects(rig, {2.1}, 1e-4);
  const double choked_kg_per_s = 0.05 * kUnitC * kReferenceDensity * after.node_pa[0];
  EXPECT_NEAR(after.exhaust_kg - before.exhaust_kg, 0.1 * choked_kg_per_s, 1e-4 * choked_kg_per_s);
}

}  // namespace effect_form_test
}  // namespace plenum::test
