// The search against plain enumeration of every combination of small random catalogues.
#include "tests/support/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "optimizer/search/tree_search.h"
#include "tests/support/small_catalogue.h"
#include "verify/verify.h"

namespace plenum::test {
namespace brute_force_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Status;

// What the draws came to, over a whole test.
struct Tally {
  int problems = 0, infeasible = 0, with_undecided = 0;
  long long designs = 0, made = 0, undecided = 0, evaluated = 0;
  double search_s = 0.0, slowest_s = 0.0, enumerate_s = 0.0;
  ~Tally() {
    std::printf(
        "%d problems, %d infeasible, %lld designs compared (%lld with a "
        "made-to-measure reservoir), %lld of %lld leaves undecided in %d "
        "problems; search %.2f s (slowest %.3f s), enumeration %.2f s\n",
        problems, infeasible, designs, made, undecided, evaluated, with_undecided, search_s,
        slowest_s, enumerate_s);
  }
};

double SecondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string Text(const PartsKey& key) {
  std::string text;
  for (const auto& [id, quantity] : key) text += id + "*" + std::to_string(quantity) + " ";
  return text;
}

void ExpectCountsAddUp(const optimizer::Proof& proof, long long combinations) {
  const optimizer::Pruned& pruned = proof.pruned;
  EXPECT_EQ(proof.combinations, combinations);
  EXPECT_EQ(pruned.incompatible + pruned.infeasible + pruned.bound + pruned.dominated +
                pruned.unpriced + proof.evaluated,
            proof.combinations);
}

// The same parts in the same order with the same objectives.
void ExpectSameList(const Answer& answer, const BruteForce& truth, std::size_t expected) {
  EXPECT_EQ(answer.status, truth.designs.empty() ? Status::kInfeasible : Status::kOptimal)
      << optimizer::Name(answer.status) << " gap " << answer.proof.gap;
  EXPECT_EQ(answer.designs.size(), expected);
  for (std::size_t i = 0; i < std::min(expected, answer.designs.size()); ++i) {
    const optimizer::Design& design = answer.designs[i];
    const Enumerated& enumerated = truth.designs[i];
    EXPECT_EQ(design.configuration, enumerated.configuration) << "rank " << i + 1;
    EXPECT_EQ(Text(KeyOf(design)), Text(enumerated.key))
        << "rank " << i + 1 << ": " << design.objective << " against " << enumerated.leaf.objective;
    EXPECT_NEAR(design.objective, enumerated.leaf.objective,
                1e-6 * std::abs(enumerated.leaf.objective))
        << "rank " << i + 1;
  }
}

// With leaves that could not be decided the list may have holes: then nothing is called optimal
// that is not, what is listed works, and the bound holds for what is not.
void ExpectHonest(const Answer& answer, const BruteForce& truth) {
  if (!truth.designs.empty()) {
    EXPECT_NE(answer.status, Status::kInfeasible);
  }
  for (const optimizer::Design& design : answer.designs) {
    const auto same = [&](const Enumerated& e) { return e.key == KeyOf(design); };
    EXPECT_TRUE(std::any_of(truth.designs.begin(), truth.designs.end(), same))
        << Text(KeyOf(design));
  }
  for (const Enumerated& enumerated : truth.designs) {
    const auto same = [&](const optimizer::Design& d) { return KeyOf(d) == enumerated.key; };
    if (std::none_of(answer.designs.begin(), answer.designs.end(), same)) {
      EXPECT_LE(answer.proof.lower_bound, enumerated.leaf.objective * (1.0 + 1e-9));
    }
  }
}

// What the search writes its verifier accepts, on a simulation of its own.
void ExpectVerified(const Problem& problem, const Answer& answer) {
  for (const verify::Check& check : verify::Verify(problem, answer).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
}

void Compare(const Problem& problem, Tally& tally) {
  auto start = std::chrono::steady_clock::now();
  const BruteForce truth = Enumerate(problem);
  tally.enumerate_s += SecondsSince(start);

  start = std::chrono::steady_clock::now();
  optimizer::SearchOptions options = Within(60.0);
  if (tally.problems % 2 == 1) options.crowd = 4;
  const Answer answer = optimizer::SearchTrees(problem, options);
  const double seconds = SecondsSince(start);
  tally.search_s += seconds;
  tally.slowest_s = std::max(tally.slowest_s, seconds);
  ++tally.problems;
  tally.infeasible += answer.status == Status::kInfeasible;
  tally.with_undecided += answer.proof.undecided > 0;
  tally.undecided += answer.proof.undecided;
  tally.evaluated += static_cast<long long>(answer.proof.evaluated.ToDouble());
  tally.designs += static_cast<long long>(answer.designs.size());
  for (const optimizer::Design& design : answer.designs)
    tally.made += std::any_of(design.parts.begin(), design.parts.end(),
                              [](const optimizer::Choice& part) { return part.id == "custom"; });

  ExpectCountsAddUp(answer.proof, truth.combinations);
  ExpectVerified(problem, answer);
  const std::size_t expected =
      std::min(truth.designs.size(), static_cast<std::size_t>(problem.count));
  if (answer.proof.undecided == 0 && truth.undecided == 0)
    ExpectSameList(answer, truth, expected);
  else
    ExpectHonest(answer, truth);
  // The bound holds for the best design that is not listed.
  if (truth.designs.size() > expected) {
    EXPECT_LE(answer.proof.lower_bound, truth.designs[expected].leaf.objective * (1.0 + 1e-9));
  }
}

const CatalogueSize kRegulatedSize{3, 3, 4, 3, 3, 3, 0, 3, 0};
const std::set<Configuration> kRegulated{Configuration::kCylinder, Configuration::kCo2,
                                         Configuration::kMains};

Problem Drawn(std::uint64_t seed, std::set<Configuration> configurations, double severity,
              const CatalogueSize& size, int groups = 1, bool simultaneous = true) {
  Draw draw;
  draw.seed = seed;
  draw.configurations = std::move(configurations);
  draw.severity = severity;
  draw.size = size;
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  return RandomProblem(draw);
}

// Sanitizers are about ten times slower: under them only every n-th draw is taken.
#ifdef PLENUM_SANITIZED
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

std::string Trace(std::uint64_t seed, const Problem& problem) {
  std::string text = "seed " + std::to_string(seed);
  for (Configuration configuration : problem.configurations)
    text += std::string(" ") + optimizer::Name(configuration);
  return text;
}

TEST(BruteForceTest, EachRegulatedConfigurationAlone) {
  Tally tally;
  constexpr std::uint64_t kStride = kSanitized ? 3 : 1;
  for (std::uint64_t seed = 1; seed <= 45; seed += kStride) {
    for (Configuration configuration : kRegulated) {
      const double severity = 0.1 + 0.02 * static_cast<double>(seed);
      const Problem problem = Drawn(seed, {configuration}, severity, kRegulatedSize);
      SCOPED_TRACE(Trace(seed, problem));
      Compare(problem, tally);
    }
  }
  EXPECT_GT(tally.problems - tally.infeasible, 50 / static_cast<int>(kStride));
  EXPECT_GT(tally.infeasible, 5 / static_cast<int>(kStride));
  EXPECT_EQ(tally.with_undecided, 0);
}

TEST(BruteForceTest, ObjectivesAndLimits) {
  constexpr optimizer::Objective kObjectives[] = {{0.0, 1.0, 0.0, 0.0},
                                                  {0.0, 0.0, 1.0, 0.0},
                                                  {0.0, 0.0, 0.0, 1.0},
                                                  {1.0, 0.3, 0.0, 0.0},
                                                  {0.5, 0.0, 0.002, 0.05}};
  Tally tally;
  constexpr std::uint64_t kStride = kSanitized ? 4 : 1;
  for (std::uint64_t seed = 1; seed <= 40; seed += kStride) {
    Problem problem = Drawn(500 + seed, kRegulated, 0.3, {2, 2, 3, 2, 2, 2, 0, 2, 0});
    problem.objective = kObjectives[seed % 5];
    // A limit through the middle of what is feasible.
    const BruteForce all = Enumerate(problem);
    if (all.designs.empty()) continue;
    const std::size_t middle = all.designs.size() / 2;
    const double value = all.designs[middle].leaf.objective;
    if (seed % 5 == 0) problem.volume_max_l = value;
    if (seed % 5 == 1) problem.cost_max_eur = value;
    if (seed % 2 == 0) problem.mass_max_kg = 1.5;
    SCOPED_TRACE(Trace(seed, problem) + " objective " + std::to_string(seed % 5));
    Compare(problem, tally);
  }
  EXPECT_GT(tally.problems, 25 / static_cast<int>(kStride));
  EXPECT_EQ(tally.with_undecided, 0);
}

TEST(BruteForceTest, CompressorWithStockReservoirs) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Problem problem = Drawn(1000 + seed, {Configuration::kCompressor},
                            0.035 * static_cast<double>(seed), {2, 2, 3, 0, 0, 0, 2, 3, 2});
    problem.exclude.insert("custom");
    SCOPED_TRACE(Trace(seed, problem));
    Compare(problem, tally);
  }
  EXPECT_GT(tally.problems - tally.infeasible, 5);
  EXPECT_LE(20 * tally.undecided, tally.evaluated);
}

