// The outline of a configuration against all of its combinations.
#include "optimizer/choices/outline.h"

#include <gtest/gtest.h>

#include "optimizer/choices/make_plan.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace outline_test {

using optimizer::Configuration;
using optimizer::Problem;

Problem Sample(std::uint64_t seed, Configuration configuration) {
  Problem problem = EasyProblem(seed, {configuration});
  if (seed % 2 == 1) problem.objective = {.cost_eur = 1.0};
  return problem;
}

TEST(OutlineTest, NoDesignIsBetterThanItsBound) {
  int found = 0;
  double closest = optimizer::kUnlimited;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const Configuration configuration :
         {Configuration::kCylinder, Configuration::kCo2, Configuration::kMains}) {
      const Problem problem = Sample(seed, configuration);
      const double bound = optimizer::MakeOutline(problem, {configuration}).bound;
      EXPECT_GT(bound, 0.0);
      for (const Enumerated& design : Enumerate(problem).designs) {
        EXPECT_LE(bound, design.leaf.objective) << seed << ' ' << Name(configuration);
        closest = std::min(closest, design.leaf.objective / bound);
        ++found;
      }
    }
  EXPECT_GT(found, 100);
  EXPECT_LT(closest, 1.5);  // of some use
}

TEST(OutlineTest, CountsAreThoseOfThePlan) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
    for (const Configuration configuration : {Configuration::kCylinder, Configuration::kCo2,
                                              Configuration::kCompressor, Configuration::kMains}) {
      const Problem problem = Sample(seed, configuration);
      const optimizer::Outline outline = optimizer::MakeOutline(problem, {configuration});
      const auto plan = optimizer::MakePlan(problem, {configuration});
      EXPECT_EQ(outline.combinations, plan->combinations);
      EXPECT_EQ(outline.combinations - outline.priced, plan->pruned.unpriced);
    }
}

}  // namespace outline_test
}  // namespace plenum::test
