// Dives look no longer than they are told to, and at nothing that cannot improve the list.
#include "optimizer/search/dive.h"

#include <gtest/gtest.h>

#include "optimizer/choices/make_plan.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace dive_test {

using optimizer::Configuration;
using optimizer::DiveSteps;
using optimizer::Problem;
using optimizer::Ranking;

constexpr long long kMany = 1'000'000'000;

// With a made-to-measure reservoir, which takes many steps to size.
Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = 8300 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.groups = 1;
  draw.severity = 0.5;
  draw.size = {3, 3, 4, 0, 0, 0, 3, 30, 0};
  Problem problem = RandomProblem(draw);
  problem.exclude.erase("custom");
  problem.objective = {.mass_kg = 1.0};
  problem.count = 1;
  return problem;
}

// From all combinations; the steps that it took.
long long DiveOnce(const Problem& problem, DiveSteps steps, Ranking& ranking) {
  const auto plan = optimizer::MakePlan(problem, {Configuration::kCompressor});
  if (plan->empty()) return 0;
  optimizer::Bounds bounds(problem, *plan);
  optimizer::Box root = bounds.Root();
  if (bounds.Assess(root, -1) != optimizer::Constraint::kNone) return 0;
  const long long before = steps.left;
  DiveFrom(
      std::move(root), 0, problem, bounds, [] { return false; }, steps, ranking);
  return before - steps.left;
}

TEST(DiveTest, StepsBoundIt) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed);
    Ranking free(problem), bound(problem), hard(problem);
    const long long taken = DiveOnce(problem, {kMany, kMany}, free);
    if (free.list().empty()) continue;
    ++found;
    constexpr long long kOne = 32;  // a step of sizing a design
    EXPECT_LE(DiveOnce(problem, {taken / 2, kMany}, bound), taken / 2 + kOne);
    EXPECT_TRUE(bound.list().empty());
    EXPECT_LT(DiveOnce(problem, {kMany, kOne}, hard), taken);
    EXPECT_TRUE(hard.list().empty());
  }
  EXPECT_GT(found, 5);
}

// A list from the same parts, but for compressors that are a little lighter, is hard to improve.
TEST(DiveTest, NoDesignIsSizedAnyFurtherThanItMayImproveTheList) {
  int cut = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed);
    Problem lighter = problem;
    for (model::Compressor& pump : lighter.parts.compressors) {
      pump.basics.id += "-light";
      pump.basics.mass_kg *= 0.999;
    }
    Ranking none(problem), alone(problem), behind(problem);
    const long long unsized = DiveOnce(problem, {kMany, 0}, none);
    const long long to_the_end = DiveOnce(problem, {kMany, kMany}, alone);
    DiveOnce(lighter, {kMany, kMany}, behind);
    if (alone.list().empty() || behind.list().empty()) continue;
    const double before = behind.last().leaf.objective;
    const long long taken = DiveOnce(problem, {kMany, kMany}, behind);
    EXPECT_EQ(behind.last().leaf.objective, before);
    EXPECT_LE(taken, to_the_end);
    cut += unsized < taken && taken < to_the_end;
  }
  EXPECT_GT(cut, 3);
}

}  // namespace dive_test
}  // namespace plenum::test