TEST(BruteForceTest, CompressorWithMadeReservoir) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Problem problem = Drawn(1100 + seed, {Configuration::kCompressor},
                            0.08 * static_cast<double>(seed), {1, 1, 2, 0, 0, 0, 1, 2, 1});
    problem.limits.compressors = 1;
    problem.limits.batteries = 1;
    if (seed % 2 == 0) problem.require[optimizer::Family::kReservoir] = {"custom"};
    SCOPED_TRACE(Trace(seed, problem));
    Compare(problem, tally);
  }
  EXPECT_LE(20 * tally.undecided, tally.evaluated);
}

TEST(BruteForceTest, AllConfigurationsTogether) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::set<Configuration> all = kRegulated;
    all.insert(Configuration::kCompressor);
    Problem problem =
        Drawn(1200 + seed, all, 0.05 * static_cast<double>(seed), {2, 2, 2, 2, 2, 2, 2, 2, 1});
    if (seed % 3 != 0) problem.exclude.insert("custom");
    problem.limits = {1, 2, 2, 2, 1};
    problem.parts.compressors.resize(seed % 3 == 0 ? 1 : 2);
    SCOPED_TRACE(Trace(seed, problem));
    Compare(problem, tally);
  }
  EXPECT_LE(20 * tally.undecided, tally.evaluated);
}

