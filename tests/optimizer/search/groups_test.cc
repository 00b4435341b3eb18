// Several groups on one source: the list of brute force, a design at once, and relations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "optimizer/choices/make_plan.h"
#include "optimizer/search/first_designs.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace groups_test {

using optimizer::ActuatorGroup;
using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Status;

constexpr Configuration kRegulated[] = {Configuration::kCylinder, Configuration::kCo2,
                                        Configuration::kMains};

Problem Drawn(std::uint64_t seed, int groups, bool simultaneous, const CatalogueSize& size) {
  Draw draw;
  draw.seed = 8800 + seed;
  draw.configurations = {kRegulated[seed % 3]};
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  draw.severity = 0.03 * static_cast<double>(seed % 16);
  draw.size = size;
  Problem problem = RandomProblem(draw);
  problem.limits = {1, 2, 2, 2, 1};
  return problem;
}

constexpr CatalogueSize kSmall{2, 2, 3, 1, 1, 2, 0, 1, 0}, kTiny{1, 2, 3, 1, 1, 2, 0, 1, 0};

double Least(const Problem& problem) {
  const Answer answer = optimizer::SearchTrees(problem, Within(200.0));
  EXPECT_TRUE(answer.proof.complete);
  return answer.designs.empty() ? optimizer::kUnlimited : answer.designs.front().objective;
}

TEST(GroupsTest, ListOfBruteForce) {
  int designs = 0, infeasible = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const int groups = seed % 4 == 0 ? 3 : 2;
    Problem problem = Drawn(seed, groups, seed % 5 != 0, groups == 3 ? kTiny : kSmall);
    problem.count = 1 + static_cast<int>(seed % 12);
    const BruteForce truth = Enumerate(problem);
    const Answer answer = optimizer::SearchTrees(problem, Within(20.0));
    EXPECT_EQ(answer.status, truth.designs.empty() ? Status::kInfeasible : Status::kOptimal);
    EXPECT_EQ(answer.proof.undecided, truth.undecided);
    ASSERT_EQ(answer.designs.size(),
              std::min(truth.designs.size(), static_cast<std::size_t>(problem.count)));
    for (std::size_t i = 0; i < answer.designs.size(); ++i)
      EXPECT_EQ(KeyOf(answer.designs[i]), truth.designs[i].key) << "rank " << i + 1;
    designs += static_cast<int>(answer.designs.size());
    infeasible += answer.designs.empty();
  }
  EXPECT_GT(designs, 15);
  EXPECT_GT(infeasible, 0);
}

// Of the best designs that are sought before anything is proved, by how much they exceed the least.
struct First {
  int with_design = 0, found = 0;
  double excess = 0.0;
};

void Seek(const Problem& problem, First& first) {
  const double least = Least(problem);
  const auto plan = optimizer::MakePlan(problem, {*problem.configurations.begin()});
  if (plan->empty()) return;
  optimizer::Bounds bounds(problem, *plan);
  Problem of_one = problem;
  of_one.count = 1;
  optimizer::Ranking ranking(of_one);
  const optimizer::SearchOptions options = Within(20.0);
  optimizer::Watch watch(options, optimizer::Watch::Clock::now());
  const auto none = [](const auto&...) { return std::vector<optimizer::Variant>{}; };
  optimizer::SeekFirst(
      problem, {&bounds}, options, none, watch, [] { return false; }, ranking);
  first.with_design += std::isfinite(least);
  if (ranking.list().empty()) return;
  ++first.found;
  const double objective = ranking.list().front().leaf.objective;
  EXPECT_GE(objective, least * (1.0 - 1e-9));
  first.excess += objective / least - 1.0;
}

// Where there is a design one is found before anything is proved, and it is a design.
TEST(GroupsTest, FirstDesigns) {
  First first;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Seek(Drawn(100 + seed, 2 + static_cast<int>(seed % 3), true, {3, 3, 6, 2, 2, 3, 0, 2, 0}),
         first);
  }
  EXPECT_GT(first.with_design, 5);
  EXPECT_EQ(first.found, first.with_design);
  EXPECT_LT(first.excess, 0.05 * first.found);
}

// The same where pumps are chosen, which have their strongest looked at first.
TEST(GroupsTest, FirstDesignsOfPumps) {
  First first;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Draw draw;
    draw.seed = 9100 + seed;
    draw.configurations = {Configuration::kCompressor};
    draw.groups = 2;
    draw.simultaneous = true;
    draw.severity = 0.03 * static_cast<double>(seed);
    draw.size = {2, 2, 4, 4, 1, 1, 3, 1, 3};
    Problem problem = RandomProblem(draw);
    problem.limits = {2, 2, 1, 1, 2};
    Seek(problem, first);
  }
  EXPECT_GT(first.with_design, 3);
  EXPECT_EQ(first.found, first.with_design);
  EXPECT_LT(first.excess, 0.2 * first.found);
}

// Order and names of groups are nothing to the objective; looser limits are never worse; a group
// that is split may get other lines, and never a worse design, if no valve serves several.
TEST(GroupsTest, Relations) {
  int designs = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(200 + seed, 2, seed % 3 != 0, {3, 3, 5, 2, 2, 3, 0, 2, 0});
    problem.count = 1;
    for (model::Valve& valve : problem.parts.valves) valve.channels = 1;
    const double least = Least(problem);
    if (std::isinf(least)) continue;
    ++designs;
    Problem turned = problem;
    std::reverse(turned.groups.begin(), turned.groups.end());
    turned.groups[0].name = "another";
    EXPECT_NEAR(Least(turned), least, 1e-6 * least);
    Problem looser = problem;
    for (ActuatorGroup& group : looser.groups) group.rise_time_max_s *= 1.5;
    EXPECT_LE(Least(looser), least * (1.0 + 1e-9));
    if (!problem.simultaneous) continue;
    Problem split = problem;
    split.groups[0].count = 2;
    const double whole = Least(split);
    split.groups[0].count = 1;
    split.groups.insert(split.groups.begin(), split.groups[0]);
    split.groups[0].name = "half";
    const double halves = Least(split);
    EXPECT_TRUE(std::isinf(whole) || halves <= whole * (1.0 + 1e-9));
  }
  EXPECT_GT(designs, 3);
}

}  // namespace groups_test
}  // namespace plenum::test
