// Pumps without a reservoir as the simulator's source.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/simulate/periodic.h"
#include "model/simulate/sensitivity.h"
#include "model/simulate/simulate.h"
#include "model/strokes/pump_stroke.h"
#include "tests/model/simulate/simulate_rigs.h"
#include "tests/support/pumps/pump_filling.h"

namespace plenum::model {
namespace simulate_pump_test {

using enum ValveState;

PumpSource Pumps(int count = 1) {
  PumpSource source;
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 2e5}, {1e-4, 0.0});
  source.compressor.current_a = MonotoneCurve({1e5, 2e5}, {1.0, 1.5});
  source.compressor.voltage_v = 12.0;
  source.compressor.pressure_max_pa = 2e5;
  source.compressor_count = count;
  return source;
}

GroupRig Actuator(double volume_m3 = 50e-6, double conductance = 5e-10) {
  GroupRig group = OneActuator(1.6e5, 2.0, {conductance, 0.3});
  group.chamber.rest_volume_m3 = volume_m3;
  group.close_at_operating = true;
  group.initial_pressure_pa = 1e5;
  return group;
}

SimulateOptions Sharp(double end_s, double sample_hz = 0.0) {
  SimulateOptions options = Until(end_s, sample_hz);
  options.linear_ratio = 1.0 - 1e-9;
  return options;
}

// physics, 2.15.
TEST(SimulatePumps, TheOracleOfThePhysicsPage) {
  EXPECT_NEAR(FullStrokes(RigOf(Pumps(), {Actuator()}), Sharp(1.0))[0].rise_time_s, 2.296567, 1e-6);
}

TEST(SimulatePumps, RunWhileAValveIsOpenAndKeepTheMass) {
  GroupRig group = Actuator();
  group.schedule = {{0.5, kInflate}, {6.0, kDeflate}, {12.0, kInflate}};
  group.count = 3;
  const Response response = Simulate(RigOf(Pumps(2), {group}), Sharp(20.0, 100.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone);
  double on_s = 0.0;
  for (const Stroke& stroke : response.strokes)
    if (stroke.state == kInflate) on_s += stroke.to_operating_s;
  EXPECT_NEAR(response.compressor_on_s, on_s, 1e-6 * on_s);
  const GroupResponse& of = response.groups[0];
  EXPECT_NEAR(response.compressor_air_m3, of.air_drawn_m3, 1e-10 * of.air_drawn_m3);
  EXPECT_NEAR(of.gas_final_m3 - of.gas_start_m3, response.compressor_air_m3 - of.air_out_m3,
              1e-8 * response.compressor_air_m3);
  // Between pumps and valves ambient while they are off, above the chambers while they run.
  for (std::size_t k = 0; k < response.t_s.size(); ++k) {
    if (of.flow_m3_per_s[k] > 0.0)
      EXPECT_GT(response.source_pressure_pa[k], of.pressure_pa[k]);
    else
      EXPECT_EQ(response.source_pressure_pa[k], 1e5);
  }
}

// A flow controller: what it lets in does not depend on the node, which is found for samples alone;
// with accounts it is found at every step. In a rigid vessel p' = q·P0/V.
TEST(SimulatePumps, AGivenFlowFillsEvenlyWhateverTheLineConducts) {
  PumpSource flow;
  flow.compressor.free_air_m3_per_s = MonotoneCurve({0.0, 1e8}, {2e-5, 2e-5});
  flow.compressor.pressure_max_pa = 1e8;
  GroupRig group = Actuator();
  group.close_at_operating = false;
  group.blocked = true;
  group.schedule = {{0.5, kInflate}, {3.0, kHold}};
  SimulateOptions options = Until(4.0, 50.0);
  const Response all = Simulate(RigOf(flow, {group}), options);
  options.record = Record::kSamples;
  const Response samples = Simulate(RigOf(flow, {group}), options);
  ASSERT_EQ(all.status, SimulateStatus::kDone);
  ASSERT_EQ(samples.status, SimulateStatus::kDone);
  ASSERT_EQ(all.t_s.size(), samples.t_s.size());
  const double rate = 2e-5 * kReferencePressurePa / 50e-6;
  for (std::size_t k = 0; k < all.t_s.size(); ++k) {
    const double open_s = std::clamp(all.t_s[k] - 0.5, 0.0, 2.5);
    EXPECT_NEAR(samples.groups[0].pressure_pa[k], 1e5 + rate * open_s, 1.0);
    EXPECT_NEAR(samples.source_pressure_pa[k], all.source_pressure_pa[k],
                1e-6 * all.source_pressure_pa[k]);
  }
}

// Two groups that are open at once, against masses by the laws alone.
TEST(SimulatePumps, GroupsTogetherAgainstTheLaws) {
  GroupRig small = Actuator(20e-6, 3e-10), large = Actuator(60e-6, 9e-10);
  large.count = 2;
  large.chamber.operating_pressure_pa = 1.5e5;
  small.schedule = large.schedule = {{0.0, kInflate}};
  const PumpSource source = Pumps(2);
  const Response response = Simulate(RigOf(source, {small, large}), Sharp(30.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone);
  test::PumpFilling laws;
  laws.delivery_m3_per_s = [](double p) { return 2.0 * 1e-4 * (2.0 - p / 1e5); };
  laws.power_w = [](double p) { return 2.0 * 12.0 * (0.5 + 0.5 * p / 1e5); };
  laws.highest_pa = 2e5;
  for (const GroupRig* rig : {&small, &large}) {
    const Chamber chamber = rig->chamber;
    laws.groups.push_back({rig->count,
                           [chamber](double p) {
                             return chamber.rest_volume_m3 *
                                    (1.0 + (p - 1e5) / (chamber.operating_pressure_pa - 1e5));
                           },
                           {{rig->fill[0].sonic_conductance_m3_per_s_pa, 0.3}},
                           chamber.operating_pressure_pa});
  }
  const test::PumpFilled filled = test::FillByMasses(laws, 400);
  for (const Stroke& stroke : response.strokes) {
    const double expected_s = filled.seconds[static_cast<std::size_t>(stroke.group)];
    EXPECT_NEAR(stroke.to_operating_s, expected_s, 1e-5 * expected_s);
  }
  EXPECT_NEAR(response.compressor_energy_j, filled.energy_j, 1e-5 * filled.energy_j);
}

// The periodic state has the stroke's own time and energy in each period.
TEST(SimulatePumps, RepeatTheirStroke) {
  GroupRig group = Actuator(50e-6, 2e-9);
  group.schedule = {{0.0, kInflate}, {10.0, kDeflate}};
  const PeriodicState state = FindPeriodicState(RigOf(Pumps(), {group}), 20.0, Sharp(1.0));
  ASSERT_EQ(state.status, PeriodicStatus::kConverged);
  const Series series = MakeSeries(group.fill, 1.0);
  PumpStrokeInput input;
  input.fill = &series;
  input.chamber = &group.chamber;
  const PumpSource source = Pumps();
  input.compressor = &source.compressor;
  input.from_pa = 1e5;
  input.operating_pa = 1.6e5;
  input.target_pa = 1.57e5;
  const PumpStroke stroke = FillFromPumps(input);
  EXPECT_NEAR(state.compressor_duty * 20.0, stroke.inflate_s, 1e-4 * stroke.inflate_s);
  EXPECT_NEAR(state.compressor_energy_j, stroke.pump_energy_j, 1e-4 * stroke.pump_energy_j);
}

// A valve that stays open goes on to the highest pressure that the pumps reach.
TEST(SimulatePumps, AnOpenValveFillsToTheirHighestPressure) {
  GroupRig group = Actuator();
  group.close_at_operating = false;
  group.schedule = {{0.0, kInflate}};
  PumpSource source = Pumps();
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 2e5}, {1e-4, 2e-5});
  const Response response = Simulate(RigOf(source, {group}), Sharp(60.0));
  ASSERT_EQ(response.status, SimulateStatus::kDone);
  EXPECT_NEAR(response.groups[0].final_pressure_pa, 2e5, 1.0);
}