// Everything at once: sources, objectives, one to three groups, numbers of designs, parts in
// parallel, parts that are required or excluded. PLENUM_BRUTE_FORCE sets the number of problems
// (1000 take some minutes), PLENUM_BRUTE_FORCE_FIRST the first seed.

Problem DrawnAtRandom(std::uint64_t seed) {
  constexpr optimizer::Objective kObjectives[] = {{1.0, 0.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0},
                                                  {0.0, 0.0, 1.0, 0.0}, {0.0, 0.0, 0.0, 1.0},
                                                  {1.0, 0.3, 0.0, 0.0}, {0.5, 0.0, 0.002, 0.05}};
  Random random(seed);
  Draw draw;
  draw.seed = 20000 + seed;
  draw.groups = Chance(random, 0.75) ? 1 : Pick(random, 2, 3);
  draw.simultaneous = draw.groups > 1 && Chance(random, 0.3);
  draw.severity = Uniform(random, 0.0, 0.5);
  draw.configurations = {static_cast<Configuration>(Pick(random, 0, 3))};
  if (draw.groups == 1 && Chance(random, 0.4))
    draw.configurations.insert(static_cast<Configuration>(Pick(random, 0, 3)));
  draw.size = draw.groups == 1 ? CatalogueSize{2, 2, 3, 2, 2, 2, 2, 2, 2}
                               : CatalogueSize{1, 2, 2, 1, 1, 2, 1, 2, 1};
  Problem problem = RandomProblem(draw);
  problem.objective = kObjectives[Pick(random, 0, 5)];
  problem.count = Pick(random, 1, 20);
  const bool made = draw.configurations.contains(Configuration::kCompressor) &&
                    Chance(random, draw.groups == 1 ? 0.8 : 0.4);
  if (!made) {
    problem.exclude.insert("custom");
  } else {  // scans take long
    problem.parts.tubing.resize(1);
    problem.parts.fittings.resize(1);
    problem.parts.valves.resize(draw.groups == 1 ? 2 : 1);
    problem.parts.compressors.resize(1);
    problem.parts.batteries.resize(draw.groups == 1 ? 2 : 1);
    if (Chance(random, 0.5)) problem.require[optimizer::Family::kReservoir] = {"custom"};
  }
  if (made)
    problem.limits = {1, 1, 1, 1, 1};
  else if (draw.groups > 1)
    problem.limits = {1, 2, 2, 2, 1};
  if (Chance(random, 0.3))
    for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
  if (Chance(random, 0.2)) problem.mass_max_kg = Uniform(random, 0.5, 3.0);
  if (Chance(random, 0.1)) problem.volume_max_l = Uniform(random, 0.5, 3.0);
  return problem;
}

TEST(BruteForceTest, EverythingAtRandom) {
  const char* wanted = std::getenv("PLENUM_BRUTE_FORCE");
  const int problems = wanted != nullptr ? std::atoi(wanted) : kSanitized ? 10 : 60;
  const char* first = std::getenv("PLENUM_BRUTE_FORCE_FIRST");
  const std::uint64_t begin = first != nullptr ? std::strtoull(first, nullptr, 10) : 1;
  Tally tally;
  for (std::uint64_t seed = begin; seed < begin + static_cast<std::uint64_t>(problems); ++seed) {
    const Problem problem = DrawnAtRandom(seed);
    SCOPED_TRACE(Trace(seed, problem) + " groups " + std::to_string(problem.groups.size()) +
                 (problem.simultaneous ? " together" : " in turns") + ", " +
                 std::to_string(problem.count) + " wanted");
    Compare(problem, tally);
  }
  EXPECT_GT(tally.designs, problems);
  EXPECT_LE(20 * tally.undecided, tally.evaluated);
}

TEST(BruteForceTest, TwoGroups) {
  Tally tally;
  for (std::uint64_t seed = 1; seed <= 14; ++seed) {
    const bool simultaneous = seed % 2 == 0;
    const Configuration configuration = static_cast<Configuration>((seed / 2) % 4);
    Problem problem =
        Drawn(1300 + seed, {configuration}, 0.2, {1, 2, 2, 1, 2, 2, 1, 2, 1}, 2, simultaneous);
    problem.exclude.insert("custom");
    problem.limits = {1, 2, 2, 2, 1};
    problem.count = std::min(problem.count, configuration == Configuration::kCompressor ? 2 : 8);
    SCOPED_TRACE(Trace(seed, problem) + (simultaneous ? " together" : " staggered"));
    Compare(problem, tally);
  }
  EXPECT_GT(tally.problems - tally.infeasible, 5);
  EXPECT_LE(20 * tally.undecided, tally.evaluated);
}

}  // namespace brute_force_test
}  // namespace plenum::test
