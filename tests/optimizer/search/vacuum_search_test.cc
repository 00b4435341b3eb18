// Evacuated actuators in the search: against plain enumeration, against looser problems, and before
// the verifier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/explain/explained_search.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/pumps/vacuum_problems.h"

namespace plenum::test {
namespace vacuum_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::Status;

constexpr Configuration kReservoir = Configuration::kVacuumPump,
                        kDirect = Configuration::kDirectVacuumPump;

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations, int groups = 1,
              bool simultaneous = true) {
  Draw draw;
  draw.seed = 21000 + seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = groups == 1 || simultaneous;
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 0, 0, 0, 3, 3, 2}
                          : CatalogueSize{2, 2, 3, 0, 0, 0, 2, 2, 2};
  Problem problem = EvacuatedProblem(draw);
  problem.frequency_hz *= 0.5;
  return problem;
}

TEST(VacuumSearch, ListsWhatEnumerationLists) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(seed, {kReservoir}), tally);
  }
  EXPECT_GT(tally.feasible, 30);
  EXPECT_GT(tally.infeasible, 3);
  EXPECT_GT(tally.designs, 150);
}

TEST(VacuumSearch, ListsPumpsAloneAsEnumerationDoes) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(200 + seed, {kDirect}), tally);
  }
  EXPECT_GT(tally.feasible, 10);
  EXPECT_GT(tally.infeasible, 2);
}

TEST(VacuumSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.5}};
  Compared tally;
  for (int seed = 1; seed <= Draws(16); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed, {kReservoir, kDirect});
    problem.objective = kObjectives[seed % 4];
    const BruteForce all = Enumerate(problem);
    if (all.designs.empty()) continue;
    if (seed % 3 == 0) problem.mass_max_kg = 1.2 * all.designs[0].mass_kg + 0.3;
    CompareLists(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(5));
}

TEST(VacuumSearch, GroupsAtOnceAndOneAfterAnother) {
  Compared tally;
  for (int seed = 1; seed <= Draws(12); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed, {kReservoir}, 2, seed % 2 == 0);
    problem.limits.batteries = problem.limits.compressors = 1;
    problem.parts.tubing.resize(1);
    CompareLists(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(3));
}

// A group may be filled across the end of the period, or another one, by the order alone.
TEST(VacuumSearch, OrderOfGroupsDoesNotMatter) {
  int designs = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(800 + seed, {kDirect}, 3, false);
    problem.frequency_hz *= 0.1;
    problem.count = 1;
    const Answer first = optimizer::SearchTrees(problem, Within(60.0));
    EXPECT_EQ(first.proof.undecided, 0);
    for (int turn = 0; turn < 2; ++turn) {
      std::rotate(problem.groups.begin(), problem.groups.begin() + 1, problem.groups.end());
      const Answer other = optimizer::SearchTrees(problem, Within(60.0));
      EXPECT_EQ(other.status, first.status);
      ASSERT_EQ(other.designs.size(), first.designs.size());
      if (!other.designs.empty()) {
        EXPECT_NEAR(other.designs[0].objective, first.designs[0].objective,
                    1e-6 * first.designs[0].objective);
      }
    }
    designs += static_cast<int>(first.designs.size());
  }
  EXPECT_GT(designs, 2);
}

TEST(VacuumSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed, {kReservoir, kDirect});
    problem.count = 1;
    problem.source_pressure_max_pa = kAmbientPa + 70e3;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(6, problem);
    looser[0].source_pressure_max_pa += 20e3;
    for (model::Compressor& pump : looser[1].parts.vacuum_pumps) pump.duty_max = 1.0;
    looser[2].actuations = std::max(1.0, std::round(0.7 * looser[2].actuations));
    looser[3].groups[0].rise_time_max_s *= 1.3;
    looser[4].limits.compressors += 1;
    for (model::Valve& valve : looser[5].parts.valves)
      valve.exhaust.sonic_conductance_m3_per_s_pa *= 1.2;
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

TEST(VacuumSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int looked_at = 0;
  for (std::uint64_t seed = 1; seed <= 30 && looked_at < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(600 + seed, {seed % 2 == 0 ? kReservoir : kDirect});
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    const auto refused = [&](const auto& change) { return RefusesFirst(problem, answer, change); };
    // A deeper or a shallower rail than the strokes were told for.
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.settings.source_pressure_pa *= 0.99; }));
    EXPECT_TRUE(refused([](Design& d) { *d.settings.compressor_duty *= 0.99; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.groups[0].rise_time_s *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.groups[0].fall_time_s *= 0.999; }));
    EXPECT_TRUE(refused([](Design& d) { d.performance.air_total_m3 *= 1.01; }));
    EXPECT_TRUE(refused([](Design& d) { d.totals.energy_j *= 0.99; }));
    EXPECT_TRUE(refused([](Design& d) { d.configuration = Configuration::kCompressor; }));
    EXPECT_TRUE(refused([](Design& d) { d.parts.pop_back(); }));
    Answer shorter = answer;
    shorter.designs.erase(shorter.designs.begin());
    EXPECT_FALSE(Accepts(problem, shorter));
    ++looked_at;
  }
  EXPECT_GE(looked_at, 2);
}

// "No design" is said with the field that is too tight, in the words of a request.
TEST(VacuumSearch, AConflictNamesWhatIsTooTight) {
  int named = 0;
  for (std::uint64_t seed = 1; seed <= 20 && named < 3; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(700 + seed, {kReservoir});
    problem.count = 1;
    problem.source_pressure_max_pa = optimizer::kUnlimited;
    if (optimizer::SearchTrees(problem, Within(60.0)).designs.empty()) continue;
    problem.source_pressure_max_pa = problem.groups[0].chamber.operating_pressure_pa - 1.0;
    const Answer answer = optimizer::Search(problem, Within(60.0));
    ASSERT_EQ(answer.status, Status::kInfeasible);
    ASSERT_FALSE(answer.infeasibility.conflicts.empty());
    EXPECT_EQ(answer.infeasibility.conflicts.front().front().requirement,
              "/supply/vacuum/vacuum_kpa_gauge_min");
    ++named;
  }
  EXPECT_GE(named, 1);
}

}  // namespace vacuum_search_test
}  // namespace plenum::test
