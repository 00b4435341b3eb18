// A wall of finite heat capacity where it becomes something known.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace wall_heat_test {

using enum ValveState;

constexpr FlowElement kValve = {.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.3};
GroupRig Cycled() {
  GroupRig group = OneActuator(2e5, 2.0, kValve);
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

TEST(WallHeat, BesideHeatTransferIsRefused) {
  GroupRig group = Cycled();
  group.effects = {{FindEffect("heat_transfer"), {0.4}},
                   {FindEffect("wall_heat"), {0.4, 2.0, 0.5}}};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(1.0));
  EXPECT_EQ(r.status, SimulateStatus::kInvalid);
  EXPECT_NE(r.detail.find("cannot stand beside"), std::string::npos) << r.detail;
}

}  // namespace wall_heat_test
}  // namespace plenum::model
