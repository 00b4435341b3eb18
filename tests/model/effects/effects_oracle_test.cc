// The simulator's effects against published and separately computed numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "tests/model/effects/effects_rigs.h"

namespace plenum::model {
namespace effects_oracle_test {

using test::kCloseS;
using test::kUnitC;

// --- Residuals of one effect each on the bench, kPa --------------------------------------------

struct Oracle {
  std::string name;
  Effect effect;
  std::array<double, 4> residual_kpa;  // mid-rise, after closing, end of hold, in the fall
};

void PrintTo(const Oracle& oracle, std::ostream* out) { *out << oracle.name; }

std::vector<Oracle> Oracles() {
  return {
      {"dead_volume", MakeEffect("dead_volume", {10e-6}), {-3.45, -4.37, -4.37, -0.21}},
      {"heat_0.3_s", MakeEffect("heat_transfer", {0.3}), {2.58, 2.82, -0.35, -1.12}},
      {"heat_2_s", MakeEffect("heat_transfer", {2.0}), {6.15, 8.05, 0.22, -4.88}},
      {"inertia", MakeEffect("inertia", {15.0, 0.3}), {0.91, 0.88, -0.20, -0.42}},
      {"creep", MakeEffect("creep", {0.15, 3.0}), {-0.40, -1.24, -5.87, -2.15}},
      {"hysteresis", MakeEffect("hysteresis", {4e3}), {1.91, 1.76, 1.76, -1.15}},
      {"leak", MakeEffect("leak", {0.0005 * kUnitC, 0.3}, "orifice"), {-0.16, -0.33, -2.71, -2.73}},
      {"valve_delay", MakeEffect("valve_delay", {0.02}), {-1.78, -1.16, 0.0, 0.78}},
      {"valve_ramp", MakeEffect("valve_ramp", {0.1}), {-4.50, -3.11, 0.0, 1.95}},
      {"supply_droop",
       MakeEffect("supply_droop", {500e-6, 0.01 * kUnitC, 0.3}),
       {-1.40, -4.58, -4.58, -3.65}},
      {"sensor_lag", MakeEffect("sensor_lag", {0.03}), {-2.71, -1.82, 0.0, 1.17}},
      {"sensor_gain", MakeEffect("sensor_gain", {1.02}), {1.20, 2.00, 2.00, 0.69}},
      {"exhaust_restriction",
       MakeEffect("exhaust_restriction", {0.075 * kUnitC, 0.3}),
       {0.0, 0.0, 0.0, 8.49}},
      {"cracking_pressure", MakeEffect("cracking_pressure", {5e3}), {-0.90, -1.50, -1.50, 1.53}},
  };
}

// The reading at a time, from a run that ends there.
double ReadingAt(const Rig& rig, double time_s) {
  const Response response = Simulate(rig, Until(time_s, 1.0));
  EXPECT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  return Reading(response).back();
}

class EffectResidual : public ::testing::TestWithParam<Oracle> {};

TEST_P(EffectResidual, IsReproduced) {
  constexpr std::array<double, 4> kTimesS{kCloseS / 2.0, kCloseS + 2e-3, kCloseS + 4.99,
                                          kCloseS + 5.0 + 1.475663};
  for (std::size_t i = 0; i < kTimesS.size(); ++i) {
    const double residual_kpa = 1e-3 * (ReadingAt(BenchWith({GetParam().effect}), kTimesS[i]) -
                                        ReadingAt(BenchWith({}), kTimesS[i]));
    // The table has two decimals.
    EXPECT_NEAR(residual_kpa, GetParam().residual_kpa[i], 0.006) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Effects, EffectResidual, ::testing::ValuesIn(Oracles()),
                         [](const auto& test) {
                           std::string name = test.param.name;
                           std::replace(name.begin(), name.end(), '.', '_');
                           return name;
                         });

// --- A 1 L tank, 1 dm³/(s·bar), b 0.3, 6 bar gauge ---------------------------------------------

Rig Tank(ValveState state, std::vector<Effect> effects) {
  GroupRig group =
      OneActuator(7e5, 1.0, {.sonic_conductance_m3_per_s_pa = kUnitC, .critical_ratio = 0.3});
  group.chamber.rest_volume_m3 = 1e-3;
  group.initial_pressure_pa = state == ValveState::kInflate ? 1e5 : 7e5;
  group.schedule = {{0.0, state}};
  group.effects = std::move(effects);
  return RigOf(Regulated(7e5), {group});
}

// Time to 98 % (filling) and to 2 % (emptying) of the gauge pressure.
double TankTime(ValveState state, const std::vector<Effect>& effects) {
  SimulateOptions options = Until(5.0);
  options.rise_fraction = 0.98;
  options.fall_fraction = 0.02;
  const Response response = Simulate(Tank(state, effects), options);
  EXPECT_EQ(response.status, SimulateStatus::kDone) << response.detail;
  return response.strokes.at(0).to_target_s;
}

TEST(EffectTank, FillsAndEmptiesInThePublishedTimes) {
  const auto check = [](const std::vector<Effect>& effects, double fill_s, double empty_s) {
    EXPECT_NEAR(TankTime(ValveState::kInflate, effects), fill_s, 0.01 * fill_s);
    EXPECT_NEAR(TankTime(ValveState::kDeflate, effects), empty_s, 0.01 * empty_s);
  };
  check({}, 1.100, 1.976);
  check({MakeEffect("heat_transfer", {kAdiabaticS})}, 0.79, 1.63);
  check({MakeEffect("heat_transfer", {4.0})}, 0.85, 1.96);
}

// Out of a full tank: T/T(0) = (p/p(0))^(2/7). Into one: m·T = p·V/R and, with gas at T_a coming
// in, the first law m·T − m(0)·T_a = γ·(m − m(0))·T_a.
TEST(EffectTank, FollowsTheFirstLawWithoutHeat) {
  const Effect adiabatic = MakeEffect("heat_transfer", {kAdiabaticS});
  const GroupResponse empty =
      Simulate(Tank(ValveState::kDeflate, {adiabatic}), Until(1.6, 50)).groups[0];
  const GroupResponse fill =
      Simulate(Tank(ValveState::kInflate, {adiabatic}), Until(1.6, 50)).groups[0];
  for (std::size_t i = 0; i < empty.pressure_pa.size(); ++i) {
    const double out_k = 293.15 * std::pow(empty.pressure_pa[i] / 7e5, 2.0 / 7.0);
    EXPECT_NEAR(empty.temperature_k[i], out_k, 1e-5);
    const double p_bar = fill.pressure_pa[i] / 1e5;
    EXPECT_NEAR(fill.temperature_k[i], 293.15 * p_bar / (1.0 + (p_bar - 1.0) / 1.4), 1e-5);
  }
  const auto hottest = std::max_element(fill.temperature_k.begin(), fill.temperature_k.end());
  EXPECT_NEAR(*hottest - 273.15, 115.0, 1.0);  // published
}

}  // namespace effects_oracle_test
}  // namespace plenum::model
