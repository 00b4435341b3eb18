// Groups that fill together take as long as in a simulation of the whole cycle.
#include "optimizer/evaluate/strokes/shared_filling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace shared_filling_test {

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

// Of this sonic conductance in dm³/(s·bar).
model::FlowElement Element(double conductance) {
  model::FlowElement element;
  element.sonic_conductance_m3_per_s_pa = conductance * 1e-8;
  element.critical_ratio = 0.3;
  return element;
}

void ExpectSame(double a, double b) {
  if (std::isfinite(a) || std::isfinite(b)) {
    EXPECT_NEAR(a, b, 1e-5 * b);
  }
}

struct Count {
  int compared = 0, unable = 0, failed = 0;
};

// Some of the combinations at some source pressures.
void Compare(const Problem& problem, Count& count) {
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
      ++count.compared;
      count.unable += !simulated.works;
      count.failed += together->failed;
      if (together->failed) continue;
      EXPECT_EQ(together->works, simulated.works);
      for (std::size_t g = 0; g < problem.groups.size(); ++g) {
        ExpectSame(together->rise_s[g], simulated.rise_s[g]);
        ExpectSame(together->inflate_s[g], simulated.inflate_s[g]);
      }
    }
  });
}

TEST(SharedFillingTest, AsSimulated) {
  Count count;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Compare(Drawn(seed, 2 + static_cast<int>(seed % 2)), count);
  }
  EXPECT_GT(count.compared, 30);
  EXPECT_EQ(count.failed, 0);
  EXPECT_LT(count.unable, count.compared);
}

// Strokes that overlap and are all over before the period is: one period tells all.
TEST(SharedFillingTest, AGaitThatComesToRestInEachPeriod) {
  Count count;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Problem problem = Drawn(seed, 2);
    problem.groups[0].gait.phases = {0.0};
    problem.groups[1].gait.phases = {seed % 2 == 0 ? 0.5 : 0.25};  // up to the period's end; before
    for (auto& group : problem.groups) group.count = 1;
    problem.groups[0].gait.inflate_fraction = 0.6;
    Compare(problem, count);
  }
  EXPECT_GT(count.compared, 20);
  EXPECT_EQ(count.failed, 0);
}

// A chamber of 0.25 mL comes up to the node while one of 1 L fills; when the large one's valve
// closes, the node jumps, and the small one is behind its own line again.
TEST(SharedFillingTest, AChamberLeavesTheNodeWhereAValveCloses) {
  Problem problem = Drawn(2, 2);
  std::optional<Candidate> candidate;
  optimizer::Line large, small;
  ForEachCombination(problem, [&](const Candidate& any) {
    candidate = any;
    large = *any.lines[0];
    small = *any.lines[1];
  });
  ASSERT_TRUE(candidate.has_value());
  problem.parts.regulators[candidate->regulator.index].flow = Element(0.2);
  problem.frequency_hz = 0.05;
  large.fill = {Element(1.0)};
  small.fill = {Element(0.02)};
  large.chamber.rest_volume_m3 = 1e-3;
  small.chamber.rest_volume_m3 = 0.25e-6;
  large.chamber.dead_volume_m3 = small.chamber.dead_volume_m3 = 0.0;
  large.holds = small.holds = true;
  candidate->lines = {&large, &small};
  const auto operate = [&](std::size_t g, optimizer::Line& line, double pressure_pa) {
    line.chamber.operating_pressure_pa = pressure_pa;
    problem.groups[g].chamber = line.chamber;
    problem.groups[g].count = 1;
    problem.groups[g].rise_time_max_s = problem.groups[g].fall_time_max_s = optimizer::kUnlimited;
    problem.groups[g].pressure_max_pa = 3e5;
  };
  operate(0, large, 1.8e5);
  for (double small_pa : {1.86e5, 1.875e5, 1.955e5, 2.355e5, 2.9e5}) {
    SCOPED_TRACE(small_pa);
    operate(1, small, small_pa);
    const auto together = optimizer::FillTogether(problem, *candidate, 3e5);
    ASSERT_TRUE(together && together->works);
    const Strokes simulated = optimizer::SimulateStrokes(problem, *candidate, {3e5, 0.0, 0.0});
    ASSERT_TRUE(simulated.works);
    for (std::size_t g = 0; g < 2; ++g) {
      ExpectSame(together->rise_s[g], simulated.rise_s[g]);
      ExpectSame(together->inflate_s[g], simulated.inflate_s[g]);
    }
  }
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

}  // namespace shared_filling_test
}  // namespace plenum::test
