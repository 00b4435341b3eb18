// Pumps without a reservoir in the search: against plain enumeration, against looser problems,
// beside a compressor with a reservoir, and before the verifier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/kind.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/pumps/direct_problems.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace direct_pump_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::Status;

// Slow enough for pumps that fill the actuators themselves, with voltages that fit and valves that
// mostly hold.
Problem Drawn(std::uint64_t seed, int groups = 1) {
  Problem problem = DirectPumpProblem(9000 + seed, 0.02 * static_cast<double>(seed % 20), groups);
  Random random(seed);
  for (model::Compressor& pump : problem.parts.compressors)
    pump.curve.voltage_v = Chance(random, 0.7) ? 12.0 : 6.0;
  for (model::Battery& pack : problem.parts.batteries)
    pack.nominal_voltage_v = Chance(random, 0.7) ? 11.1 : 6.0;
  for (model::Valve& valve : problem.parts.valves) {
    if (Chance(random, 0.6)) valve.kind = model::ValveKind::kPair;
    if (Chance(random, 0.8)) valve.pressure_min_pa = kAmbientPa;
    if (Chance(random, 0.5)) valve.pressure_max_pa = kAmbientPa + Uniform(random, 0.4, 3.0) * kBar;
  }
  return problem;
}

struct Tally {
  int feasible = 0, infeasible = 0, designs = 0;
};

void Compare(const Problem& problem, Tally& tally) {
  const bool found = ExpectAsEnumerated(problem, [&](const Design& design, const Enumerated& twin) {
    if (twin.configuration != Configuration::kDirectPump) return;
    EXPECT_NEAR(design.settings.source_pressure_pa, twin.leaf.point.source_pa,
                1e-6 * twin.leaf.point.source_pa);
    ++tally.designs;
  });
  ++(found ? tally.feasible : tally.infeasible);
}

TEST(DirectPumpSearch, ListsWhatEnumerationLists) {
  Tally tally;
  for (int seed = 1; seed <= Draws(100); ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed), tally);
  }
  EXPECT_GT(tally.feasible, Draws(30));
  EXPECT_GT(tally.infeasible, Draws(5));
  EXPECT_GT(tally.designs, Draws(150));
}

TEST(DirectPumpSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.5}};
  Tally tally;
  for (int seed = 1; seed <= Draws(40); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(200 + seed);
    problem.objective = kObjectives[seed % 4];
    Random random(seed);
    if (seed % 5 == 0)  // more pressure may then cost less energy
      for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
    const BruteForce all = Enumerate(problem);
    if (all.designs.empty()) continue;
    if (seed % 3 == 0) problem.mass_max_kg = 1.2 * all.designs[0].mass_kg + 0.3;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(10));
}

TEST(DirectPumpSearch, GroupsOneAfterAnother) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed, 2);
    problem.limits.batteries = 1;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 3);
}

TEST(DirectPumpSearch, ThreeGroups) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(350 + seed, 3);
    problem.frequency_hz *= 0.3;
    problem.limits.batteries = 1;
    problem.limits.compressors = 1;
    problem.parts.tubing.resize(1);
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 1);
}

// Pumps of their own, of which groups may fill at once.
TEST(DirectPumpSearch, PumpsOfEachGroup) {
  Tally tally;
  for (int seed = 1; seed <= Draws(24); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = WithFeed(Drawn(300 + seed, 2), optimizer::PumpFeed::kPerGroup);
    problem.simultaneous = seed % 2 == 0;
    problem.limits.batteries = 2;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(6));
}

TEST(DirectPumpSearch, PumpsOfEachActuator) {
  Tally tally;
  for (int seed = 1; seed <= Draws(48); ++seed) {
    SCOPED_TRACE(seed);
    const int groups = seed % 3 == 0 ? 2 : 1;
    Problem problem = WithFeed(Drawn(600 + seed, groups), optimizer::PumpFeed::kPerActuator);
    problem.simultaneous = seed % 2 == 0;
    problem.limits.batteries = 2;
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(12));
}

// A pump of each of two groups of one actuator is a pump of each actuator but for the valve, and a
// pump of one group is a shared one.
TEST(DirectPumpSearch, PumpsOfOneGroupAreShared) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const Problem shared = Drawn(100 + seed);
    const Answer one = optimizer::SearchTrees(shared, Within(60.0));
    const Answer other =
        optimizer::SearchTrees(WithFeed(shared, optimizer::PumpFeed::kPerGroup), Within(60.0));
    EXPECT_EQ(one.status, other.status);
    ASSERT_EQ(one.designs.size(), other.designs.size());
    for (std::size_t i = 0; i < one.designs.size(); ++i, ++found)
      EXPECT_NEAR(one.designs[i].objective, other.designs[i].objective,
                  1e-9 * one.designs[i].objective);
  }
  EXPECT_GT(found, 10);
}

