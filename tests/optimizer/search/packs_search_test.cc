// Parts that are sold in whole packs, in the search: against plain enumeration, before the
// verifier, and against the same actuators as one group and as two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "optimizer/evaluate/packs.h"
#include "optimizer/front/pareto.h"
#include "optimizer/problem/family_specs.h"
#include "tests/support/enumerated_search.h"
#include "tests/support/packs/packs_by_hand.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace packs_search_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Design;
using optimizer::Family;
using optimizer::Problem;

Problem Drawn(std::uint64_t seed, int groups) {
  constexpr optimizer::Objective kObjectives[] = {
      {0.0, 0.0, 1.0, 0.0}, {1.0, 0.0, 0.02, 0.0}, {1.0, 0.0, 0.0, 0.0}};
  constexpr Configuration kAll[] = {Configuration::kCylinder, Configuration::kCompressor,
                                    Configuration::kMains, Configuration::kCo2};
  Draw draw;
  draw.seed = 61000 + seed;
  draw.groups = groups;
  draw.simultaneous = seed % 2 == 0;
  draw.severity = 0.02 * static_cast<double>(seed % 12);
  draw.configurations = {kAll[seed % 4]};
  draw.size = groups == 1   ? CatalogueSize{3, 3, 4, 2, 2, 2, 2, 2, 2}
              : groups == 2 ? CatalogueSize{2, 2, 3, 1, 1, 2, 1, 2, 1}
                            : CatalogueSize{2, 1, 2, 1, 1, 1, 1, 1, 1};
  Problem problem = RandomProblem(draw);
  problem.objective = kObjectives[seed % 3];
  problem.exclude.insert("custom");
  if (groups > 1) problem.limits = {1, 1, 2, 2, 1};
  if (groups == 3) problem.count = std::min(problem.count, 6);
  SellInPacks(seed, false, problem);
  return problem;
}

TEST(PacksSearch, ListsWhatEnumerationLists) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(seed, 1), tally);
  }
  EXPECT_GT(tally.feasible, 15);
  EXPECT_GT(tally.designs, 60);
}

TEST(PacksSearch, ListsWhatEnumerationListsOfGroupsThatShareParts) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(100 + seed, 2), tally);
  }
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(seed);
    CompareLists(Drawn(200 + seed, 3), tally);
  }
  EXPECT_GT(tally.feasible, 12);
  EXPECT_GT(tally.designs, 60);
}

// A limit that only some of the designs keep.
TEST(PacksSearch, KeepsLimitsOnCost) {
  Compared tally;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(300 + seed, 1 + static_cast<int>(seed % 2));
    problem.objective = {1.0, 0.0, 0.0, 0.0};
    problem.cost_max_eur = 1e6;
    const Answer all = optimizer::SearchTrees(problem, Within(60.0));
    if (all.designs.empty()) continue;
    problem.cost_max_eur = *all.designs.front().totals.cost_eur * 0.999;
    CompareLists(problem, tally);
  }
  EXPECT_GT(tally.feasible + tally.infeasible, 6);
}

// The verifier, by brute force of its own, where what joins lines comes in packs, too.
TEST(PacksSearch, JointsInPacksPassTheVerifier) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(400 + seed, 1 + static_cast<int>(seed % 2));
    SellInPacks(seed, true, problem);
    const Answer answer = Recorded(problem, 120.0);
    ExpectVerified(problem, answer);
    found += !answer.designs.empty();
  }
  EXPECT_GT(found, 8);
}

