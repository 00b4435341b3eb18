// The periodic state against plain simulation until nothing changes.
#include "model/simulate/periodic.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace periodic_test {

using enum ValveState;

constexpr double kUnitC = 1e-8;  // m³/(s·Pa) in 1 dm³/(s·bar)

SimulateOptions Accurate() {
  SimulateOptions options;
  options.relative_tolerance = 1e-10;
  options.absolute_tolerance_pa = 1e-6;
  return options;
}

ReservoirSource Pumped(double volume_m3, double stop_pa, double delivery_m3_per_s) {
  ReservoirSource source{.volume_m3 = volume_m3, .initial_pressure_pa = stop_pa};
  source.compressor.free_air_m3_per_s =
      MonotoneCurve({1e5, 9e5}, {delivery_m3_per_s, 0.4 * delivery_m3_per_s});
  source.compressor.current_a = MonotoneCurve({1e5, 9e5}, {2.0, 6.0});
  source.compressor.voltage_v = 12.0;
  source.compressor.pressure_max_pa = 9e5;
  source.stop_pressure_pa = stop_pa;
  return source;
}

Effect Make(std::string_view id, std::vector<double> parameters) {
  return {FindEffect(id), std::move(parameters)};
}

// A rig and the period after which its commands repeat.
struct Cycling {
  Rig rig;
  double period_s;
};

class RandomRigs {
 public:
  explicit RandomRigs(unsigned seed) : generator_(seed) {}

  Cycling Draw() {
    Cycling drawn;
    drawn.period_s = Uniform(0.4, 2.0);
    const double source_pa = Uniform(2.5e5, 5e5);
    if (Coin(0.4)) {
      RegulatedSource source = Regulated(source_pa);
      if (Coin()) source.regulator = FlowElement{Uniform(0.1, 0.5) * kUnitC, 0.3};
      drawn.rig.source = source;
    } else {
      ReservoirSource source = Pumped(Uniform(0.3e-3, 1.5e-3), source_pa, Uniform(0.5e-4, 8e-4));
      source.duty = Coin() ? 1.0 : Uniform(0.5, 1.0);
      drawn.rig.source = source;
    }
    const int groups = 1 + static_cast<int>(Uniform(0.0, 2.99));
    for (int i = 0; i < groups; ++i) drawn.rig.groups.push_back(Group(drawn.period_s));
    return drawn;
  }

 private:
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  bool Coin(double chance = 0.5) { return Uniform(0.0, 1.0) < chance; }

  GroupRig Group(double period_s) {
    GroupRig group = OneActuator(Uniform(1.5e5, 2.4e5), Uniform(1.2, 2.5),
                                 {Uniform(0.03, 0.2) * kUnitC, Uniform(0.1, 0.5)});
    group.count = 1 + static_cast<int>(Uniform(0.0, 2.99));
    group.close_at_operating = Coin();
    const double phase = Coin() ? 0.0 : Uniform(0.0, 1.0);
    const double share = Uniform(0.3, 0.7);
    // Inflate, deflate, and now and then hold in between; wrapped into one period.
    std::vector<ValveCommand> commands = {{phase, kInflate}, {phase + share, kDeflate}};
    if (Coin(0.3)) commands.push_back({phase + 0.8 * share, kHold});
    for (ValveCommand& c : commands) c.time_s = period_s * (c.time_s - std::floor(c.time_s));
    std::sort(commands.begin(), commands.end(),
              [](const ValveCommand& a, const ValveCommand& b) { return a.time_s < b.time_s; });
    group.schedule = commands;
    if (Coin(0.3)) group.effects.push_back(Make("hysteresis", {Uniform(500.0, 6e3)}));
    if (Coin(0.4)) group.effects.push_back(Make("creep", {Uniform(0.05, 0.3), Uniform(0.2, 4.0)}));
    if (Coin(0.4)) group.effects.push_back(Make("heat_transfer", {Uniform(0.1, 3.0)}));
    if (Coin(0.4)) group.effects.push_back(Make("valve_ramp", {Uniform(0.01, 0.15)}));
    if (Coin(0.3)) group.effects.push_back(Make("supply_droop", {2e-4, 0.08 * kUnitC, 0.3}));
    if (Coin(0.3)) group.effects.push_back(Make("valve_delay", {Uniform(0.005, 0.15)}));
    return group;
  }

