// Groups that fill together take as long as in a simulation of the whole cycle.
#include "optimizer/evaluate/shared_filling.h"

#include <gtest/gtest.h>

#include <cmath>

#include "optimizer/evaluate/evaluate_strokes.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Problem;
using optimizer::Strokes;

Problem Drawn(std::uint64_t seed, int groups) {
  Draw draw;
  draw.seed = 8600 + seed;
  draw.configurations = {seed % 2 == 0 ? Configuration::kMains : Configuration::kCo2};
  draw.groups = groups;
  draw.severity = 0.2;
  draw.size = {1, 2, 3, 1, 1, 2, 0, 1, 0};
  return RandomProblem(draw);
}

void ExpectSame(double a, double b) {
  if (std::isfinite(a) || std::isfinite(b)) {
    EXPECT_NEAR(a, b, 1e-5 * b);
  }
}

TEST(SharedFillingTest, AsSimulated) {
  int compared = 0, unable = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Problem problem = Drawn(seed, 2 + static_cast<int>(seed % 2));
    SCOPED_TRACE("seed " + std::to_string(seed));
    int looked = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (++looked % 3 != 1 || looked > 3 * 20) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      for (double share : {0.001, 0.02, 0.1, 1.0}) {
        const double source_pa = window.low_pa + share * (window.high_pa - window.low_pa);
        const auto together = optimizer::FillTogether(problem, candidate, source_pa);
        ASSERT_TRUE(together.has_value());
        const Strokes simulated =
            optimizer::SimulateStrokes(problem, candidate, {source_pa, 0.0, 0.0});
        EXPECT_FALSE(together->failed);
        EXPECT_EQ(together->works, simulated.works);
        for (std::size_t g = 0; g < problem.groups.size(); ++g) {
          ExpectSame(together->rise_s[g], simulated.rise_s[g]);
          ExpectSame(together->inflate_s[g], simulated.inflate_s[g]);
        }
        ++compared;
        unable += !simulated.works;
      }
    });
  }
  EXPECT_GT(compared, 30);
  EXPECT_LT(unable, compared);
}

// Equal lines to equal chambers of several groups are one group to a reservoir.
TEST(SharedFillingTest, AlikeOnAReservoir) {
  int compared = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Draw draw;
    draw.seed = 8650 + seed;
    draw.configurations = {Configuration::kCompressor};
    draw.groups = 2;
    draw.severity = 0.1;
    draw.size = {1, 1, 2, 0, 0, 0, 1, 1, 1};
    Problem problem = RandomProblem(draw);
    problem.exclude.insert("custom");
    problem.groups[1] = problem.groups[0];
    problem.groups[1].count = problem.groups[0].count + 1;
    SCOPED_TRACE("seed " + std::to_string(seed));
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.lines[0]->valve != candidate.lines[1]->valve || compared >= 12) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      const double volume_m3 = StockVolume(problem, candidate);
      const optimizer::OperatingPoint point{window.high_pa, volume_m3, volume_m3};
      const Strokes alike = optimizer::EvaluateStrokes(problem, candidate, point);
      const Strokes simulated = optimizer::SimulateStrokes(problem, candidate, point);
      if (!alike.works || !simulated.works) return;
      ++compared;
      for (std::size_t g = 0; g < 2; ++g) {
        EXPECT_NEAR(alike.rise_s[g], simulated.rise_s[g], 1e-4 * simulated.rise_s[g]);
        EXPECT_NEAR(alike.inflate_s[g], simulated.inflate_s[g], 1e-4 * simulated.inflate_s[g]);
      }
    });
  }
  EXPECT_GT(compared, 3);
}

}  // namespace
}  // namespace plenum::test
