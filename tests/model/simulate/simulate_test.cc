#include "model/simulate/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace simulate_test {

using enum ValveState;

// Reference values of the normalised model, computed independently (times in units of V0/(C·P0)).
struct Oracle {
  double source, operating, expansion, b, rise, fall;
};
constexpr Oracle kOracles[] = {
    {3.0, 2.0, 2.0, 0.30, 1.066905, 2.459439}, {2.2, 2.0, 2.0, 0.30, 1.809829, 2.459439},
    {1.5, 1.3, 1.2, 0.20, 0.544652, 0.964523}, {6.0, 2.0, 1.0, 0.30, 0.166679, 0.869134},
    {6.0, 5.0, 1.5, 0.30, 1.225728, 2.328377}, {2.0, 1.7, 1.5, 0.60, 0.826105, 1.297414}};

TEST(Simulate, FullStrokesAgreeWithTheOracles) {
  for (const Oracle& row : kOracles) {
    const FlowElement element{50e-6 / 1e5, row.b};  // one second is one unit of time
    const Rig rig = RigOf(Regulated(row.source * 1e5),
                          {OneActuator(row.operating * 1e5, row.expansion, element)});
    SimulateOptions options;
    options.rise_fraction = 1.0;
    const FullStroke stroke = FullStrokes(rig, options)[0];
    EXPECT_NEAR(stroke.rise_time_s, row.rise, 2e-6 * row.rise);
    EXPECT_NEAR(stroke.fall_time_s, row.fall, 2e-6 * row.fall);
    EXPECT_NEAR(stroke.frequency_max_hz, 1.0 / (row.rise + row.fall), 2e-6);
  }
}

TEST(Simulate, ScheduledStrokesAgreeWithTheOracles) {
  for (const Oracle& row : kOracles) {
    GroupRig group = OneActuator(row.operating * 1e5, row.expansion, {50e-6 / 1e5, row.b});
    group.schedule = {{0.25, kInflate}, {7.0, kDeflate}};
    group.close_at_operating = true;
    SimulateOptions options = Until(12.0);
    options.rise_fraction = 1.0;
    const Response response = Simulate(RigOf(Regulated(row.source * 1e5), {group}), options);
    ASSERT_EQ(response.status, SimulateStatus::kDone) << response.detail;
    ASSERT_EQ(response.strokes.size(), 2u);
    EXPECT_NEAR(response.strokes[0].to_target_s, row.rise, 2e-6 * row.rise);
    EXPECT_NEAR(response.strokes[0].to_operating_s, row.rise, 2e-6 * row.rise);
    EXPECT_NEAR(response.strokes[1].start_pressure_pa, row.operating * 1e5, 1e-6);
    EXPECT_NEAR(response.strokes[1].to_target_s, row.fall, 2e-6 * row.fall);
  }
}

// A closed 1 L tank through C = 1 dm³/(s·bar), b = 0.3, out of 7 bar to 6.8 bar, worked out by
// hand: choked up to 2.1 bar in (2.1 − 1)/7 s, then 0.7·(asin(0.959184) − 0) s.
TEST(Simulate, FillsARigidTank) {
  GroupRig tank = OneActuator(6.8e5, 1.0, {1e-8, 0.3});
  tank.chamber.rest_volume_m3 = 1e-3;
  SimulateOptions options;
  options.rise_fraction = 1.0;
  const double expected = (2.1 - 1.0) / 7.0 + 0.7 * std::asin((6.8 / 7.0 - 0.3) / 0.7);
  EXPECT_NEAR(FullStrokes(RigOf(Regulated(7e5), {tank}), options)[0].rise_time_s, expected, 1e-6);
}

// Published times for 1 L through C = 1 dm³/(s·bar), b = 0.3, 6 bar gauge: 1.10 s to 98 %, 1.98 s
// down to 2 %; 1.100 and 1.976 s by an independent integration.
TEST(Simulate, FillsAndEmptiesTheTankOfTheLiterature) {
  GroupRig tank = OneActuator(701.3e3, 1.0, {1e-8, 0.3});
  tank.chamber.rest_volume_m3 = 1e-3;
  tank.chamber.ambient_pressure_pa = 101.3e3;
  Rig rig = RigOf(Regulated(701.3e3), {tank});
  rig.ambient.pressure_pa = 101.3e3;
  SimulateOptions options;
  options.rise_fraction = 0.98;
  options.fall_fraction = 0.02;
  const FullStroke stroke = FullStrokes(rig, options)[0];
  EXPECT_NEAR(stroke.rise_time_s, 1.100, 0.005 * 1.100);
  EXPECT_NEAR(stroke.fall_time_s, 1.976, 0.005 * 1.976);
}

