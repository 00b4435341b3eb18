// Designs whose objectives tie are listed by mass, then cost, then ids, and the search proves it,
// against plain enumeration. Few numbers are drawn of each, so that there are many ties.
#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/choices/tie_key.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/verify.h"

namespace plenum::test {
namespace ties_test {

using optimizer::Configuration;
using optimizer::Objective;
using optimizer::Problem;

void Coarsen(model::PartBasics& basics) {
  basics.mass_kg = 0.05 * std::ceil(basics.mass_kg / 0.1);
  basics.body_volume_m3 = 1e-4 * std::ceil(basics.body_volume_m3 / 3e-4);
  if (basics.cost_eur) basics.cost_eur = 10.0 * std::ceil(*basics.cost_eur / 30.0);
}

Problem Drawn(std::uint64_t seed, Objective objective) {
  Draw draw;
  draw.seed = 700 + seed;
  draw.severity = 0.2;
  draw.groups = seed % 5 == 4 ? 2 : 1;
  draw.configurations = {static_cast<Configuration>(seed % 4)};
  draw.size = draw.groups == 1 ? CatalogueSize{2, 3, 3, 3, 3, 3, 3, 3, 3}
                               : CatalogueSize{1, 2, 2, 2, 2, 2, 2, 2, 2};
  Problem problem = RandomProblem(draw);
  problem.exclude.insert("custom");
  problem.objective = objective;
  problem.limits = {1, 1, 2, 2, 2};
  for (auto& part : problem.parts.tubing) Coarsen(part.per_metre);
  const auto coarsen = [](auto& family) {
    for (auto& part : family) Coarsen(part.basics);
  };
  coarsen(problem.parts.fittings);
  coarsen(problem.parts.valves);
  coarsen(problem.parts.regulators);
  coarsen(problem.parts.cylinders);
  coarsen(problem.parts.co2);
  coarsen(problem.parts.compressors);
  coarsen(problem.parts.reservoirs);
  coarsen(problem.parts.batteries);
  problem.count = 1 + static_cast<int>(seed % 13);
  return problem;
}

struct Compared {
  int designs = 0, ties = 0, by_mass = 0, by_cost = 0;  // beside the one before
};

void Compare(const Problem& problem, Compared& compared) {
  const BruteForce truth = Enumerate(problem);
  optimizer::SearchOptions options = Within(60.0);
  options.record = true;
  const optimizer::Answer answer = optimizer::SearchTrees(problem, options);
  for (const verify::Check& check : verify::Verify(problem, answer).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
  if (answer.proof.undecided > 0 || truth.undecided > 0) return;
  const std::size_t expected =
      std::min(truth.designs.size(), static_cast<std::size_t>(problem.count));
  ASSERT_EQ(answer.designs.size(), expected);
  for (std::size_t i = 0; i < expected; ++i) {
    EXPECT_EQ(KeyOf(answer.designs[i]), truth.designs[i].key) << "rank " << i + 1;
    ++compared.designs;
    if (i == 0) continue;
    const Enumerated &one = truth.designs[i - 1], &other = truth.designs[i];
    if (std::abs(one.leaf.objective / other.leaf.objective - 1.0) > 1e-6) continue;
    ++compared.ties;
    const bool masses_tie = std::abs(one.mass_kg - other.mass_kg) < 1e-10;
    compared.by_mass += !masses_tie;
    compared.by_cost += masses_tie && std::abs(one.cost_eur - other.cost_eur) > 1e-7;
  }
}

TEST(Ties, GoByMassThenCostThenIds) {
  Compared compared;
  for (std::uint64_t seed = 1; seed <= 28; ++seed)
    for (const Objective& objective : {Objective{0.0, 0.0, 0.0, 1.0}, Objective{0.0, 1.0, 0.0, 0.0},
                                       Objective{1.0, 0.0, 0.0, 0.0}}) {
      SCOPED_TRACE(seed);
      Compare(Drawn(seed, objective), compared);
    }
  RecordProperty("designs", compared.designs);
  EXPECT_GT(compared.designs, 200);
  EXPECT_GT(compared.ties, 80);
  EXPECT_GT(compared.by_mass, 20);
  EXPECT_GT(compared.by_cost, 8);
}

// Prices of all parts are needed where cost counts.
TEST(Ties, OfCostGoByMass) {
  Compared compared;
  for (std::uint64_t seed = 1; seed <= 16; ++seed) {
    SCOPED_TRACE(seed);
    Compare(Drawn(seed, {0.0, 0.0, 1.0, 0.0}), compared);
  }
  EXPECT_GT(compared.by_mass, 2);
}

TEST(Ties, ThePriceAndTheMassOfAnObjectiveTellNothingApart) {
  const optimizer::Amounts amounts{0.123, 4e-4, 56.7};
  using optimizer::TieShareOf;
  EXPECT_EQ(TieShareOf({2.0, 0.0, 0.0, 0.0}, amounts), (optimizer::TieShare{0, 56'700'000}));
  EXPECT_EQ(TieShareOf({0.0, 0.0, 1.0, 0.0}, amounts), (optimizer::TieShare{123'000'000, 0}));
  EXPECT_EQ(TieShareOf({1.0, 0.0, 1.0, 0.0}, amounts),
            (optimizer::TieShare{123'000'000, 56'700'000}));
}

}  // namespace ties_test
}  // namespace plenum::test
