// Lists of kinds against plain enumeration, and by relations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/kind.h"
#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/verify.h"

namespace plenum::test {
namespace kinds_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::ListOf;
using optimizer::Problem;
using optimizer::Status;

// What makes a kind, by the names of series.
struct KindNames {
  Configuration configuration{};
  std::set<std::string> sources, regulators, valves;
  bool operator<(const KindNames& other) const {
    return std::tie(configuration, sources, regulators, valves) <
           std::tie(other.configuration, other.sources, other.regulators, other.valves);
  }
};
using Source = std::pair<Configuration, std::set<std::string>>;

// Of all parts that make kinds, whose ids tell their families apart.
class Series {
 public:
  explicit Series(const model::Parts& parts) {
    const auto add = [&](const auto& family, std::set<std::string> KindNames::*place) {
      for (const auto& part : family)
        of_[part.basics.id] = {place,
                               part.basics.series.empty() ? part.basics.id : part.basics.series};
    };
    add(parts.compressors, &KindNames::sources);
    add(parts.cylinders, &KindNames::sources);
    add(parts.co2, &KindNames::sources);
    add(parts.regulators, &KindNames::regulators);
    add(parts.valves, &KindNames::valves);
  }
  KindNames Of(Configuration configuration, const PartsKey& key) const {
    KindNames kind{configuration, {}, {}, {}};
    for (const auto& [id, quantity] : key)
      if (const auto found = of_.find(id); found != of_.end())
        (kind.*found->second.first).insert(found->second.second);
    return kind;
  }

 private:
  std::map<std::string, std::pair<std::set<std::string> KindNames::*, std::string>> of_;
};

// By the contract: of all designs, in their order, the best of each kind; of a source as many as
// there may be.
std::vector<Enumerated> BestOfKinds(const Problem& problem, const BruteForce& truth) {
  const Series series(problem.parts);
  std::map<KindNames, std::vector<const Enumerated*>> kinds;
  for (const Enumerated& design : truth.designs)
    kinds[series.Of(design.configuration, design.key)].push_back(&design);
  std::vector<Enumerated> best;
  for (const auto& [kind, designs] : kinds) {
    const double least =
        (*std::min_element(designs.begin(), designs.end(), [](const auto* a, const auto* b) {
          return a->leaf.objective < b->leaf.objective;
        }))->leaf.objective;
    const Enumerated* first = nullptr;
    for (const Enumerated* design : designs)
      if (design->leaf.objective <= least * (1.0 + 1e-6) && (!first || GoesBefore(*design, *first)))
        first = design;
    best.push_back(*first);
  }
  Rank(best);
  std::map<Source, int> of_source;
  std::vector<Enumerated> listed;
  for (const Enumerated& design : best) {
    const KindNames kind = series.Of(design.configuration, design.key);
    if (++of_source[{kind.configuration, kind.sources}] <= problem.limits.per_source)
      listed.push_back(design);
  }
  if (static_cast<int>(listed.size()) > problem.count) listed.resize(problem.count);
  return listed;
}

// Some parts of a family share a series.
template <typename Part>
void DrawSeries(Random& random, std::vector<Part>& parts, const std::string& family) {
  for (Part& part : parts)
    if (Chance(random, 0.7))
      part.basics.series = family + " series " + std::to_string(Pick(random, 1, 3));
}

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations, int groups,
              const CatalogueSize& size) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = std::move(configurations);
  draw.severity = 0.4;
  draw.size = size;
  draw.groups = groups;
  draw.simultaneous = seed % 2 == 0;
  Problem problem = RandomProblem(draw);
  Random random(seed * 31 + 7);
  DrawSeries(random, problem.parts.valves, "valve");
  DrawSeries(random, problem.parts.regulators, "regulator");
  DrawSeries(random, problem.parts.cylinders, "cylinder");
  DrawSeries(random, problem.parts.co2, "co2");
  DrawSeries(random, problem.parts.compressors, "pump");
  if (seed % 8 != 0) problem.exclude.insert("custom");  // which takes long to enumerate
  problem.limits.batteries = problem.limits.compressors = 2;
  problem.list = ListOf::kKinds;
  problem.count = Pick(random, 1, 8);
  problem.limits.per_source = Pick(random, 1, 3);
  return problem;
}

std::string Text(const PartsKey& key) {
  std::string text;
  for (const auto& [id, quantity] : key) text += id + "*" + std::to_string(quantity) + " ";
  return text;
}

