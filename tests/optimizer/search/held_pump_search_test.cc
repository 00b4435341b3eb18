// Pumps without a reservoir that run on while what they filled holds: against plain enumeration,
// beside those that do not, and before the verifier.
#include <gtest/gtest.h>

#include "optimizer/explain/explained_search.h"
#include "optimizer/sizing/resize.h"
#include "tests/support/drawn_gait.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/pumps/direct_problems.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace held_pump_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::PumpFeed;
using optimizer::Status;

constexpr optimizer::Objective kObjectives[] = {
    {1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.5}, {0.0, 0.0, 1.0, 0.0}};

// Pumps that may run all the time, or nearly, on packs that mostly fit.
Problem Drawn(std::uint64_t seed, int groups, PumpFeed feed) {
  Problem problem = DirectPumpProblem(17000 + seed, 0.01 * static_cast<double>(seed % 10), groups);
  Random random(seed);
  problem.actuations = std::max(1.0, std::round(0.5 * problem.actuations));
  for (model::Compressor& pump : problem.parts.compressors) {
    pump.curve.voltage_v = Chance(random, 0.8) ? 12.0 : 6.0;
    pump.duty_max = Chance(random, 0.7) ? 1.0 : 0.5;
  }
  for (model::Battery& pack : problem.parts.batteries)
    pack.nominal_voltage_v = Chance(random, 0.8) ? 11.1 : 6.0;
  for (model::Valve& valve : problem.parts.valves) {
    if (Chance(random, 0.7)) valve.kind = model::ValveKind::kPair;
    if (Chance(random, 0.9)) valve.pressure_min_pa = kAmbientPa;
  }
  for (optimizer::ActuatorGroup& group : problem.groups)
    group.gait.inflate_fraction = Uniform(random, 0.3, 0.7);
  SetPumpsHoldOn(true, problem);
  return WithFeed(std::move(problem), feed);
}

struct Tally {
  int feasible = 0, infeasible = 0;
};

void Compare(const Problem& problem, Tally& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated& twin) {
    EXPECT_NEAR(design.settings.source_pressure_pa, twin.leaf.point.source_pa,
                1e-6 * twin.leaf.point.source_pa);
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(HeldPumpSearch, ListsWhatEnumerationLists) {
  Tally tally;
  for (int seed = 1; seed <= Draws(24); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(seed, 1, seed % 4 == 0 ? PumpFeed::kPerActuator : PumpFeed::kShared);
    problem.objective = kObjectives[seed % 4];
    Random random(seed);
    if (seed % 5 == 0)  // holding then takes less power than filling
      for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(8));
}

TEST(HeldPumpSearch, GroupsInTurnsAndWithPumpsOfTheirOwn) {
  constexpr PumpFeed kFeeds[] = {PumpFeed::kShared, PumpFeed::kPerGroup, PumpFeed::kPerActuator};
  Tally tally;
  for (int seed = 1; seed <= Draws(18); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(100 + seed, 2, kFeeds[seed % 3]);
    problem.objective = kObjectives[(seed / 3) % 4];
    problem.simultaneous = seed % 3 != 0 && seed % 2 == 0;
    problem.limits.batteries = 2;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(5));
}

TEST(HeldPumpSearch, Gaits) {
  Tally tally;
  for (int seed = 1; seed <= Draws(16); ++seed) {
    SCOPED_TRACE(seed);
    const PumpFeed feed = seed % 2 == 0 ? PumpFeed::kShared : PumpFeed::kPerGroup;
    Problem problem = Drawn(200 + seed, 1 + seed % 2, feed);
    problem.objective = kObjectives[seed % 2];
    problem.limits.batteries = 2;
    Random random(seed);
    DrawGaits(random, problem);
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(4));
}

double Best(Problem problem) {
  problem.count = 1;
  const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
  EXPECT_NE(answer.status, Status::kFeasible);
  return answer.designs.empty() ? optimizer::kUnlimited : answer.designs[0].objective;
}

TEST(HeldPumpSearch, IsNeverLighterThanPumpsThatStop) {
  int compared = 0, heavier = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed, 1 + static_cast<int>(seed % 2), PumpFeed::kShared);
    problem.objective = kObjectives[seed % 2];
    const double held = Best(problem);
    SetPumpsHoldOn(false, problem);
    const double stops = Best(problem);
    EXPECT_GE(held, stops * (1.0 - 1e-9));
    compared += std::isfinite(held);
    heavier += held > stops * (1.0 + 1e-6);
  }
  EXPECT_GT(compared, 8);
  EXPECT_GT(heavier, 4);
}

