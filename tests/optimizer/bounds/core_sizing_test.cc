// Settings that leaves with different batteries share, against each leaf sized by itself.
#include "optimizer/bounds/core_sizing.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace core_sizing_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::LeafStatus;
using optimizer::Problem;

#ifdef PLENUM_SANITIZED
constexpr std::uint64_t kSeeds = 3;
#else
constexpr std::uint64_t kSeeds = 8;
#endif

Problem Drawn(std::uint64_t seed) {
  Draw draw;
  draw.seed = 7102 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.groups = 1;
  draw.severity = 0.0;
  draw.size = {1, 1, 2, 0, 0, 0, 1, 3, 1};
  Problem problem = RandomProblem(draw);
  problem.objective = {0.3, 0.0, 0.0, 0.05};
  return problem;
}

TEST(CoreSizingTest, ALeafOfItsCoreIsTheLeafSizedByItself) {
  int served = 0, refused = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Problem problem = Drawn(seed);
    const auto line = std::make_shared<const optimizer::Line>(AssembleLine(
        problem, 0, 0, problem.groups[0].fittings_per_line > 0 ? 0 : -1, 0, model::Gas::kAir));
    Candidate candidate;
    candidate.configuration = Configuration::kCompressor;
    candidate.lines = {line.get()};
    candidate.compressor = MakeOption(problem, optimizer::Family::kCompressor, 0, 1);
    candidate.reservoir.index = optimizer::kCustom;
    candidate.reservoir.quantity = 1;
    if (SourceWindow(problem, candidate).empty()) continue;
    optimizer::CoreSizing core{{line}, optimizer::CustomSizing(problem, candidate)};
    while (!core.done) core.done = core.sizing.Refine();
    for (int pack = 0; pack < 3; ++pack) {
      candidate.battery = MakeOption(problem, optimizer::Family::kBattery, pack, 1);
      const optimizer::Leaf alone = SizeAlone(problem, candidate);
      const std::optional<optimizer::Leaf> shared = LeafOfCore(problem, candidate, core);
      ++(shared ? served : refused);
      const optimizer::Leaf& any_battery = core.sizing.leaf();
      if (alone.status == LeafStatus::kFeasible) {
        EXPECT_NE(any_battery.status, LeafStatus::kInfeasible) << "seed " << seed;
        EXPECT_LE(any_battery.lower_bound + candidate.battery.objective,
                  alone.objective * (1.0 + optimizer::kTie))
            << "seed " << seed;
      }
      if (!shared) continue;
      ASSERT_EQ(alone.status, LeafStatus::kFeasible) << "seed " << seed;
      EXPECT_NEAR(shared->objective / alone.objective, 1.0, optimizer::kTie) << "seed " << seed;
      EXPECT_LE(shared->lower_bound, alone.objective);
    }
  }
  std::printf("%d served, %d refused\n", served, refused);
  EXPECT_GT(served, 0);
}

}  // namespace core_sizing_test
}  // namespace plenum::test