TEST(Simulate, GasIsConservedOverCycles) {
  GroupRig a = OneActuator(2e5, 2.0, {5e-10, 0.3});
  GroupRig b = OneActuator(1.6e5, 1.5, {8e-10, 0.2});
  a.count = 3;
  a.close_at_operating = true;
  a.schedule = CycleSchedule(0.2, 0.5, 4);
  b.schedule = CycleSchedule(0.25, 0.4, 5, 0.3);
  ReservoirSource source{.volume_m3 = 2e-3, .initial_pressure_pa = 4e5};
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 5e5}, {2e-4, 5e-5});
  source.compressor.pressure_max_pa = 5e5;
  source.stop_pressure_pa = 4e5;
  const Response r = Simulate(RigOf(source, {a, b}), Until(20.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone) << r.detail;
  double vented = 0.0;
  double crossed = 0.0;
  // Chamber by chamber: what went in less what came out is what is there.
  for (std::size_t i = 0; i < 2; ++i) {
    const GroupRig& g = i == 0 ? a : b;
    const double v0 = 50e-6, p = r.groups[i].final_pressure_pa;
    const double k = (g.chamber.expansion_ratio - 1.0) / (g.chamber.operating_pressure_pa - 1e5);
    const double stored = g.count * (p * v0 * (1.0 + k * (p - 1e5)) - 1e5 * v0) / 1e5;
    EXPECT_NEAR(r.groups[i].air_in_m3 - r.groups[i].air_out_m3, stored,
                2e-8 * r.groups[i].air_in_m3);
    crossed += r.groups[i].air_in_m3;
    vented += r.groups[i].air_out_m3;
  }
  const double drawn_from_store = 2e-3 * (4e5 - r.source_final_pressure_pa) / 1e5;
  EXPECT_NEAR(r.compressor_air_m3 + drawn_from_store, crossed, 1e-9 * crossed);
  EXPECT_GT(vented, 3.0 * 3 * 150e-6);  // four strokes of 150 mL by three actuators, less one
}

TEST(Simulate, ClosesAtTheOperatingPressureAndHoldsIt) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.close_at_operating = true;
  group.schedule = CycleSchedule(0.1, 0.5, 3);
  const Response r = Simulate(RigOf(Regulated(4e5), {group}), Until(30.0, 100.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone);
  for (const double start_s : {0.0, 10.0, 20.0}) {
    const auto first = static_cast<std::size_t>((start_s + 2.0) * 100);
    for (std::size_t i = first; i < first + 300; ++i) {
      ASSERT_NEAR(r.groups[0].pressure_pa[i], 2e5, 1e-6 * 2e5);
    }
  }
  for (const double p : r.groups[0].pressure_pa) ASSERT_LE(p, 2e5 * (1.0 + 1e-9));
}

TEST(Simulate, CrackingPressureStaysInTheActuator) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3, 0.5, 3e3});
  group.exhaust.push_back({1e-9, 0.2, 0.5, 2e3});
  group.schedule = {{0.0, kInflate}, {10.0, kDeflate}};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(30.0, 1.0));
  ASSERT_EQ(r.status, SimulateStatus::kDone);
  EXPECT_NEAR(r.groups[0].pressure_pa[10], 3e5 - 3e3, 1.0);
  EXPECT_NEAR(r.groups[0].final_pressure_pa, 1e5 + 5e3, 1.0);
}

TEST(Simulate, SamplesHaveTheirShapes) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.chamber.dead_volume_m3 = 7e-6;
  group.schedule = {{0.0, kInflate}, {0.5, kHold}};
  Rig rig = RigOf(Regulated(3e5), {group, group});
  Response r = Simulate(rig, Until(1.05, 10.0));
  ASSERT_EQ(r.t_s.size(), 12u);
  EXPECT_EQ(r.t_s.front(), 0.0);
  EXPECT_NEAR(r.t_s[3], 0.3, 1e-15);
  EXPECT_EQ(r.t_s.back(), 1.05);
  ASSERT_EQ(r.groups.size(), 2u);
  for (const GroupResponse& g : r.groups) {
    ASSERT_EQ(g.pressure_pa.size(), 12u);
    ASSERT_EQ(g.volume_m3.size(), 12u);
    EXPECT_NEAR(g.volume_m3[0], 50e-6, 1e-15);
    EXPECT_EQ(g.pressure_pa.back(), g.final_pressure_pa);
    EXPECT_EQ(g.pressure_pa[5], g.pressure_pa.back());  // the hold begins at the sample
  }
  EXPECT_THAT(r.source_pressure_pa, ::testing::Each(3e5));
  EXPECT_EQ(r.source_pressure_pa.size(), 12u);

  EXPECT_EQ(Simulate(rig, Until(1.0, 10.0)).t_s.size(), 11u);
  EXPECT_TRUE(Simulate(rig, Until(1.0)).t_s.empty());
  rig.source = NoSource{};
  r = Simulate(rig, Until(1.0, 10.0));
  EXPECT_TRUE(r.source_pressure_pa.empty());
  EXPECT_THAT(r.groups[0].pressure_pa, ::testing::Each(1e5));
  EXPECT_TRUE(std::isnan(r.strokes[0].source_start_pressure_pa));
}