  std::mt19937 generator_;
};

// The same commands for `cycles` periods.
Rig Repeated(const Cycling& cycling, int cycles) {
  Rig rig = cycling.rig;
  for (std::size_t i = 0; i < rig.groups.size(); ++i) {
    rig.groups[i].schedule.clear();
    for (int k = 0; k < cycles; ++k) {
      for (const ValveCommand& c : cycling.rig.groups[i].schedule) {
        rig.groups[i].schedule.push_back({c.time_s + k * cycling.period_s, c.state});
      }
    }
  }
  return rig;
}

// A long simulation, made longer until the last periods begin alike: its strokes and how many
// periods it took.
struct Settled {
  Response response;
  int cycles;
  double change_pa;  // still, in seven periods
};

Settled SimulateUntilSettled(const Cycling& cycling) {
  SimulateOptions options = Accurate();
  for (int cycles = 100;; cycles *= 4) {
    options.end_s = cycles * cycling.period_s;
    options.steps_max = 500 * cycles * cycling.rig.groups.size();
    Settled settled = {Simulate(Repeated(cycling, cycles), options), cycles, 0.0};
    const std::vector<Stroke>& strokes = settled.response.strokes;
    const std::size_t each = strokes.size() / cycles;
    for (std::size_t i = strokes.size() - 8 * each; i < strokes.size() - 7 * each; ++i) {
      const Stroke& later = strokes[i + 7 * each];
      settled.change_pa = std::max(
          settled.change_pa, std::abs(strokes[i].start_pressure_pa - later.start_pressure_pa));
      if (settled.response.source_final_pressure_pa == 0.0) continue;
      settled.change_pa = std::max(settled.change_pa, std::abs(strokes[i].source_start_pressure_pa -
                                                               later.source_start_pressure_pa));
    }
    if (settled.change_pa < 1e-4 || cycles >= 1600) return settled;  // Pa
  }
}

TEST(Periodic, IsWhatSimulationSettlesTo) {
#ifdef PLENUM_SANITIZED
  constexpr int kRigs = 4;
#else
  constexpr int kRigs = 25;
#endif
  RandomRigs rigs(7);
  int most = 0, all = 0, longest = 0, restless = 0;
  for (int k = 0; k < kRigs; ++k) {
    SCOPED_TRACE(k);
    const Cycling cycling = rigs.Draw();
    const PeriodicState state = FindPeriodicState(cycling.rig, cycling.period_s, Accurate());
    const auto [settled, cycles, change_pa] = SimulateUntilSettled(cycling);
    ASSERT_EQ(settled.status, SimulateStatus::kDone) << settled.detail;
    if (state.status == PeriodicStatus::kNotConverged && change_pa > 1e3) {
      ++restless;  // nor does the simulation repeat each period
      continue;
    }
    ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
    most = std::max(most, state.cycles), all += state.cycles;
    EXPECT_LE(state.residual, 1e-9);
    longest = std::max(longest, cycles);
    for (std::size_t i = 0; i < cycling.rig.groups.size(); ++i) {
      const double expected_pa = settled.groups[i].final_pressure_pa;
      EXPECT_NEAR(state.response.groups[i].final_pressure_pa, expected_pa, 1e-7 * expected_pa);
    }
    const double source_pa = settled.source_final_pressure_pa;
    EXPECT_NEAR(state.response.source_final_pressure_pa, source_pa, 1e-7 * source_pa);

    // Strokes of the last period but one: those of the last are cut off by the end.
    const std::vector<Stroke>& strokes = state.response.strokes;
    ASSERT_EQ(settled.strokes.size(), cycles * strokes.size());
    const Stroke* expected = &settled.strokes[(cycles - 2) * strokes.size()];
    double worst_s = 0.0;
    for (std::size_t i = 0; i < strokes.size(); ++i, ++expected) {
      EXPECT_EQ(strokes[i].group, expected->group);
      EXPECT_EQ(strokes[i].state, expected->state);
      EXPECT_NEAR(strokes[i].command_s, expected->command_s - (cycles - 2) * cycling.period_s,
                  1e-9);
      EXPECT_NEAR(strokes[i].start_pressure_pa / expected->start_pressure_pa, 1.0, 1e-7);
      EXPECT_NEAR(strokes[i].source_lowest_pressure_pa / expected->source_lowest_pressure_pa, 1.0,
                  1e-7);
      if (std::isfinite(expected->to_target_s)) {
        EXPECT_NEAR(strokes[i].to_target_s, expected->to_target_s, 1e-7 * cycling.period_s);
      } else {
        EXPECT_EQ(strokes[i].to_target_s, expected->to_target_s);
      }
      if (expected->state == kInflate) worst_s = std::max(worst_s, strokes[i].to_target_s);
    }
    EXPECT_EQ(state.all.rise->to_target_s, worst_s);
  }
  EXPECT_LE(restless, 2);
  std::printf("%d rigs: %.1f cycles on average, %d at most; simulation up to %d\n",
              kRigs - restless, static_cast<double>(all) / (kRigs - restless), most, longest);
}