void ExpectVerified(const Problem& problem, const Answer& answer) {
  for (const verify::Check& check : verify::Verify(problem, answer).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
}

// The number of designs that were compared.
int Compare(const Problem& problem) {
  const BruteForce truth = Enumerate(problem);
  optimizer::SearchOptions options = Within(60.0);
  options.record = true;
  const Answer answer = optimizer::SearchTrees(problem, options);
  ExpectVerified(problem, answer);
  if (answer.proof.undecided > 0 || truth.undecided > 0) return 0;
  const std::vector<Enumerated> expected = BestOfKinds(problem, truth);
  EXPECT_EQ(answer.status, expected.empty() ? Status::kInfeasible : Status::kOptimal);
  EXPECT_EQ(answer.designs.size(), expected.size());
  for (std::size_t i = 0; i < std::min(expected.size(), answer.designs.size()); ++i) {
    EXPECT_EQ(Text(KeyOf(answer.designs[i])), Text(expected[i].key)) << "rank " << i + 1;
    EXPECT_NEAR(answer.designs[i].objective, expected[i].leaf.objective,
                1e-6 * std::abs(expected[i].leaf.objective));
  }
  return static_cast<int>(expected.size());
}

int CompareDraws(std::uint64_t first, int draws, const std::set<Configuration>& configurations,
                 int groups, const CatalogueSize& size) {
  int compared = 0;
  for (int i = 0; i < draws; ++i) {
    const std::uint64_t seed = first + static_cast<std::uint64_t>(i);
    SCOPED_TRACE("seed " + std::to_string(seed));
    compared += Compare(Drawn(seed, configurations, groups, size));
  }
  return compared;
}

const std::set<Configuration> kRegulated{Configuration::kCylinder, Configuration::kCo2,
                                         Configuration::kMains};

TEST(KindsTest, RegulatedAsEnumerated) {
  EXPECT_GT(CompareDraws(100, 40, kRegulated, 1, {3, 3, 5, 4, 4, 3, 0, 3, 0}), 60);
}

TEST(KindsTest, CompressorAsEnumerated) {
  EXPECT_GT(CompareDraws(201, 12, {Configuration::kCompressor}, 1, {1, 1, 3, 0, 0, 0, 4, 2, 1}),
            12);
}

TEST(KindsTest, SeveralGroupsAsEnumerated) {
  EXPECT_GT(CompareDraws(300, 12, {Configuration::kMains}, 2, {1, 2, 4, 2, 0, 0, 0, 0, 0}), 8);
  EXPECT_GT(CompareDraws(400, 10, {Configuration::kMains}, 3, {1, 2, 3, 1, 0, 0, 0, 0, 0}), 2);
}

void CompareRegulated(std::uint64_t first, std::uint64_t end,
                      const optimizer::Objective& objective) {
  for (std::uint64_t seed = first; seed < end; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, kRegulated, 1, {3, 3, 5, 4, 4, 3, 0, 3, 0});
    problem.objective = objective;
    Compare(problem);
  }
}

// Each part its own series, and all places for one source: the kinds are sets of parts.
TEST(KindsTest, CostAsEnumerated) { CompareRegulated(500, 510, {0.0, 0.0, 1.0, 0.0}); }

// Where designs of a kind tie, and kinds do, the lightest is listed.
TEST(KindsTest, LeastEnergyAsEnumerated) { CompareRegulated(520, 550, {0.0, 0.0, 0.0, 1.0}); }

// The first is the best of all combinations; more kinds of a source leave the first ones as they
// were.
TEST(KindsTest, MorePerSourceKeepsTheBest) {
  for (std::uint64_t seed = 600; seed < 606; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, kRegulated, 1, {3, 3, 5, 4, 4, 3, 0, 3, 0});
    problem.limits.per_source = 1;
    const Answer one = optimizer::SearchTrees(problem, Within(60.0));
    problem.limits.per_source = 3;
    const Answer three = optimizer::SearchTrees(problem, Within(60.0));
    problem.list = ListOf::kCombinations;
    problem.count = 1;
    const Answer best = optimizer::SearchTrees(problem, Within(60.0));
    ASSERT_EQ(best.designs.empty(), one.designs.empty());
    ASSERT_EQ(best.designs.empty(), three.designs.empty());
    if (best.designs.empty()) continue;
    EXPECT_EQ(KeyOf(one.designs.front()), KeyOf(best.designs.front()));
    EXPECT_EQ(KeyOf(three.designs.front()), KeyOf(best.designs.front()));
  }
}