TEST(Simulate, LongHoldsAreCheap) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-9, 0.3});
  group.schedule = {{0.0, kInflate}, {1e5, kDeflate}, {2e5, kHold}};
  const Response r = Simulate(RigOf(Regulated(3e5), {group}), Until(1e6));
  EXPECT_EQ(r.status, SimulateStatus::kDone);
  EXPECT_LT(r.steps, 400u);
}

TEST(Simulate, StopsWhenAskedAndWhenStepsRunOut) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.schedule = CycleSchedule(0.2, 0.5, 100);
  const Rig rig = RigOf(Regulated(3e5), {group});
  SimulateOptions options = Until(500.0, 10.0);
  int asked = 0;
  options.cancelled = [&] { return ++asked > 3; };
  Response r = Simulate(rig, options);
  EXPECT_EQ(r.status, SimulateStatus::kCancelled);
  EXPECT_THAT(r.detail, ::testing::HasSubstr("t ="));
  EXPECT_GT(r.t_s.size(), 10u);
  EXPECT_LT(r.t_s.size(), 5000u);

  options.cancelled = nullptr;
  options.steps_max = 20;
  r = Simulate(rig, options);
  EXPECT_EQ(r.status, SimulateStatus::kTooManySteps);
  EXPECT_THAT(r.detail, ::testing::HasSubstr("20 steps"));
  EXPECT_EQ(r.steps, 20u);

  // Many samples a step are work, too.
  options = Until(500.0, 2000.0);
  asked = 0;
  options.cancelled = [&] { return ++asked > 3; };
  r = Simulate(rig, options);
  EXPECT_EQ(r.status, SimulateStatus::kCancelled);
  EXPECT_LT(r.steps, 3u * 64u);
  EXPECT_LT(r.t_s.size(), 100'000u);
}

TEST(Simulate, NeverReachedIsInfinite) {
  const GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  const FullStroke weak = FullStrokes(RigOf(Regulated(1.8e5), {group}), {})[0];
  EXPECT_EQ(weak.rise_time_s, kInf);
  EXPECT_EQ(weak.frequency_max_hz, 0.0);
  EXPECT_LT(weak.fall_time_s, 10.0);
  const ReservoirSource small{.volume_m3 = 50e-6, .initial_pressure_pa = 3e5};
  EXPECT_EQ(FullStrokes(RigOf(small, {group}), {})[0].rise_time_s, kInf);
}

TEST(Simulate, FullStrokesIgnoreTheSchedule) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  const double plain = FullStrokes(RigOf(Regulated(3e5), {group}), {})[0].rise_time_s;
  group.schedule = CycleSchedule(10.0, 0.5, 3);
  group.initial_pressure_pa = 1.7e5;
  EXPECT_EQ(FullStrokes(RigOf(Regulated(3e5), {group}), {})[0].rise_time_s, plain);
}

// Without strokes the same pressures: the steps differ, since no level is met and no account
// counts.
TEST(Simulate, RecordsPressuresAlone) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.schedule = {{0.1, kInflate}, {2.0, kDeflate}};
  group.close_at_operating = true;
  group.effects = {{FindEffect("sensor_gain"), {1.02}}, {FindEffect("heat_transfer"), {0.3}}};
  const Rig rig = RigOf(ReservoirSource{.volume_m3 = 1e-3, .initial_pressure_pa = 4e5}, {group});
  SimulateOptions options = Until(4.0, 50.0);
  options.relative_tolerance = 1e-10;
  const Response all = Simulate(rig, options);
  options.record = Record::kSamples;
  const Response samples = Simulate(rig, options);
  options.record = Record::kPressures;
  const Response pressures = Simulate(rig, options);
  ASSERT_EQ(pressures.status, SimulateStatus::kDone) << pressures.detail;
  ASSERT_EQ(pressures.t_s, all.t_s);
  for (std::size_t i = 0; i < all.t_s.size(); ++i) {
    for (const Response* r : {&samples, &pressures}) {
      EXPECT_NEAR(r->groups[0].pressure_pa[i], all.groups[0].pressure_pa[i], 0.01);
      EXPECT_NEAR(r->groups[0].reading_pa[i], all.groups[0].reading_pa[i], 0.01);
      EXPECT_NEAR(r->source_pressure_pa[i], all.source_pressure_pa[i], 0.01);
    }
    EXPECT_NEAR(samples.groups[0].temperature_k[i], all.groups[0].temperature_k[i], 1e-4);
  }
  EXPECT_EQ(samples.groups[0].flow_m3_per_s.size(), all.t_s.size());
  EXPECT_GT(all.groups[0].air_drawn_m3, 0.0);
  EXPECT_EQ(samples.groups[0].air_drawn_m3, 0.0);
  EXPECT_TRUE(pressures.groups[0].volume_m3.empty());
  EXPECT_TRUE(pressures.groups[0].flow_m3_per_s.empty());
}

}  // namespace simulate_test
}  // namespace plenum::model