// Closed form: 50 mL, V(p) = V0·p/p_a, twice the ambient pressure: 150 mL ANR a stroke.
TEST(Periodic, TheCompressorRunsForTheAirOfOneCycle) {
  GroupRig group = OneActuator(2e5, 2.0, {1e-9, 0.3});
  group.count = 3;
  group.close_at_operating = true;
  group.schedule = {{0.0, kInflate}, {2.0, kDeflate}};
  ReservoirSource source = Pumped(1e-3, 4e5, 5e-4);
  source.compressor.free_air_m3_per_s = MonotoneCurve({1e5, 9e5}, {5e-4, 5e-4});
  const PeriodicState state = FindPeriodicState(RigOf(source, {group}), 4.0, Accurate());
  ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
  EXPECT_NEAR(state.air_drawn_m3, 450e-6, 1e-9);
  EXPECT_NEAR(state.compressor_air_m3, 450e-6, 1e-9);
  EXPECT_NEAR(state.compressor_duty, 450e-6 / 5e-4 / 4.0, 1e-6);
  EXPECT_LT(state.source_lowest_pressure_pa, 4e5);
  EXPECT_EQ(state.source_lowest_pressure_pa, state.response.strokes[0].source_lowest_pressure_pa);
}

TEST(Periodic, WhatIsDeliveredIsVentedOrLeaks) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.schedule = {{0.3, kInflate}, {1.1, kDeflate}};
  group.effects = {Make("creep", {0.2, 3.0}), Make("leak", {1e-11, 0.3})};
  GroupRig other = OneActuator(1.8e5, 1.5, {8e-10, 0.2});
  other.schedule = {{0.9, kInflate}, {1.4, kDeflate}};
  const Rig rig = RigOf(Pumped(2e-3, 4e5, 2e-4), {group, other});
  const PeriodicState state = FindPeriodicState(rig, 1.5, Accurate());
  ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
  double lost_m3 = 0.0;
  for (const GroupResponse& g : state.response.groups) lost_m3 += g.air_out_m3 + g.air_leaked_m3;
  EXPECT_GT(state.response.groups[0].air_leaked_m3, 1e-7);
  EXPECT_NEAR(state.compressor_air_m3 / lost_m3, 1.0, 1e-7);
  EXPECT_NEAR(state.air_drawn_m3 / lost_m3, 1.0, 1e-7);
}

