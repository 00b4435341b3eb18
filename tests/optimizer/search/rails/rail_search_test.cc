// Actuators that are pulled below ambient beside a pressure supply, in the search: against plain
// enumeration, against looser problems, and before the verifier.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/drawn_gait.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/rail_problems.h"

namespace plenum::test {
namespace rail_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;

constexpr Configuration kAll[] = {Configuration::kCylinder, Configuration::kCo2,
                                  Configuration::kMains};

Problem Drawn(std::uint64_t seed, int groups = 1, bool simultaneous = true) {
  Draw draw;
  draw.seed = 47000 + seed;
  draw.configurations = groups == 1 ? std::set<Configuration>{kAll[seed % 3]}
                                    : std::set<Configuration>{kAll[seed % 3], kAll[(seed + 1) % 3]};
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = groups == 1 || simultaneous;
  draw.size = groups == 1 ? CatalogueSize{3, 3, 4, 3, 3, 3, 0, 2, 0}
                          : CatalogueSize{2, 2, 3, 2, 2, 2, 0, 2, 0};
  return RailProblem(draw);
}

TEST(RailSearch, ListsWhatEnumerationLists) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(seed), tally);
  }
  EXPECT_GT(tally.feasible, 30);
  EXPECT_GT(tally.infeasible, 3);
  EXPECT_GT(tally.designs, 150);
}

TEST(RailSearch, GroupsAtOnceAndOneAfterAnother) {
  Compared tally;
  for (int seed = 1; seed <= Draws(24); ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(300 + seed, 2, seed % 2 == 0), tally);
  }
  EXPECT_GT(tally.feasible, Draws(6));
}

TEST(RailSearch, ListsWhatEnumerationListsForOtherObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 1.0, 0.0, 0.0}, {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0}, {1.0, 0.0, 0.0, 0.5}};
  Compared tally;
  for (int seed = 1; seed <= Draws(16); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(500 + seed);
    problem.objective = kObjectives[seed % 4];
    CompareLists(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(5));
}

TEST(RailSearch, ListsWhatEnumerationListsOfGaits) {
  Compared tally;
  for (int seed = 1; seed <= Draws(12); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(1100 + seed, 1 + seed % 2, seed % 3 != 0);
    Random random(seed);
    DrawGaits(random, problem);
    CompareLists(problem, tally);
  }
  EXPECT_GT(tally.feasible, Draws(3));
}

void SetRail(double deeper_pa, Problem& problem) {
  for (optimizer::ActuatorGroup& group : problem.groups)
    if (group.chamber.low_pressure_pa > 0.0)
      group.chamber.exhaust_pressure_pa =
          std::max(5e3, group.chamber.exhaust_pressure_pa - deeper_pa);
}

// A deeper vacuum, more time, a low pressure less deep, which takes less air.
TEST(RailSearch, LooserIsNeverWorse) {
  int compared = 0;
  for (int seed = 1; seed <= Draws(30); ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(700 + seed, 1 + seed % 2, false);
    problem.count = 1;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    Problem deeper = problem, slower = problem, shallower = problem;
    SetRail(20e3, deeper);
    for (optimizer::ActuatorGroup& group : slower.groups) group.fall_time_max_s *= 1.3;
    for (optimizer::ActuatorGroup& group : shallower.groups)
      if (double& low_pa = group.chamber.low_pressure_pa; low_pa > 0.0)
        low_pa = std::min(kAmbientPa - 1.0, low_pa + 5e3);
    ExpectNeverWorse(answer, {deeper, slower, shallower});
    ++compared;
  }
  EXPECT_GT(compared, Draws(8));
}

TEST(RailSearch, TheVerifierRefusesWhatIsTamperedWith) {
  int refused = 0;
  for (int seed = 1; seed <= 12 && refused < 4; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(900 + seed);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    EXPECT_TRUE(Accepts(problem, answer));
    EXPECT_TRUE(RefusesFirst(
        problem, answer, [](Design& design) { design.performance.groups[0].fall_time_s *= 0.99; }));
    EXPECT_TRUE(RefusesFirst(
        problem, answer, [](Design& design) { design.performance.groups[0].rise_time_s *= 0.99; }));
    EXPECT_TRUE(RefusesFirst(
        problem, answer, [](Design& design) { design.performance.air_per_actuation_m3 *= 0.99; }));
    // The same list of a problem whose rail is not so deep, or whose actuators rest at ambient.
    Problem other = problem;
    other.groups[0].chamber.exhaust_pressure_pa =
        0.5 *
        (other.groups[0].chamber.exhaust_pressure_pa + other.groups[0].chamber.low_pressure_pa);
    EXPECT_FALSE(Accepts(other, answer));
    other = problem;
    other.groups[0].chamber.low_pressure_pa = other.groups[0].chamber.exhaust_pressure_pa = 0.0;
    EXPECT_FALSE(Accepts(other, answer));
    ++refused;
  }
  EXPECT_EQ(refused, 4);
}

}  // namespace rail_search_test
}  // namespace plenum::test
