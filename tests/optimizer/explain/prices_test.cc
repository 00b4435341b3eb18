// Prices and flips against enumeration of the changed problems.
#include "optimizer/explain/prices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "optimizer/explain/explained_search.h"
#include "optimizer/explain/requirements.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace prices_test {

using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Flip;
using optimizer::Problem;
using optimizer::Status;

#ifdef PLENUM_SANITIZED
constexpr std::uint64_t kLastSeed = 4008;
#else
constexpr std::uint64_t kLastSeed = 4014;
#endif

Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = {Configuration::kCylinder, Configuration::kMains,
                         seed % 2 == 0 ? Configuration::kCompressor : Configuration::kCo2};
  draw.severity = 0.6;
  draw.size = {2, 1, 3, 2, 2, 2, 1, 2, 1};
  Problem problem = RandomProblem(draw);
  problem.exclude.insert("custom");
  problem.limits = {1, 2, 2, 2, 1};
  problem.count = 5;
  return problem;
}

void Set(Problem& problem, const std::string& pointer, double value) {
  for (const optimizer::Requirement& requirement : Requirements(problem))
    if (requirement.pointer == pointer) requirement.set(problem, value);
}

bool FirstIs(const Problem& problem, const Design& design) {
  const BruteForce truth = Enumerate(problem);
  return !truth.designs.empty() && truth.designs[0].key == KeyOf(design);
}

TEST(PricesTest, AreThoseOfEnumeration) {
  int prices = 0, positive = 0;
  for (std::uint64_t seed = 4001; seed <= kLastSeed; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed);
    problem.configurations = {Configuration::kCylinder};
    // The best design just fails, and would not with a tenth less.
    const optimizer::Answer answer = optimizer::Search(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    for (const optimizer::Margin& margin : answer.designs[0].margins)
      if (margin.requirement == "/duty/actuations") problem.actuations = 1.05 * margin.achieved;
    const BruteForce nominal = Enumerate(problem);
    if (nominal.designs.empty()) continue;
    for (const optimizer::Price& price : FindPrices(problem, Within(60.0))) {
      const bool duty = price.requirement.starts_with("/duty/");
      EXPECT_DOUBLE_EQ(price.loosened, price.required * (duty ? 0.9 : 1.1)) << price.requirement;
      Problem looser = problem;
      Set(looser, price.requirement, price.loosened);
      const BruteForce truth = Enumerate(looser);
      ASSERT_FALSE(truth.designs.empty());
      ASSERT_EQ(price.status, Status::kOptimal);
      const double least = truth.designs[0].leaf.objective;
      EXPECT_NEAR(*price.objective, least, 2e-6 * least) << price.requirement;
      EXPECT_LE(price.lower_bound, *price.objective);
      ++prices;
      positive += least < nominal.designs[0].leaf.objective * (1.0 - 1e-6);
    }
  }
  std::printf("%d prices, %d positive\n", prices, positive);
  EXPECT_GE(positive, 2);
}

TEST(PricesTest, SayWhatWasNotSearched) {
  optimizer::SearchOptions options = Within(60.0);
  options.cancelled = [] { return true; };
  for (const optimizer::Price& price : FindPrices(Drawn(4001), options)) {
    EXPECT_EQ(price.status, Status::kCancelled);
    EXPECT_FALSE(price.objective.has_value());
  }
}

// The part's mass, volume and price times `factor`.
void Scale(model::Parts& parts, const std::string& id, double factor) {
  const auto scale = [&](auto& family) {
    for (auto& part : family) {
      model::PartBasics* basics = nullptr;
      if constexpr (requires { part.per_metre; })
        basics = &part.per_metre;
      else
        basics = &part.basics;
      if (basics->id != id) continue;
      basics->mass_kg *= factor;
      basics->body_volume_m3 *= factor;
      if (basics->cost_eur) *basics->cost_eur *= factor;
    }
  };
  scale(parts.tubing);
  scale(parts.fittings);
  scale(parts.valves);
  scale(parts.compressors);
  scale(parts.batteries);
  scale(parts.cylinders);
  scale(parts.co2);
  scale(parts.regulators);
  scale(parts.reservoirs);
}

bool FirstWithScaled(const Problem& problem, const Design& design, const std::string& id,
                     double factor) {
  Problem changed = problem;
  Scale(changed.parts, id, factor);
  return FirstIs(changed, design);
}

void CheckParts(const Problem& problem, const Design& design, const Flip& flip) {
  for (const optimizer::Choice& choice : design.parts) {
    const auto found = std::find_if(flip.parts.begin(), flip.parts.end(),
                                    [&](const auto& part) { return part.id == choice.id; });
    if (found == flip.parts.end()) {
      EXPECT_FALSE(FirstWithScaled(problem, design, choice.id, 1e-6)) << choice.id;
      continue;
    }
    EXPECT_TRUE(found->confirmed) << choice.id;
    EXPECT_TRUE(FirstWithScaled(problem, design, choice.id, 1.0 - found->share)) << choice.id;
    // The share goes past a tie by 1e-5 of the objective.
    if (flip.objective_gap > 1.1e-3 * design.objective) {
      EXPECT_FALSE(FirstWithScaled(problem, design, choice.id, 1.0 - 0.99 * found->share))
          << choice.id;
    }
  }
}

void CheckRequirements(const Problem& problem, const Design& design, const Flip& flip) {
  for (const optimizer::RequirementFlip& found : flip.requirements) {
    Problem changed = problem;
    Set(changed, found.requirement, found.tightened);
    EXPECT_TRUE(found.confirmed) << found.requirement;
    EXPECT_TRUE(FirstIs(changed, design)) << found.requirement;
    // A little less is not enough.
    const double less = found.required * std::pow(found.tightened / found.required, 0.98);
    if (std::abs(found.tightened / found.required - 1.0) < 0.1) continue;
    Set(changed, found.requirement, less);
    EXPECT_FALSE(FirstIs(changed, design)) << found.requirement;
  }
}

TEST(FlipsTest, AreThoseOfEnumeration) {
  std::size_t parts = 0, requirements = 0;
  for (std::uint64_t seed = 4001; seed <= kLastSeed; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Problem problem = Drawn(seed);
    const std::vector<Design> designs = optimizer::Search(problem, Within(60.0)).designs;
    const std::vector<Flip> flips = FindFlips(problem, designs, 4, Within(60.0));
    EXPECT_EQ(flips.size(), std::min<std::size_t>(designs.empty() ? 0 : designs.size() - 1, 3));
    for (const Flip& flip : flips) {
      SCOPED_TRACE("rank " + std::to_string(flip.rank));
      const Design& design = designs[static_cast<std::size_t>(flip.rank) - 1];
      EXPECT_TRUE(flip.complete);
      EXPECT_DOUBLE_EQ(flip.objective_gap, design.objective - designs[0].objective);
      CheckParts(problem, design, flip);
      CheckRequirements(problem, design, flip);
      parts += flip.parts.size();
      requirements += flip.requirements.size();
    }
  }
  std::printf("%zu flips by a part, %zu by a requirement\n", parts, requirements);
  EXPECT_GT(parts, 3u);
  EXPECT_GT(requirements, 0u);
}

}  // namespace prices_test
}  // namespace plenum::test