TEST(PacksSearch, TamperedPacksAreRefused) {
  int refused = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const Problem problem = Drawn(500 + seed, 1 + static_cast<int>(seed % 2));
    const Answer answer = Recorded(problem);
    if (answer.designs.empty() || answer.designs.front().packs.empty()) continue;
    ASSERT_TRUE(Accepts(problem, answer));
    EXPECT_TRUE(RefusesFirst(problem, answer, [](Design& d) { d.packs.front().packs += 1.0; }));
    EXPECT_TRUE(RefusesFirst(problem, answer, [](Design& d) { d.packs.pop_back(); }));
    EXPECT_TRUE(RefusesFirst(problem, answer, [](Design& d) { d.packs.front().pack *= 1.1; }));
    // Each row at its pieces' share of a pack, as before packs were bought whole.
    EXPECT_TRUE(RefusesFirst(problem, answer, [&](Design& d) {
      double sum = 0.0;
      for (optimizer::Choice& row : d.parts) {
        const int part = FindPart(problem.parts, row.family, row.id);
        if (row.cost_eur)
          row.cost_eur = row.quantity * *BasicsOf(problem.parts, row.family, part).cost_eur;
        sum += row.cost_eur.value_or(0.0);
      }
      if (sum == d.totals.cost_known_eur) d.objective = -1.0;  // its packs were all full
      d.totals.cost_known_eur = sum;
      if (d.totals.cost_eur) d.totals.cost_eur = sum;
    }));
    ++refused;
  }
  EXPECT_GT(refused, 8);
}

double CostOf(const Design& design) { return design.totals.cost_known_eur; }

// Two groups of the same actuators with the same parts buy what one group of all of them buys.
TEST(PacksSearch, OneGroupSplitInTwoCostsTheSame) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    Problem one = Drawn(600 + seed, 1);
    SellInPacks(seed, true, one);
    one.groups[0].count = 2 + static_cast<int>(seed % 5);
    for (model::Valve& valve : one.parts.valves) valve.channels = 1;
    one.objective = {0.0, 0.0, 1.0, 0.0};
    one.simultaneous = true;
    one.count = 1;
    const Answer whole = optimizer::SearchTrees(one, Within(60.0));
    if (whole.designs.empty()) continue;
    Problem two = one;
    two.groups.push_back(one.groups[0]);
    two.groups[0].count = 1;
    two.groups[1].count = one.groups[0].count - 1;
    two.groups[1].name = "others";
    const double share = 1.0 / one.groups[0].count;
    two.groups[0].joint_conductance_m3_per_s_pa *= share;
    two.groups[1].joint_conductance_m3_per_s_pa *= 1.0 - share;
    for (const optimizer::Choice& row : whole.designs[0].parts)
      if (!SpecOf(row.family).joins) two.require[row.family] = {row.id};
    const auto keep = [&](Family family, auto& parts) {
      std::erase_if(parts, [&](const auto& part) {
        const auto wanted = two.require.find(family);
        if (wanted == two.require.end()) return false;
        if constexpr (requires { part.per_metre; })
          return !wanted->second.contains(part.per_metre.id);
        else
          return !wanted->second.contains(part.basics.id);
      });
    };
    keep(Family::kTubing, two.parts.tubing);
    keep(Family::kFitting, two.parts.fittings);
    keep(Family::kValve, two.parts.valves);
    const Answer split = optimizer::SearchTrees(two, Within(60.0));
    ASSERT_FALSE(split.designs.empty());
    EXPECT_NEAR(CostOf(split.designs[0]), CostOf(whole.designs[0]),
                1e-9 * CostOf(whole.designs[0]));
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

// The cheapest and the lightest of a front are those of lists, and no point is beaten in both.
TEST(PacksSearch, FrontsOfMassAndCostAreWhatTheVerifierFinds) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = Drawn(700 + seed, 1 + static_cast<int>(seed % 2));
    problem.objective = {1.0, 0.0, 0.0, 0.0};
    const optimizer::Front front = optimizer::ParetoFront(
        problem, {optimizer::Amount::kMass, optimizer::Amount::kCost}, Within(60.0));
    for (const verify::Check& check : verify::VerifyFront(problem, front).checks)
      EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
    Problem cheapest = problem;
    cheapest.objective = {0.0, 0.0, 1.0, 0.0};
    cheapest.count = 1;
    const Answer least = optimizer::SearchTrees(cheapest, Within(60.0));
    ASSERT_EQ(least.designs.empty(), front.answer.designs.empty());
    if (least.designs.empty()) continue;
    double cost_eur = optimizer::kUnlimited;
    for (const Design& design : front.answer.designs) cost_eur = std::min(cost_eur, CostOf(design));
    EXPECT_NEAR(cost_eur, CostOf(least.designs[0]), 1e-6 * cost_eur);
    ++found;
  }
  EXPECT_GT(found, 3);
}

}  // namespace packs_search_test
}  // namespace plenum::test
