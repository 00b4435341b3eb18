// Bounds over rectangles of settings against evaluations inside.
#include "optimizer/pump/settings_bounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/support/brute_force.h"
#include "tests/support/small_catalogue.h"

namespace plenum::test {
namespace settings_bounds_test {

using optimizer::Candidate;
using optimizer::Configuration;
using optimizer::Evaluation;
using optimizer::LeastEvaluation;
using optimizer::Problem;
using optimizer::SettingsBox;
using optimizer::Strokes;

#ifdef PLENUM_SANITIZED
constexpr int kBoxes = 8;
#else
constexpr int kBoxes = 60;
#endif
constexpr double kAccuracy = 2e-6;  // of the strokes' integration

// Both kinds of pump, one to three groups in turns or together, valves that hold and others.
Problem Drawn(std::uint64_t seed, int groups, bool simultaneous, double severity = 0.0) {
  Draw draw;
  draw.seed = 8100 + seed;
  draw.configurations = {Configuration::kCompressor};
  draw.groups = groups;
  draw.simultaneous = simultaneous;
  draw.severity = severity;
  draw.size = {1, 1, 3, 0, 0, 0, 2, 2, 1};
  Problem problem = RandomProblem(draw);
  Random random(seed);
  if (seed % 3 == 0)
    for (model::Compressor& pump : problem.parts.compressors) MakePowerFall(random, pump.curve);
  return problem;
}

struct Tally {
  int compared = 0, falling = 0, held_open = 0;
  double loosest = 0.0;
};

void CheckBox(const Problem& problem, const Candidate& candidate, const SettingsBox& box,
              Random& random, Tally& tally) {
  const optimizer::PumpTrend trend = MakePumpTrend(problem, candidate);
  const Strokes fastest = FastestStrokes(problem, candidate, box);
  if (!fastest.works) return;
  const LeastEvaluation bounds = LeastOver(problem, candidate, trend, box, fastest);
  ASSERT_FALSE(bounds.least.failed);
  for (int i = 0; i < 6; ++i) {
    // Corners first.
    const double volume_m3 = i < 4 ? (i % 2 == 0 ? box.low_m3 : box.high_m3)
                                   : LogUniform(random, box.low_m3, box.high_m3);
    const double source_pa =
        i < 4 ? (i / 2 == 0 ? box.low_pa : box.high_pa) : Uniform(random, box.low_pa, box.high_pa);
    const Evaluation inside = Evaluate(problem, candidate, {source_pa, volume_m3, volume_m3});
    if (!inside.works || inside.compressor_duty > 1.0) continue;
    for (std::size_t g = 0; g < inside.groups.size(); ++g) {
      EXPECT_LE(fastest.rise_s[g], inside.groups[g].rise_time_s * (1.0 + kAccuracy));
      EXPECT_LE(fastest.inflate_s[g], inside.groups[g].inflate_time_s * (1.0 + kAccuracy));
    }
    EXPECT_LE(bounds.least.energy_total_j, inside.energy_total_j * (1.0 + kAccuracy));
    EXPECT_LE(bounds.least.energy_per_cycle_j, inside.energy_per_cycle_j * (1.0 + kAccuracy));
    EXPECT_LE(bounds.least.compressor_duty, inside.compressor_duty * (1.0 + kAccuracy));
    EXPECT_LE(bounds.least.battery_current_a, inside.battery_current_a * (1.0 + kAccuracy));
    ++tally.compared;
    tally.falling += !trend.rises;
    tally.held_open += !candidate.lines[0]->holds;
    tally.loosest =
        std::max(tally.loosest, 1.0 - bounds.least.energy_total_j / inside.energy_total_j);
  }
}

// `width`: relative, of volumes and pressures.
Tally CheckBoxes(int groups, bool simultaneous, double width, int boxes) {
  Tally tally;
  for (int seed = 1; seed <= boxes; ++seed) {
    const Problem problem = Drawn(static_cast<std::uint64_t>(seed), groups, simultaneous);
    Random random(static_cast<std::uint64_t>(seed));
    int here = 0;
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.reservoir.index != optimizer::kCustom || here > 0 || !Chance(random, 0.2))
        return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      SettingsBox box;
      box.low_m3 = LogUniform(random, 50e-6, 3e-3);
      box.high_m3 = box.low_m3 * (1.0 + width * Uniform(random, 0.0, 1.0));
      box.low_pa = Uniform(random, window.low_pa, window.high_pa);
      box.high_pa =
          std::min(window.high_pa, box.low_pa * (1.0 + width * Uniform(random, 0.0, 0.5)));
      SCOPED_TRACE("seed " + std::to_string(seed) + " groups " + std::to_string(groups));
      ++here;
      CheckBox(problem, candidate, box, random, tally);
    });
  }
  std::printf("%d compared, %d with falling energy per air, %d held open; loosest by %.2g\n",
              tally.compared, tally.falling, tally.held_open, tally.loosest);
  return tally;
}

TEST(SettingsBoundsTest, NothingInTheBoxIsBetter) {
  for (double width : {0.5, 0.03}) {
    const Tally tally = CheckBoxes(1, true, width, 3 * kBoxes);
    EXPECT_GT(tally.compared, 3 * kBoxes);
    EXPECT_GT(tally.falling, kBoxes / 8);
    EXPECT_GT(tally.held_open, kBoxes / 8);
  }
}

TEST(SettingsBoundsTest, NothingInTheBoxIsBetterForSeveralGroups) {
  EXPECT_GT(CheckBoxes(2, false, 0.3, kBoxes).compared, kBoxes / 3);
  EXPECT_GT(CheckBoxes(2, true, 0.3, kBoxes).compared, kBoxes / 3);
  EXPECT_GT(CheckBoxes(3, false, 0.1, kBoxes / 2).compared, kBoxes / 8);
}

// The bounds close in on the evaluation as the box does.
TEST(SettingsBoundsTest, BoundsTighten) {
  EXPECT_LT(CheckBoxes(1, true, 1e-4, kBoxes).loosest, 1e-3);
  EXPECT_LT(CheckBoxes(1, true, 1e-6, kBoxes).loosest, 1e-5);
}

TEST(RaisePressureTest, KeepsEveryPressureThatDrives) {
  int raised = 0, checked = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Problem problem = Drawn(seed, 1, true, 0.025 * static_cast<double>(seed));
    Random random(seed);
    ForEachCombination(problem, [&](const Candidate& candidate) {
      if (candidate.reservoir.index != optimizer::kCustom || !Chance(random, 0.5)) return;
      const optimizer::Window window = optimizer::SourceWindow(problem, candidate);
      if (window.empty()) return;
      SettingsBox box{1e-4, 1.2e-4, window.low_pa, window.high_pa};
      const optimizer::LeafStatus status = RaisePressure(problem, candidate, box, 1e-4);
      raised += box.low_pa > window.low_pa;
      for (double volume_m3 : {1e-4, 1.1e-4, 1.2e-4})
        for (int i = 0; i <= 20; ++i) {
          const double pa = window.low_pa + (window.high_pa - window.low_pa) * i / 20.0;
          if (status != optimizer::LeafStatus::kInfeasible && pa >= box.low_pa) continue;
          const Evaluation below = Evaluate(problem, candidate, {pa, volume_m3, volume_m3});
          EXPECT_GT(optimizer::StrokeExcess(problem, below), 0.0) << "seed " << seed;
          ++checked;
        }
    });
  }
  EXPECT_GT(raised, 5);
  EXPECT_GT(checked, 50);
}

}  // namespace settings_bounds_test
}  // namespace plenum::test