TEST(SimulatePumps, DerivativesAgreeWithDifferences) {
  GroupRig group = Actuator();
  group.schedule = {{0.0, kInflate}};
  Rig rig = RigOf(Pumps(), {group});
  double& conductance = rig.groups[0].fill[0].sonic_conductance_m3_per_s_pa;
  double& duty = std::get<PumpSource>(rig.source).duty;
  duty = 0.9;
  const auto rise_s = [&] { return Simulate(rig, Sharp(30.0)).strokes[0].to_target_s; };
  const Direction directions[] = {{{&conductance, 1.0}}, {{&duty, 1.0}}};
  const SensitivityResponse moved = SimulateAlongDirections(rig, Sharp(30.0), directions);
  ASSERT_EQ(moved.response.status, SimulateStatus::kDone);
  std::size_t i = 0;
  for (double* number : {&conductance, &duty}) {
    const double at = *number, step = 1e-4 * at;
    *number = at + step;
    const double above = rise_s();
    *number = at - step;
    const double below = rise_s();
    *number = at;
    const double difference = (above - below) / (2.0 * step);
    EXPECT_NEAR(moved.derivatives[i++].strokes[0].to_target_s, difference,
                2e-3 * std::abs(difference));
  }
}

TEST(SimulatePumps, RefuseWhatTheyCannotRun) {
  PumpSource none;
  EXPECT_EQ(Simulate(RigOf(none, {Actuator()}), Sharp(1.0)).status, SimulateStatus::kInvalid);
  EXPECT_EQ(Simulate(RigOf(Pumps(0), {Actuator()}), Sharp(1.0)).status, SimulateStatus::kInvalid);
}

}  // namespace simulate_pump_test
}  // namespace plenum::model
