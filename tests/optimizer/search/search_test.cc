// Stopping, and what a stopped search still claims.
#include <gtest/gtest.h>

#include <algorithm>

#include "optimizer/explain/explained_search.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::SearchOptions;
using optimizer::Status;

bool IsListed(const Answer& answer, const PartsKey& key) {
  return std::any_of(answer.designs.begin(), answer.designs.end(),
                     [&](const optimizer::Design& design) { return KeyOf(design) == key; });
}

void ExpectBoundHolds(const Answer& answer, const BruteForce& truth) {
  for (const Enumerated& design : truth.designs)
    if (!IsListed(answer, design.key)) {
      EXPECT_LE(answer.proof.lower_bound, design.leaf.objective * (1.0 + 1e-9));
    }
}

Problem Sample(std::uint64_t seed) {
  Problem problem =
      EasyProblem(seed, {Configuration::kCylinder, Configuration::kCo2, Configuration::kMains});
  problem.count = 5;
  return problem;
}

TEST(SearchTest, CancelledAnywhereTheBoundHoldsAndTheCountsAddUp) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Problem problem = Sample(seed);
    const BruteForce truth = Enumerate(problem);
    for (int calls_max = 1; calls_max < 200; calls_max = calls_max * 3 / 2 + 1) {
      int calls = 0;
      SearchOptions options;
      options.time_limit_s = 100.0;
      options.cancelled = [&] { return ++calls > calls_max; };
      const Answer answer = optimizer::Search(problem, options);
      SCOPED_TRACE("seed " + std::to_string(seed) + ", cancelled after " +
                   std::to_string(calls_max));
      if (calls <= calls_max) continue;  // done before
      EXPECT_EQ(answer.status, Status::kCancelled);
      EXPECT_FALSE(answer.proof.complete);
      EXPECT_TRUE(answer.infeasibility.conflicts.empty());
      ExpectBoundHolds(answer, truth);
      const optimizer::Pruned& pruned = answer.proof.pruned;
      EXPECT_EQ(answer.proof.combinations, truth.combinations);
      EXPECT_EQ(pruned.incompatible + pruned.infeasible + pruned.bound + pruned.dominated +
                    pruned.unpriced + answer.proof.evaluated,
                answer.proof.combinations);
    }
  }
}

TEST(SearchTest, TimeLimitEndsAsFeasibleWithAValidBound) {
  const Problem problem = Sample(7);
  const BruteForce truth = Enumerate(problem);
  for (double limit_s : {0.0, 1e-4, 1e-3, 3e-3}) {
    const Answer answer = optimizer::Search(problem, Within(limit_s));
    EXPECT_NE(answer.status, Status::kInfeasible);
    EXPECT_NE(answer.status, Status::kCancelled);
    ExpectBoundHolds(answer, truth);
    if (answer.status == Status::kFeasible && answer.designs.empty()) {
      EXPECT_EQ(answer.proof.gap, 1.0);
    }
  }
  EXPECT_EQ(optimizer::Search(problem, Within(0.0)).status, Status::kFeasible);
}

TEST(SearchTest, SameProblemSameAnswer) {
  for (std::uint64_t seed = 11; seed <= 13; ++seed) {
    const Problem problem = Sample(seed);
    const Answer first = optimizer::Search(problem, Within(100.0));
    const Answer second = optimizer::Search(problem, Within(100.0));
    EXPECT_EQ(first.status, second.status);
    EXPECT_EQ(first.proof.lower_bound, second.proof.lower_bound);
    EXPECT_EQ(first.proof.evaluated, second.proof.evaluated);
    EXPECT_EQ(first.proof.pruned.bound, second.proof.pruned.bound);
    ASSERT_EQ(first.designs.size(), second.designs.size());
    for (std::size_t i = 0; i < first.designs.size(); ++i) {
      EXPECT_EQ(KeyOf(first.designs[i]), KeyOf(second.designs[i]));
      EXPECT_EQ(first.designs[i].objective, second.designs[i].objective);
      EXPECT_EQ(first.designs[i].settings.source_pressure_pa,
                second.designs[i].settings.source_pressure_pa);
    }
  }
}

TEST(SearchTest, OrderOfTheCatalogueDoesNotMatter) {
  for (std::uint64_t seed = 21; seed <= 23; ++seed) {
    const Problem problem = Sample(seed);
    Problem turned = problem;
    std::reverse(turned.parts.tubing.begin(), turned.parts.tubing.end());
    std::reverse(turned.parts.valves.begin(), turned.parts.valves.end());
    std::reverse(turned.parts.cylinders.begin(), turned.parts.cylinders.end());
    std::reverse(turned.parts.regulators.begin(), turned.parts.regulators.end());
    std::reverse(turned.parts.batteries.begin(), turned.parts.batteries.end());
    const Answer first = optimizer::Search(problem, Within(100.0));
    const Answer second = optimizer::Search(turned, Within(100.0));
    ASSERT_EQ(first.designs.size(), second.designs.size());
    for (std::size_t i = 0; i < first.designs.size(); ++i)
      EXPECT_EQ(KeyOf(first.designs[i]), KeyOf(second.designs[i])) << "rank " << i + 1;
  }
}

// All three limits on amounts at once, none of which binds, and energy in the objective.
TEST(SearchTest, LimitsThatDoNotBindChangeNothing) {
  int designs = 0;
  for (Configuration configuration :
       {Configuration::kCompressor, Configuration::kCylinder, Configuration::kTank}) {
    Problem problem = EasyProblem(3, {configuration});
    problem.unpriced_allowed = true;
    problem.count = 2;
    const Answer without = optimizer::SearchTrees(problem, Within(60.0));
    problem.mass_max_kg = problem.volume_max_l = problem.cost_max_eur = 1e6;
    const Answer with = optimizer::SearchTrees(problem, Within(60.0));
    EXPECT_EQ(with.status, without.status);
    ASSERT_EQ(with.designs.size(), without.designs.size());
    for (std::size_t i = 0; i < with.designs.size(); ++i)
      EXPECT_EQ(KeyOf(with.designs[i]), KeyOf(without.designs[i]));
    designs += static_cast<int>(with.designs.size());
  }
  EXPECT_GT(designs, 2);
}

}  // namespace search_test
}  // namespace plenum::test