// A rig whose valves hold at the start of the period: its initial state is all it remembers.
TEST(Periodic, TheStateIsAStartThatRepeats) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.schedule = {{0.1, kInflate}, {0.8, kDeflate}, {1.1, kHold}};
  Rig rig = RigOf(Pumped(1e-3, 5e5, 1e-4), {group});
  const PeriodicState state = FindPeriodicState(rig, 1.2, Accurate());
  ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
  ASSERT_EQ(state.state.size(), 2u);
  rig.groups[0].initial_pressure_pa = state.state[0];
  std::get<ReservoirSource>(rig.source).initial_pressure_pa = state.state[1];
  SimulateOptions options = Accurate();
  options.end_s = 1.2;
  const Response response = Simulate(rig, options);
  EXPECT_NEAR(response.groups[0].final_pressure_pa / state.state[0], 1.0, 1e-9);
  EXPECT_NEAR(response.source_final_pressure_pa / state.state[1], 1.0, 1e-9);
}

TEST(Periodic, FindsSlowModesInFewCycles) {
  GroupRig slow = OneActuator(2e5, 2.0, {5e-10, 0.3});
  slow.schedule = {{0.0, kInflate}, {0.5, kDeflate}};
  GroupRig slower = slow;
  slow.effects = {Make("creep", {0.3, 40.0})};
  slower.effects = {Make("creep", {0.2, 100.0})};
  const Rig rig = RigOf(Pumped(5e-3, 6e5, 3e-4), {slow, slower});
  PeriodicOptions plain;
  plain.depth = 0;
  plain.cycles_max = 5000;
  const PeriodicState quick = FindPeriodicState(rig, 1.0, Accurate());
  const PeriodicState steady = FindPeriodicState(rig, 1.0, Accurate(), plain);
  ASSERT_EQ(quick.status, PeriodicStatus::kConverged) << quick.detail;
  ASSERT_EQ(steady.status, PeriodicStatus::kConverged) << steady.detail;
  std::printf("%d cycles, plain iteration %d\n", quick.cycles, steady.cycles);
  EXPECT_LT(10 * quick.cycles, steady.cycles);
  // Plain iteration stops where a step is 1e-9, a hundred times nearer than it is.
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(
        quick.response.groups[i].final_pressure_pa / steady.response.groups[i].final_pressure_pa,
        1.0, 1e-7);
  }
  EXPECT_NEAR(quick.all.rise->to_target_s, steady.all.rise->to_target_s, 1e-6);
}

TEST(Periodic, AWeakPumpLeavesStrokesIncomplete) {
  GroupRig group = OneActuator(2e5, 2.0, {5e-10, 0.3});
  group.count = 4;
  group.exhaust = {{4e-9, 0.3}};
  group.schedule = {{0.0, kInflate}, {1.0, kDeflate}};
  const Rig rig = RigOf(Pumped(1e-3, 5e5, 1e-4), {group});
  const PeriodicState state = FindPeriodicState(rig, 2.0, Accurate());
  ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
  EXPECT_EQ(state.groups[0].rise->to_target_s, kInf);
  EXPECT_TRUE(std::isfinite(state.groups[0].fall->to_target_s));
  EXPECT_NEAR(state.compressor_duty, 1.0, 1e-12);
  EXPECT_NEAR(state.compressor_air_m3 / state.response.groups[0].air_out_m3, 1.0, 1e-7);
}

TEST(Periodic, AStrokeMayEndInTheNextPeriod) {
  GroupRig group = OneActuator(2e5, 2.0, {1e-9, 0.3});
  group.close_at_operating = true;
  group.schedule = {{2.0, kDeflate}, {3.9, kInflate}};
  Rig rig = RigOf(Regulated(4e5), {group});
  const PeriodicState state = FindPeriodicState(rig, 4.0, Accurate());
  ASSERT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
  ASSERT_EQ(state.response.strokes.size(), 2u);
  rig.groups[0].initial_pressure_pa = state.response.strokes[1].start_pressure_pa;
  rig.groups[0].schedule = {{0.0, kInflate}};
  SimulateOptions options = Accurate();
  options.end_s = 2.0;
  const double rise_s = Simulate(rig, options).strokes[0].to_target_s;
  EXPECT_GT(rise_s, 0.1);
  EXPECT_NEAR(state.all.rise->to_target_s, rise_s, 1e-7);
  EXPECT_EQ(state.all.rise->command_s, 3.9);
}