// The variants are all feasible designs of the kind within 1 % of its best, by enumeration.
TEST(KindsTest, VariantsAsEnumerated) {
  int compared = 0;
  for (std::uint64_t seed = 700; seed < 712; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, kRegulated, seed % 3 == 0 ? 2 : 1,
                            {seed % 3 == 0 ? 1 : 4, 3, 4, 2, 3, 2, 0, 4, 0});
    if (seed % 3 == 0) problem.configurations = {Configuration::kMains};
    const BruteForce truth = Enumerate(problem);
    const Answer answer = optimizer::Search(problem, Within(60.0));
    if (answer.proof.undecided > 0 || truth.undecided > 0) continue;
    const Series series(problem.parts);
    for (const optimizer::Design& design : answer.designs) {
      const KindNames kind = series.Of(design.configuration, KeyOf(design));
      std::set<PartsKey> expected, found;
      for (const Enumerated& other : truth.designs) {
        const KindNames own = series.Of(other.configuration, other.key);
        if (!(kind < own) && !(own < kind) && other.key != KeyOf(design) &&
            other.leaf.objective <= 1.01 * design.objective)
          expected.insert(other.key);
      }
      ASSERT_TRUE(design.variants.has_value());
      EXPECT_TRUE(design.variants->complete);
      for (const optimizer::Variant& variant : design.variants->found) {
        optimizer::Design same = design;
        same.parts = variant.parts;
        found.insert(KeyOf(same));
      }
      EXPECT_EQ(found, expected);
      compared += static_cast<int>(expected.size());
    }
  }
  EXPECT_GT(compared, 10);
}

// The best of each configuration is what a search of that configuration alone finds, or why there
// is none.
TEST(KindsTest, BestOfEachConfiguration) {
  for (std::uint64_t seed = 800; seed < 808; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, kRegulated, 1, {3, 3, 5, 4, 4, 3, 0, 3, 0});
    problem.count = 2;
    const Answer answer = optimizer::Search(problem, Within(60.0));
    if (answer.designs.empty()) continue;
    ASSERT_EQ(answer.by_configuration.size(), problem.configurations.size());
    for (const optimizer::BestDesign& best : answer.by_configuration) {
      Problem own = problem;
      own.configurations = {best.configuration};
      own.list = ListOf::kCombinations;
      own.count = 1;
      const Answer alone = optimizer::SearchTrees(own, Within(60.0));
      EXPECT_EQ(best.status, alone.status);
      ASSERT_EQ(best.design.has_value(), !alone.designs.empty());
      if (best.design) {
        EXPECT_EQ(KeyOf(*best.design), KeyOf(alone.designs.front()));
      }
      EXPECT_EQ(best.conflict.empty(), best.design.has_value());
    }
  }
}

// What a claimed list leaves out, or has twice, is found.
TEST(KindsTest, VerifyRefusesWhatIsNoListOfKinds) {
  Problem problem = Drawn(104, kRegulated, 1, {3, 3, 5, 4, 4, 3, 0, 3, 0});
  problem.count = 4;
  problem.limits.per_source = 2;
  optimizer::SearchOptions options = Within(60.0);
  options.record = true;
  const Answer answer = optimizer::SearchTrees(problem, options);
  ASSERT_EQ(answer.designs.size(), 4u);
  const auto accepted = [&](const Problem& stated, const Answer& claim) {
    const auto checks = verify::Verify(stated, claim).checks;
    return std::all_of(checks.begin(), checks.end(), [](const auto& check) { return check.ok; });
  };
  EXPECT_TRUE(accepted(problem, answer));
  Problem combinations = problem;
  combinations.list = ListOf::kCombinations;
  EXPECT_FALSE(accepted(combinations, answer));
  Problem fewer = problem;
  fewer.limits.per_source = 1;
  EXPECT_FALSE(accepted(fewer, answer));
  Problem one_series = problem;  // as if all valves were of one kind
  for (model::Valve& valve : one_series.parts.valves) valve.basics.series = "the same";
  for (model::Regulator& part : one_series.parts.regulators) part.basics.series = "the same";
  EXPECT_FALSE(accepted(one_series, answer));
}

}  // namespace kinds_test
}  // namespace plenum::test
