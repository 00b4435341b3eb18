// Regulated and reservoir sources of the simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "model/simulate/simulate.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace simulate_source_test {

using enum ValveState;

TEST(SimulateSource, ALargeReservoirActsLikeARegulatedSource) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  const ReservoirSource large{.volume_m3 = 1e6, .initial_pressure_pa = 3e5};
  const double rise_b = FullStrokes(RigOf(large, {group}), {})[0].rise_time_s;
  const double rise_a = FullStrokes(RigOf(Regulated(3e5), {group}), {})[0].rise_time_s;
  EXPECT_NEAR(rise_b, rise_a, 1e-7 * rise_a);
}

// One inflating group sees regulator and line as one series with C/count, capped at its share.
TEST(SimulateSource, SharedRegulatorActsLikeASeriesForOneGroup) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.count = 4;
  RegulatedSource source = Regulated(4e5);
  source.regulator = FlowElement{1.6e-9, 0.4};
  const double shared = FullStrokes(RigOf(source, {group}), {})[0].rise_time_s;
  GroupRig single = group;
  single.count = 1;
  single.fill.insert(single.fill.begin(), {0.4e-9, 0.4});
  const double in_series = FullStrokes(RigOf(Regulated(4e5), {single}), {})[0].rise_time_s;
  EXPECT_NEAR(shared, in_series, 1e-7 * in_series);

  // Capped all the way: 50 mL·(2·2 − 1)·0.95… of standard air at a quarter of the limit.
  source.flow_max_m3_per_s = 1e-4;
  const double p = 1.95;
  const double content = 50e-6 * (p * p - 1.0);  // p·V = V0·p·p for these numbers
  EXPECT_NEAR(FullStrokes(RigOf(source, {group}), {})[0].rise_time_s, content / 0.25e-4, 1e-6);
}

TEST(SimulateSource, TwoEqualGroupsAreOneGroupOfTwo) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  RegulatedSource source = Regulated(4e5);
  source.regulator = FlowElement{0.8e-9, 0.4};
  const auto two = FullStrokes(RigOf(source, {group, group}), {});
  group.count = 2;
  const auto one = FullStrokes(RigOf(source, {group}), {});
  EXPECT_NEAR(two[0].rise_time_s, one[0].rise_time_s, 1e-7);
  EXPECT_NEAR(two[1].rise_time_s, one[0].rise_time_s, 1e-7);
}

ReservoirSource Pumped(double initial_pa, double stop_pa) {
  ReservoirSource source{.volume_m3 = 1e-3, .initial_pressure_pa = initial_pa};
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 6e5}, {1e-4, 1e-4});
  source.compressor.current_a = MonotoneCurve({1e5, 6e5}, {5.0, 5.0});
  source.compressor.voltage_v = 12.0;
  source.compressor.pressure_max_pa = 6e5;
  source.stop_pressure_pa = stop_pa;
  return source;
}