// Groups that are to fill at once have no such design.
TEST(DirectPumpSearch, NoneForGroupsAtOnce) {
  Problem problem = Drawn(301, 2);
  problem.simultaneous = true;
  problem.count = 1;
  EXPECT_EQ(optimizer::SearchTrees(problem, Within(60.0)).status, Status::kInfeasible);
}

TEST(DirectPumpSearch, BesideACompressor) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed);
    Random random(seed);
    problem.parts.reservoirs = RandomParts(random, {0, 0, 0, 0, 0, 0, 0, 0, 2}).reservoirs;
    problem.exclude = {"custom"};
    problem.configurations = {Configuration::kDirectPump, Configuration::kCompressor};
    Compare(problem, tally);
  }
  EXPECT_GT(tally.feasible, 2);
}

TEST(DirectPumpSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed, 1 + static_cast<int>(seed % 2));
    problem.count = 1;
    problem.source_pressure_max_pa = kAmbientPa + 2.0 * kBar;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(6, problem);
    looser[0].source_pressure_max_pa += kBar;
    for (model::Valve& valve : looser[1].parts.valves) valve.pressure_max_pa += kBar;
    looser[2].actuations = std::max(1.0, std::round(0.7 * looser[2].actuations));
    looser[3].groups[0].rise_time_max_s *= 1.3;
    looser[4].limits.compressors += 1;
    for (model::Valve& valve : looser[5].parts.valves)
      valve.fill.sonic_conductance_m3_per_s_pa *= 1.2;
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

TEST(DirectPumpSearch, KindsHaveThePumpsSeriesAsTheirSource) {
  int listed = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(600 + seed);
    problem.list = optimizer::ListOf::kKinds;
    problem.count = 6;
    problem.limits.per_source = 2;
    for (std::size_t i = 0; i < problem.parts.compressors.size(); ++i)
      problem.parts.compressors[i].basics.series = i % 2 == 0 ? "even" : "odd";
    const Answer answer = Recorded(problem);
    const optimizer::DesignKinds kinds(problem.parts);
    for (const Design& design : answer.designs) {
      EXPECT_EQ(kinds.Of(design.configuration, design.parts).sources.size(), 1u);
      ++listed;
    }
    ExpectVerified(problem, answer);
  }
  EXPECT_GT(listed, 10);
}

// ── what the verifier refuses ──

TEST(DirectPumpSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 30 && looked_at < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(700 + seed, 1 + static_cast<int>(seed % 2));
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 1.001; }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { *d.settings.compressor_duty *= 0.99; }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.reservoir_volume_m3 = 1e-3; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.groups[0].rise_time_s *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.air_total_m3 *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.totals.energy_j *= 0.99; }));
    EXPECT_TRUE(refused([](Design& d) { d.configuration = Configuration::kCompressor; }));
    EXPECT_TRUE(refused([](Design& d) { d.parts.pop_back(); }));
    Problem tight = problem;
    tight.source_pressure_max_pa = answer.designs.front().settings.source_pressure_pa * 0.999;
    EXPECT_FALSE(Accepts(tight, answer));
    Problem at_once = problem;
    at_once.simultaneous = true;
    EXPECT_EQ(Accepts(at_once, answer), problem.groups.size() == 1);
    Answer shorter = answer;
    shorter.designs.erase(shorter.designs.begin());
    EXPECT_FALSE(Accepts(problem, shorter));
    ++looked_at;
  }
  EXPECT_GE(looked_at, 2);
}

// "No design" is said with the field that is too tight.
TEST(DirectPumpSearch, AConflictNamesWhatIsTooTight) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 20 && named < 3; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(800 + seed);
    problem.count = 1;
    if (optimizer::SearchTrees(problem, Within(60.0)).designs.empty()) continue;
    problem.groups[0].rise_time_max_s = 1e-3;
    const Answer answer = optimizer::Search(problem, Within(60.0));
    ASSERT_EQ(answer.status, Status::kInfeasible);
    ASSERT_FALSE(answer.infeasibility.conflicts.empty());
    EXPECT_EQ(answer.infeasibility.conflicts.front().front().requirement,
              "/actuators/0/rise_time_s_max");
    ++named;
  }
  EXPECT_GE(named, 1);
}

}  // namespace direct_pump_search_test
}  // namespace plenum::test
