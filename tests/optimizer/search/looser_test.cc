// Looser is never worse, and what is searched is decided.
#include <gtest/gtest.h>

#include <algorithm>

#include "optimizer/search/tree_search.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"
#include "verify/verify.h"

namespace plenum::test {
namespace looser_test {

using optimizer::Answer;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Status;

Answer Search(const Problem& problem) {
  optimizer::SearchOptions options = Within(60.0);
  options.record = true;
  const Answer answer = optimizer::SearchTrees(problem, options);
  for (const verify::Check& check : verify::Verify(problem, answer).checks)
    EXPECT_TRUE(check.ok) << check.name << ": " << check.detail;
  return answer;
}

// A made-to-measure reservoir is built for the pressure at which its own pumps stop: limits on the
// source that do not bind change nothing.
TEST(Looser, AMadeReservoirDoesNotGrowWithTheSourcesLimit) {
  int made = 0;
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = EasyProblem(seed, {Configuration::kCompressor});
    problem.parts.reservoirs.clear();
    problem.groups[0].rise_time_max_s = 0.4;
    problem.count = 1;
    const Answer free = Search(problem);
    ASSERT_EQ(free.status, Status::kOptimal);
    const optimizer::Design& design = free.designs[0];
    // 30 g, 150 g/L and 90 g/L for each MPa (model/physics/storage.h), worked out by hand.
    const auto reservoir =
        std::find_if(design.parts.begin(), design.parts.end(),
                     [](const optimizer::Choice& part) { return part.id == "custom"; });
    ASSERT_NE(reservoir, design.parts.end());
    const double gauge_mpa = (design.settings.source_pressure_pa - kAmbientPa) * 1e-6;
    EXPECT_NEAR(reservoir->mass_kg,
                0.03 + *design.settings.reservoir_volume_m3 * 1e3 * (0.15 + 0.09 * gauge_mpa),
                1e-9);
    for (const double times : {1.001, 2.0}) {
      Problem limited = problem;
      limited.source_pressure_max_pa = times * design.settings.source_pressure_pa;
      const Answer answer = Search(limited);
      ASSERT_EQ(answer.status, Status::kOptimal);
      EXPECT_EQ(KeyOf(answer.designs[0]), KeyOf(design));
      EXPECT_NEAR(answer.designs[0].objective, design.objective, 1e-6 * design.objective);
    }
    ++made;
  }
  EXPECT_EQ(made, 6);
}

// The lowest pressure at which a stroke ends within half of the period leaves the simulator no room
// to confirm it; more pressure does, and the leaf is decided.
TEST(Looser, AStrokeThatJustEndsInHalfOfThePeriodIsDecided) {
  int listed = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    Problem problem = EasyProblem(seed, {Configuration::kCompressor});
    problem.exclude.insert("custom");
    problem.groups[0].rise_time_max_s = optimizer::kUnlimited;  // half of the period decides
    problem.groups[0].fall_time_max_s = optimizer::kUnlimited;
    problem.frequency_hz = 0.6;
    problem.count = 3;
    problem.limits = {1, 1, 1, 1, 1};
    problem.parts.tubing.resize(1);
    problem.parts.fittings.resize(1);
    problem.parts.valves.resize(2);
    const Answer answer = Search(problem);
    const BruteForce truth = Enumerate(problem);
    EXPECT_EQ(answer.proof.undecided, 0);
    EXPECT_EQ(answer.status, truth.designs.empty() ? Status::kInfeasible : Status::kOptimal);
    ASSERT_EQ(answer.designs.size(), std::min<std::size_t>(3, truth.designs.size()));
    for (std::size_t i = 0; i < answer.designs.size(); ++i)
      EXPECT_EQ(KeyOf(answer.designs[i]), truth.designs[i].key) << "rank " << i + 1;
    listed += static_cast<int>(answer.designs.size());
  }
  EXPECT_GT(listed, 10);
}

}  // namespace looser_test
}  // namespace plenum::test