// Where the window ends as the actuators are full they do not hold, and nothing is held.
TEST(HeldPumpSearch, WithoutTimeToHoldItIsAsPumpsThatStop) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed, 1, PumpFeed::kShared);
    problem.objective = {.energy_wh = 1.0};
    problem.count = 1;
    SetPumpsHoldOn(false, problem);
    const Answer first = optimizer::SearchTrees(problem, Within(60.0));
    if (first.designs.empty()) continue;
    const Design& design = first.designs[0];
    problem = optimizer::WithPartsOf(problem, design);  // what is faster would hold
    for (const optimizer::Choice& row : design.parts)
      if (row.family == optimizer::Family::kCompressor)
        problem.limits.compressors = static_cast<int>(row.quantity);
    problem.groups[0].gait.inflate_fraction = design.settings.valve_duty[0] * (1.0 + 1e-7);
    const double stops = Best(problem);
    SetPumpsHoldOn(true, problem);
    const double held = Best(problem);
    if (!std::isfinite(stops)) continue;
    EXPECT_GE(held, stops * (1.0 - 1e-9));
    EXPECT_LE(held, stops * (1.0 + 1e-5));
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

// Two groups that alternate by half periods leave no time in which a shared pump is off; each by
// itself leaves half of it.
TEST(HeldPumpSearch, ASharedPumpRunsUntilTheNextTurn) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed, 2, PumpFeed::kShared);
    problem.count = 1;
    for (model::Compressor& pump : problem.parts.compressors) pump.duty_max = 1.0;
    for (optimizer::ActuatorGroup& group : problem.groups) group.gait.inflate_fraction = 0.75;
    Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    EXPECT_NEAR(*answer.designs[0].settings.compressor_duty, 1.0, 1e-9);
    problem.pump_feed = PumpFeed::kPerGroup;
    answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;  // packs may not drive two pumps at once
    EXPECT_NEAR(*answer.designs[0].settings.compressor_duty, 0.75, 1e-9);
    ++found;
  }
  EXPECT_GT(found, 2);
}

TEST(HeldPumpSearch, AConflictNamesIt) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 20 && named < 2; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(600 + seed, 1, PumpFeed::kShared);
    problem.count = 1;
    problem.groups[0].gait.inflate_fraction = 0.6;
    for (model::Compressor& pump : problem.parts.compressors) pump.duty_max = 0.5;
    SetPumpsHoldOn(false, problem);
    if (!std::isfinite(Best(problem))) continue;
    SetPumpsHoldOn(true, problem);
    const Answer answer = optimizer::Search(problem, Within(60.0));
    ASSERT_EQ(answer.status, Status::kInfeasible);
    ASSERT_FALSE(answer.infeasibility.conflicts.empty());
    EXPECT_EQ(answer.infeasibility.conflicts.front().front().requirement, "/supply/hold_on");
    ++named;
  }
  EXPECT_GE(named, 1);
}

TEST(HeldPumpSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 30 && looked_at < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(700 + seed, 1 + static_cast<int>(seed % 2), PumpFeed::kShared);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    EXPECT_TRUE(refused([](Design& d) { *d.settings.compressor_duty *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { d.totals.energy_j *= 0.99; }));
    Problem stops = problem;
    SetPumpsHoldOn(false, stops);
    EXPECT_FALSE(Accepts(stops, answer));
    Answer shorter = answer;
    shorter.designs.erase(shorter.designs.begin());
    EXPECT_FALSE(Accepts(problem, shorter));
    ++looked_at;
  }
  EXPECT_GE(looked_at, 2);
}

}  // namespace held_pump_search_test
}  // namespace plenum::test
