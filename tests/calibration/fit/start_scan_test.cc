#include "calibration/fit/start_scan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace start_scan_test {

constexpr double kLengthM = 0.33, kBoreM = 3.3e-3, kNoisePa = 30.0;

struct Ringing {
  Ringing()
      : dataset(test::MeasuredBench(
            [](test::EffectRig& rig) {
              rig.line = {kBoreM, kLengthM};
            },
            5, kNoisePa)),
        forward(dataset),
        observed(Observe(dataset)) {
    data.forward = &forward;
    data.observed = &observed;
    data.runs = {0, 1, 2};
    data.sizes = SizesOf(dataset);
    base = FitModel(data, forward.Declared(), {});
  }
  double BestChi2(const std::vector<model::Effect>& starts) const {
    std::vector<ModelState> states(starts.size(), base.state);
    for (std::size_t i = 0; i < starts.size(); ++i) states[i].effects = {starts[i]};
    return BestChi2(states);
  }
  // With a line of those numbers to start from.
  Fit FitFrom(double length_m, double bore_m) const {
    ModelState state = base.state;
    state.effects = {{model::FindEffect("line_dynamics"), {length_m, bore_m}}};
    return FitModel(data, state, {});
  }
  double BestChi2(const std::vector<ModelState>& starts) const {
    double best = INFINITY;
    for (const ModelState& start : starts) {
      const Fit fit = FitModel(data, start, {});
      if (fit.Usable()) best = std::min(best, fit.chi2_data / static_cast<double>(fit.rows));
    }
    return best;
  }
  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  FitData data;
  Fit base;
};

TEST(StartScan, TheLengthThatRingsInStepIsFound) {
  const Ringing bench;
  const model::EffectSpec& line = *model::FindEffect("line_dynamics");
  const std::vector<model::Effect> starts = ScannedStarts(bench.data, bench.base, line, {});
  EXPECT_EQ(starts.size(), 3u);
  EXPECT_NEAR(bench.BestChi2(starts), 1.0, 0.15);
  EXPECT_GT(bench.BestChi2(EffectStarts(line, bench.data.sizes)), 1.3);
}

TEST(StartScan, AFitOutOfStepIsFoundAgainInStep) {
  const Ringing bench;
  const Fit off = bench.FitFrom(1.6 * kLengthM, 1.1 * kBoreM);
  ASSERT_TRUE(off.Usable());
  ASSERT_GT(off.chi2_data / static_cast<double>(off.rows), 1.2);
  EXPECT_NEAR(bench.BestChi2(ScannedAgain(bench.data, off, {})), 1.0, 0.15);
  EXPECT_TRUE(ScannedAgain(bench.data, bench.base, {}).empty());
}

// A fit of a length far off has the right volume all the same.
TEST(StartScan, AFitFarOffIsFoundAgainByItsVolume) {
  const Ringing bench;
  const Fit off = bench.FitFrom(kLengthM / 4.0, 2.0 * kBoreM);
  ASSERT_TRUE(off.Usable());
  ASSERT_LT(off.state.effects[0].parameters[0], kLengthM / 3.0);
  ASSERT_GT(off.chi2_data / static_cast<double>(off.rows), 1.2);
  EXPECT_NEAR(bench.BestChi2(ScannedAgain(bench.data, off, {})), 1.0, 0.15);
}

// A line of 0.05 m rings eighteen times between two of the bench's samples.
TEST(StartScan, LinesShorterThanSamplesShowAreNotTried) {
  const Ringing bench;
  const model::EffectSpec& line = *model::FindEffect("line_dynamics");
  const Coordinate length = EffectCoordinates(line, 0, bench.data.sizes).front();
  const double period_s = 2.0 * std::numbers::pi * length.Number(length.low) / 290.0;
  EXPECT_LT(period_s, bench.data.sizes.interval_s);
  const Fit shortest = bench.FitFrom(length.Number(length.low), kBoreM);
  ASSERT_TRUE(shortest.Usable());
  for (const ModelState& start : ScannedAgain(bench.data, shortest, {}))
    EXPECT_GE(start.effects.front().parameters.front(), 0.999 * length.Number(length.low));
}

TEST(StartScan, WhatDoesNotRingStartsAsUsual) {
  const Ringing bench;
  const model::EffectSpec& delay = *model::FindEffect("valve_delay");
  EXPECT_EQ(ScannedStarts(bench.data, bench.base, delay, {}),
            EffectStarts(delay, bench.data.sizes));
}

}  // namespace start_scan_test
}  // namespace plenum::calibration
