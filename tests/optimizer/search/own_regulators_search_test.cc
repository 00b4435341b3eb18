// Regulators of their own: against all combinations looked at by the verifier, against each group
// searched by itself, against looser problems, and with settings that are tampered with.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/problem/own_regulators.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace own_regulators_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Problem;
using optimizer::Regulation;
using optimizer::Status;

// Groups whose pressures differ, so that one regulator for all does not suit them.
Problem Drawn(std::uint64_t seed, Configuration configuration, int groups = 2) {
  Draw draw;
  draw.seed = 9000 + seed;
  draw.configurations = {configuration};
  draw.severity = 0.03 * static_cast<double>(seed % 20);
  draw.groups = groups;
  draw.simultaneous = seed % 2 == 0;
  draw.size = {2, 2, 3, 3, 2, 2, 0, 2, 3};
  Problem problem = RandomProblem(draw);
  Random random(seed);
  for (optimizer::ActuatorGroup& group : problem.groups)
    if (Chance(random, 0.5))
      group.pressure_max_pa = group.chamber.operating_pressure_pa + Uniform(random, 2e3, 40e3);
  for (model::Valve& valve : problem.parts.valves)
    if (Chance(random, 0.5)) valve.closing_scatter_s = LogUniform(random, 1e-3, 2e-2);
  problem.limits = {1, 1, 2, 2, 1};
  problem.count = 5;
  problem.regulation = Regulation::kPerGroup;
  return problem;
}

bool Owns(const Design& design) { return optimizer::HasOwnRegulators(design.parts); }

TEST(OwnRegulators, ListsWhatAllCombinationsGive) {
  int feasible = 0, infeasible = 0;
  for (const Configuration configuration :
       {Configuration::kCylinder, Configuration::kCo2, Configuration::kMains, Configuration::kTank})
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
      SCOPED_TRACE(std::string(Name(configuration)) + " " + std::to_string(seed));
      const Problem problem = Drawn(seed, configuration);
      const Answer answer = Recorded(problem);
      EXPECT_EQ(answer.proof.undecided, 0);
      EXPECT_NE(answer.status, Status::kFeasible);
      const bool may = optimizer::MayOwnRegulators(problem, configuration);
      for (const Design& design : answer.designs) EXPECT_EQ(Owns(design), may);
      ExpectVerified(problem, answer);
      ++(answer.designs.empty() ? infeasible : feasible);
    }
  EXPECT_GT(feasible, 35);
  EXPECT_GT(infeasible, 6);
}

TEST(OwnRegulators, OtherObjectivesAndKinds) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 0.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 0.0}, {1.0, 0.0, 0.002, 0.1}};
  int feasible = 0;
  for (std::uint64_t seed = 1; seed <= 36; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem =
        Drawn(100 + seed, seed % 2 == 0 ? Configuration::kCylinder : Configuration::kTank);
    problem.objective = kObjectives[seed % 3];
    if (seed % 4 == 0) problem.list = optimizer::ListOf::kKinds;
    if (seed % 3 == 0) problem.regulation = Regulation::kAny;
    const Answer answer = Recorded(problem);
    ExpectVerified(problem, answer);
    feasible += !answer.designs.empty();
  }
  EXPECT_GT(feasible, 6);
}

// Actuators of one group that are filled one after another, and may draw at once.
TEST(OwnRegulators, SquadsOfAGroupShareItsRegulator) {
  int feasible = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(600 + seed, Configuration::kCylinder);
    optimizer::ActuatorGroup& group = problem.groups[seed % 2];
    group.count = 2;
    group.gait.phases = {0.0, seed % 3 == 0 ? 0.5 : 0.2};
    const Answer answer = Recorded(problem);
    ExpectVerified(problem, answer);
    feasible += !answer.designs.empty();
  }
  EXPECT_GT(feasible, 3);
}

// At the mains, where nothing but the parts is shared, the best is that of each group alone.
TEST(OwnRegulators, AtTheMainsEachGroupIsForItself) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(200 + seed, Configuration::kMains, 3);
    problem.count = 1;
    problem.mains.flow_max_m3_per_s = optimizer::kUnlimited;
    problem.mass_max_kg = problem.volume_max_l = problem.cost_max_eur = optimizer::kUnlimited;
    problem.parts.manifolds.clear();
    problem.objective = {1.0, 0.0, 0.0, seed % 2 == 0 ? 0.01 : 0.0};
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    double sum = 0.0;
    for (const optimizer::ActuatorGroup& group : problem.groups) {
      Problem alone = problem;
      alone.groups = {group};
      const Answer best = optimizer::SearchTrees(alone, Within(60.0));
      sum += best.designs.empty() ? optimizer::kUnlimited : best.designs[0].objective;
    }
    ASSERT_EQ(answer.designs.empty(), std::isinf(sum));
    if (answer.designs.empty()) continue;
    EXPECT_NEAR(answer.designs[0].objective, sum, 1e-5 * sum);
    ++compared;
  }
  EXPECT_GT(compared, 8);
}

TEST(OwnRegulators, AnyIsTheBetterOfBoth) {
  int own = 0, shared = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed, Configuration::kCylinder);
    problem.count = 1;
    const auto best = [&](Regulation regulation) {
      problem.regulation = regulation;
      const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
      return answer.designs.empty() ? optimizer::kUnlimited : answer.designs[0].objective;
    };
    const double each = best(Regulation::kPerGroup), all = best(Regulation::kShared);
    const double any = best(Regulation::kAny);
    if (std::isinf(any)) {
      EXPECT_TRUE(std::isinf(each) && std::isinf(all));
      continue;
    }
    EXPECT_NEAR(any, std::min(each, all), 1e-6 * any);
    ++(each < all ? own : shared);
  }
  EXPECT_GT(own, 0);
  EXPECT_GT(shared, 3);
}

TEST(OwnRegulators, LooserIsNeverWorse) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed, Configuration::kCylinder);
    problem.count = 1;
    const Answer answer = optimizer::SearchTrees(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    std::vector<Problem> looser(4, problem);
    looser[0].groups[0].rise_time_max_s *= 1.2;
    looser[1].groups[1].pressure_max_pa += 20e3;
    looser[2].actuations *= 0.9;
    looser[3].source_pressure_max_pa *= 1.3;
    ASSERT_NO_FATAL_FAILURE(ExpectNeverWorse(answer, looser));
    compared += static_cast<int>(looser.size());
  }
  EXPECT_GT(compared, 16);
}

TEST(OwnRegulators, TamperedPressuresAreRefused) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(500 + seed, Configuration::kCylinder);
    const Answer answer = Recorded(problem);
    if (answer.designs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    Answer raised = answer;
    raised.designs[0].settings.group_pressure_pa[1] *= 1.02;
    EXPECT_FALSE(Accepts(problem, raised));
    Answer shared = answer;
    shared.designs[0].settings.group_pressure_pa.clear();
    EXPECT_FALSE(Accepts(problem, shared));
    Answer swapped = answer;
    for (optimizer::Choice& row : swapped.designs[0].parts)
      if (row.family == optimizer::Family::kRegulator) row.group = -1;
    EXPECT_FALSE(Accepts(problem, swapped));
    ++refused;
  }
  EXPECT_GT(refused, 3);
}

}  // namespace own_regulators_search_test
}  // namespace plenum::test