// A delay longer than the period only shifts the strokes.
TEST(Periodic, CarriesDelayedCommandsOverThePeriodsEnd) {
  GroupRig group = OneActuator(2e5, 2.0, {2e-9, 0.3});
  group.chamber.rest_volume_m3 = 5e-6;
  group.schedule = {{0.2, kInflate}, {0.7, kDeflate}};
  const auto worst = [&](const GroupRig& g) {
    const PeriodicState state = FindPeriodicState(RigOf(Regulated(4e5), {g}), 1.0, Accurate());
    EXPECT_EQ(state.status, PeriodicStatus::kConverged) << state.detail;
    return state;
  };
  const PeriodicState prompt = worst(group);
  group.effects = {Make("valve_delay", {3.0})};
  const PeriodicState delayed = worst(group);
  EXPECT_NEAR(delayed.response.groups[0].air_in_m3 / prompt.response.groups[0].air_in_m3, 1.0,
              1e-8);
  EXPECT_NEAR(delayed.response.groups[0].final_pressure_pa,
              prompt.response.groups[0].final_pressure_pa, 1e-3);
  group.effects = {Make("valve_delay", {0.25})};
  const PeriodicState late = worst(group);
  EXPECT_NEAR(late.all.rise->to_target_s, prompt.all.rise->to_target_s + 0.25, 1e-7);
}

// A command to inflate that comes before the delayed valve has vented finds the operating pressure
// still there and closes at once: some periods do not fill. No state repeats each period.
TEST(Periodic, SaysThatARigDoesNotRepeatEachPeriod) {
  GroupRig group = OneActuator(1.6e5, 2.0, {1.5e-9, 0.3});
  group.close_at_operating = true;
  group.schedule = {{0.0, kInflate}, {1.1, kDeflate}};
  group.effects = {Make("valve_delay", {0.4})};
  Cycling cycling = {RigOf(Regulated(3e5), {group}), 1.2};
  PeriodicOptions few;
  few.cycles_max = 60;
  const PeriodicState state = FindPeriodicState(cycling.rig, cycling.period_s, {}, few);
  EXPECT_EQ(state.status, PeriodicStatus::kNotConverged);
  EXPECT_NE(state.detail.find("after 60 cycles"), std::string::npos) << state.detail;
  SimulateOptions options;
  options.end_s = 100 * cycling.period_s;
  const Response response = Simulate(Repeated(cycling, 100), options);
  double lowest_pa = kInf, highest_pa = 0.0;  // at the commands to inflate of the last periods
  for (std::size_t i = 180; i < 200; i += 2) {
    lowest_pa = std::min(lowest_pa, response.strokes[i].start_pressure_pa);
    highest_pa = std::max(highest_pa, response.strokes[i].start_pressure_pa);
  }
  EXPECT_GT(highest_pa - lowest_pa, 1e4);
}

TEST(Periodic, SaysWhyNot) {
  GroupRig group = OneActuator(2e5, 2.0, {1e-9, 0.3});
  group.schedule = {{0.0, kInflate}, {1.0, kDeflate}};
  const Rig rig = RigOf(Regulated(4e5), {group});
  const PeriodicState late = FindPeriodicState(rig, 1.0, {});
  EXPECT_EQ(late.status, PeriodicStatus::kInvalid);
  EXPECT_NE(late.detail.find("command at 1 s, must be below the period"), std::string::npos);
  EXPECT_EQ(FindPeriodicState(rig, -1.0, {}).status, PeriodicStatus::kInvalid);
  SimulateOptions cancelled;
  cancelled.cancelled = [] { return true; };
  EXPECT_EQ(FindPeriodicState(rig, 2.0, cancelled).status, PeriodicStatus::kCancelled);
  SimulateOptions few;
  few.steps_max = 2;
  EXPECT_EQ(FindPeriodicState(rig, 2.0, few).status, PeriodicStatus::kFailed);
}

}  // namespace periodic_test
}  // namespace plenum::model
