// Effects that real recordings need, where they become something known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/sensitivity.h"
#include "tests/model/simulate_rigs.h"

namespace plenum::model {
namespace {

using enum ValveState;

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};
constexpr FlowElement kTube = {.sonic_conductance_m3_per_s_pa = 0.06e-8, .critical_ratio = 0.15};

GroupRig Cycled() {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
  group.chamber.dead_volume_m3 = 12e-6;
  group.fill = {kValve, kTube};
  group.exhaust = {kTube, kValve};
  group.inlet_after = 1;
  group.schedule = {{0.1, kInflate}, {0.8, kHold}, {1.5, kDeflate}};
  return group;
}

Response Simulated(const GroupRig& group, double end_s = 3.0) {
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(end_s, 40.0));
  EXPECT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  return r;
}

double Largest(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = std::max(largest, std::abs(a[k] - b[k]));
  return largest;
}

TEST(WallHeat, OfAnEndlessWallIsHeatTransfer) {
  GroupRig endless = Cycled(), plain = Cycled();
  endless.effects = {{FindEffect("wall_heat"), {0.4, 1e6, 0.0}}};
  plain.effects = {{FindEffect("heat_transfer"), {0.4}}};
  endless.initial_temperature_k = plain.initial_temperature_k = 320.0;
  const Response a = Simulated(endless), b = Simulated(plain);
  EXPECT_LT(Largest(a.groups[0].pressure_pa, b.groups[0].pressure_pa), 1.0);
  EXPECT_LT(Largest(a.groups[0].temperature_k, b.groups[0].temperature_k), 1e-3);
}

// A closed rigid volume of hot gas comes to the mixture's temperature with its wall.
TEST(WallHeat, GasAndWallMeetWhereTheirHeatBalances) {
  GroupRig group = OneActuator(2e5, 1.0, kValve);
  group.initial_pressure_pa = 2e5;
  group.initial_temperature_k = 350.0;
  group.effects = {{FindEffect("wall_heat"), {0.5, 3.0, 0.25}}};
  const Response r = Simulated(group, 20.0);
  const double ambient_k = Rig().ambient.temperature_k;
  const double wall_k = ambient_k + 0.25 * (350.0 - ambient_k);
  const double gas = ambient_k / 350.0;  // heat capacity of the gas over that at p_op and ambient
  const double mixed_k = (gas * 350.0 + 3.0 * wall_k) / (gas + 3.0);
  EXPECT_NEAR(r.groups[0].temperature_k.back(), mixed_k, 1e-3);
  EXPECT_NEAR(r.groups[0].final_pressure_pa, 2e5 * mixed_k / 350.0, 1.0);
  EXPECT_NEAR(r.groups[0].energy_final_j - r.groups[0].energy_start_j, r.groups[0].wall_heat_j,
              1e-6);
}

TEST(LineStorage, KeepsTheGasAndFollowsItsElements) {
  GroupRig group = Cycled();
  group.effects = {{FindEffect("line_storage"), {0.5}}};
  const Response r = Simulated(group);
  const GroupResponse& g = r.groups[0];
  EXPECT_NEAR(g.gas_final_m3 - g.gas_start_m3, g.air_in_m3 - g.air_out_m3, 1e-10);
  // Both ends meet during the hold, at the pressure of the same gas in the whole volume.
  const Response plain = Simulated(Cycled());
  const std::size_t hold = 58;  // 1.45 s
  EXPECT_NEAR(g.inlet_pressure_pa[hold], g.pressure_pa[hold], 5.0);
  EXPECT_GT(g.inlet_pressure_pa[20], g.pressure_pa[20] + 1e4);
  EXPECT_GT(plain.groups[0].pressure_pa[8], g.pressure_pa[8] - 3e4);
  // The node holds its share of the line's volume.
  EXPECT_NEAR(g.volume_m3[hold], 50e-6 * (1.0 + (g.pressure_pa[hold] - 1e5) / 1e5), 1e-9);
}

TEST(LineStorage, OfNoShareIsTheLumpedLine) {
  GroupRig group = Cycled();
  group.effects = {{FindEffect("line_storage"), {0.01}}};
  group.chamber.dead_volume_m3 = 1e-6;
  GroupRig lumped = Cycled();
  lumped.chamber.dead_volume_m3 = 1e-6;
  const Response a = Simulated(group), b = Simulated(lumped);
  EXPECT_LT(Largest(a.groups[0].pressure_pa, b.groups[0].pressure_pa), 100.0);
}

TEST(LineStorage, WithoutATubeDoesNothing) {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
  group.schedule = {{0.1, kInflate}, {0.8, kDeflate}};
  const Response plain = Simulated(group);
  group.effects = {{FindEffect("line_storage"), {0.5}}};
  EXPECT_LT(Largest(Simulated(group).groups[0].pressure_pa, plain.groups[0].pressure_pa), 0.01);
}

TEST(MeasuredEffects, SensitivitiesAgreeWithDifferences) {
  for (const Effect& effect : {Effect{FindEffect("line_storage"), {0.5}},
                               Effect{FindEffect("wall_heat"), {0.4, 2.0, 0.5}}}) {
    GroupRig group = Cycled();
    group.effects = {effect};
    group.initial_temperature_k = 310.0;
    Rig rig = RigOf(Regulated(3e5), {group});
    SimulateOptions options = Until(3.0, 40.0);
    options.relative_tolerance = 1e-11;
    options.absolute_tolerance_pa = 1e-7;
    for (double& number : rig.groups[0].effects[0].parameters) {
      const double* address = &number;
      const SensitivityResponse exact = SimulateWithSensitivities(rig, options, {&address, 1});
      ASSERT_EQ(exact.response.status, SimulateStatus::kDone) << exact.response.detail;
      const double value = number, h = 1e-4 * value;
      const auto at = [&](double shift) {
        number = value + shift * h;
        return Simulate(rig, options).groups[0].pressure_pa;
      };
      const auto down2 = at(-2), down = at(-1), up = at(1), up2 = at(2);
      number = value;
      double size = 0.0, error = 0.0;
      for (std::size_t k = 0; k < up.size(); ++k) {
        const double difference = (8.0 * (up[k] - down[k]) - (up2[k] - down2[k])) / (12.0 * h);
        size = std::max(size, std::abs(difference));
        error =
            std::max(error, std::abs(exact.derivatives[0].groups[0].pressure_pa[k] - difference));
      }
      EXPECT_LT(error, 1e-3 * size) << effect.spec->id << " " << value;
    }
  }
}

TEST(MeasuredEffects, WhatStandsForTheSamePartIsRefusedTogether) {
  GroupRig group = Cycled();
  group.effects = {{FindEffect("heat_transfer"), {0.4}},
                   {FindEffect("wall_heat"), {0.4, 2.0, 0.5}}};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(1.0));
  EXPECT_EQ(r.status, SimulateStatus::kInvalid);
  EXPECT_NE(r.detail.find("cannot stand beside"), std::string::npos) << r.detail;
}

}  // namespace
}  // namespace plenum::model