TEST(SimulateSource, CompressorFillsAtItsRateAndStops) {
  // 1 L from 1 to 4 bar takes 3 L of standard air: 30 s at 0.1 L/s.
  GroupRig idle = OneActuator(2e5, 2.0, {5e-10, 0.3});
  ReservoirSource source = Pumped(1e5, 4e5);
  Response r = Simulate(RigOf(source, {idle}), Until(100.0, 1.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone);
  EXPECT_NEAR(r.source_pressure_pa[10], 2e5, 0.1);
  EXPECT_EQ(r.source_final_pressure_pa, 4e5);
  EXPECT_NEAR(r.compressor_on_s, 30.0, 1e-6);
  EXPECT_NEAR(r.compressor_air_m3, 3e-3, 1e-10);
  EXPECT_NEAR(r.compressor_energy_j, 30.0 * 60.0, 1e-4);
  EXPECT_LT(r.steps, 100u);

  // At half duty, two pumps take as long, and each runs half of the time.
  source.duty = 0.5;
  source.compressor_count = 2;
  r = Simulate(RigOf(source, {idle}), Until(100.0));
  EXPECT_NEAR(r.compressor_on_s, 15.0, 1e-6);
  EXPECT_NEAR(r.compressor_energy_j, 2 * 15.0 * 60.0, 1e-4);

  // The end of the table stops it too.
  source = Pumped(1e5, kInf);
  r = Simulate(RigOf(source, {idle}), Until(100.0));
  EXPECT_EQ(r.source_final_pressure_pa, 6e5);
  EXPECT_NEAR(r.compressor_on_s, 50.0, 1e-6);
}

TEST(SimulateSource, CompressorCoversASmallDrawAtTheStopPressure) {
  // The draw of a choked line at 4 bar, 0.04 L/s, is below the delivery of 0.1 L/s.
  GroupRig group = OneActuator(3e5, 1.0, {1e-10, 0.5});
  group.chamber.rest_volume_m3 = 1.0;  // stays near ambient
  group.schedule = {{0.0, kInflate}};
  const Response r = Simulate(RigOf(Pumped(4e5, 4e5), {group}), Until(50.0, 10.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone);
  for (const double p : r.source_pressure_pa) ASSERT_EQ(p, 4e5);
  EXPECT_NEAR(r.compressor_on_s, 0.4 * 50.0, 1e-6);
  EXPECT_NEAR(r.compressor_air_m3, 50.0 * 4e-5, 1e-10);
  EXPECT_LT(r.steps, 100u);
}

TEST(SimulateSource, ReservoirAboveTheStopPressureDrainsBeforeThePumpRuns) {
  GroupRig group = OneActuator(3e5, 1.0, {1e-9, 0.5});
  group.chamber.rest_volume_m3 = 1.0;
  group.schedule = {{0.0, kInflate}};
  const Response r = Simulate(RigOf(Pumped(5e5, 4e5), {group}), Until(60.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone);
  // Choked: ps' = −c·ps down to 4 bar with c = C·P0/V = 0.1/s, then towards 0.1/(1e-9·1e8) = 1 bar;
  // it ends subsonic, so only the time to 4 bar is checked, by the time the pump has run.
  EXPECT_NEAR(r.compressor_on_s, 60.0 - std::log(5.0 / 4.0) / 0.1, 1e-5);
}

// The pumps' time and energy from pressure to pressure: κ·t = V·∫ dp/Q and E = ∫ P dt, summed in
// small steps; the stop pressure inside the table, at its end, and at the rating.
TEST(SimulateSource, CompressorStopsOnTime) {
  GroupRig busy = OneActuator(2e5, 2.0, {5e-10, 0.3});  // vents meanwhile
  busy.initial_pressure_pa = 2e5;
  busy.schedule = {{0.0, kDeflate}};
  for (const auto& [stop_pa, rating_pa] : {std::pair{4.3e5, 6e5}, {5e5, 6e5}, {4.3e5, 4.3e5}}) {
    SCOPED_TRACE(stop_pa);
    ReservoirSource source = Pumped(4e5, stop_pa);
    source.compressor.free_air_m3_per_s =
        MonotoneCurve({1e5, 2e5, 3.5e5, 5e5}, {1e-4, 0.8e-4, 0.4e-4, 0.1e-4});
    source.compressor.current_a = MonotoneCurve({1e5, 3.5e5, 5e5}, {3.0, 6.0, 4.0});
    source.compressor.pressure_max_pa = rating_pa;
    const CompressorCurve& curve = source.compressor;
    constexpr int kSteps = 200'000;
    const double step_pa = (stop_pa - 4e5) / kSteps;
    double on_s = 0.0, energy_j = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double p = 4e5 + (i + 0.5) * step_pa;
      const double dt_s = source.volume_m3 * step_pa / (1e5 * curve.free_air_m3_per_s(p));
      on_s += dt_s;
      energy_j += dt_s * 12.0 * curve.current_a(p);
    }
    for (bool vents : {false, true}) {
      if (!vents) busy.schedule.clear();
      const Response r = Simulate(RigOf(source, {busy}), Until(2.0 * on_s));
      ASSERT_EQ(r.status, SimulateStatus::kDone);
      EXPECT_EQ(r.source_final_pressure_pa, stop_pa);
      EXPECT_NEAR(r.compressor_on_s, on_s, 1e-6 * on_s);
      EXPECT_NEAR(r.compressor_energy_j, energy_j, 1e-6 * energy_j);
      busy.schedule = {{0.0, kDeflate}};
    }
  }
}

// An actuator that rides with a reservoir which slow pumps fill is nearer to equal pressures than
// steps are exact, right where the line's flow bends: both rise by what the pumps deliver, and the
// bend takes no steps without end.
TEST(SimulateSource, AnActuatorRidesOnABendOfItsLine) {
  GroupRig group = OneActuator(6e5, 1.0, {5e-10, 0.3});
  group.initial_pressure_pa = 3e5;
  group.schedule = {{0.0, kInflate}};
  SimulateOptions options = Until(5.0);
  options.linear_ratio = 1.0 - 1e-9;
  const double bend_m3_per_s = 5e-10 * 3e5 * std::sqrt(2e-9 / (1.0 - 0.3));
  ReservoirSource source = Pumped(3e5, 6e5);
  const double pump_m3_per_s = 0.7 * bend_m3_per_s * 1.05e-3 / 50e-6;
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 6e5}, {pump_m3_per_s, pump_m3_per_s});
  const Response r = Simulate(RigOf(source, {group}), options);
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  EXPECT_LT(r.steps, 80'000u);
  EXPECT_NEAR(r.source_final_pressure_pa, 3e5 + 5.0 * 1e5 * pump_m3_per_s / 1.05e-3, 0.03);
  EXPECT_NEAR(r.groups[0].final_pressure_pa, r.source_final_pressure_pa, 0.03);
}

// The volume while the pressure rises: the same volume changes nothing, a smaller one fills in
// proportion faster and leaves the fall alone.
TEST(SimulateSource, VolumeWhileRisingCountsOnlyWhileRising) {
  GroupRig group = OneActuator(2e5, 2.0, {2e-8, 0.3});
  group.count = 4;
  group.close_at_operating = true;
  group.schedule = {{0.0, kInflate}};
  const auto run = [&](double rising_m3) {
    ReservoirSource source = Pumped(4e5, 4e5);
    source.volume_rising_m3 = rising_m3;
    return Simulate(RigOf(source, {group}), Until(20.0));
  };
  const Response none = run(0.0), same = run(1e-3), half = run(0.5e-3);
  ASSERT_EQ(half.status, SimulateStatus::kDone);
  EXPECT_EQ(same.compressor_on_s, none.compressor_on_s);
  EXPECT_EQ(same.strokes[0].to_target_s, none.strokes[0].to_target_s);
  EXPECT_EQ(same.source_final_pressure_pa, 4e5);
  EXPECT_EQ(half.source_final_pressure_pa, 4e5);

  // The draw is above the delivery all through the stroke, so the reservoir only falls then.
  const double inflate_s = none.strokes[0].to_operating_s;
  EXPECT_EQ(half.strokes[0].to_operating_s, inflate_s);
  EXPECT_EQ(half.strokes[0].source_lowest_pressure_pa, none.strokes[0].source_lowest_pressure_pa);
  EXPECT_LT(none.strokes[0].source_lowest_pressure_pa, 3.6e5);
  EXPECT_NEAR(half.compressor_on_s - inflate_s, 0.5 * (none.compressor_on_s - inflate_s), 1e-6);

  // A closed reservoir that only rises: 1 L takes 30 s from 1 to 4 bar at 0.1 L/s, ½ L half of it.
  ReservoirSource source = Pumped(1e5, 4e5);
  source.volume_rising_m3 = 0.5e-3;
  group.schedule.clear();
  EXPECT_NEAR(Simulate(RigOf(source, {group}), Until(100.0)).compressor_on_s, 15.0, 1e-6);
}

}  // namespace simulate_source_test
}  // namespace plenum::model
