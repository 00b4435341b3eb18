#include "calibration/noise/rounded_memory.h"

#include <gtest/gtest.h>

#include <cmath>

#include "calibration/noise/rounding.h"
#include "calibration/noise/whiteness.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace rounded_memory_test {

constexpr double kQuantum = 1.0, kNoise = 0.27, kTheta = 3.6, kShare = 0.45;

// A stroke up, a hold and a stroke down, on the grid, with noise of which a part remembers.
struct Recorded {
  explicit Recorded(std::uint64_t seed, double off = 0.0) : t_s(test::EvenTimes(6000, 1.0)) {
    const std::vector<double> slow = test::CorrelatedNoise(seed, t_s, kTheta);
    const std::vector<double> fast = test::WhiteNoise(seed + 1000, t_s.size(), 1.0);
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      const double t = t_s[i];
      model.push_back(t < 2000 ? 0.01 * t : t < 4000 ? 20.2 : 20.2 - 0.01 * (t - 4000));
      const double noise = std::sqrt(kShare) * slow[i] + std::sqrt(1.0 - kShare) * fast[i];
      const double wave = off * std::sin(2.0 * M_PI * t / 500.0);
      readings.push_back(test::RoundTo(model[i] + kNoise * noise + wave, kQuantum));
    }
  }
  RoundedSeries Series() const {
    return {t_s, readings, model, kQuantum, LikeliestNoise(readings, model, kQuantum)};
  }
  Portmanteau Test() const {
    const RoundedSeries series = Series();
    const std::vector<double> e = InnovationsOf(series, LikeliestRoundedMemory({&series, 1}, 1.0));
    return TestWhiteness({&e, 1});
  }
  std::vector<double> t_s, model, readings;
};

TEST(RoundedMemory, IsFoundBehindTheGrid) {
  const Recorded recorded(1);
  const RoundedSeries series = recorded.Series();
  const NoiseMemory memory = LikeliestRoundedMemory({&series, 1}, 1.0);
  EXPECT_NEAR(memory.theta_s, kTheta, 1.2);
  EXPECT_NEAR(memory.share, kShare, 0.12);
}

TEST(RoundedMemory, InnovationsAreWhiteWhereStandardisedReadingsAreNot) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Recorded recorded(seed);
    const std::vector<double> alone =
        StandardiseRounded(recorded.readings, recorded.model, kQuantum).e;
    const Portmanteau before = TestWhiteness({&alone, 1}), after = recorded.Test();
    EXPECT_GT(before.statistic, before.limit) << seed;
    EXPECT_LT(after.statistic, after.limit) << seed;
  }
}

TEST(RoundedMemory, DoesNotTakeUpWhatAModelMisses) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Portmanteau test = Recorded(seed, 0.5 * kNoise).Test();
    EXPECT_GT(test.statistic, test.limit) << seed;
  }
}

// Without memory an innovation is the standardised reading.
TEST(RoundedMemory, OfWhiteNoiseIsNone) {
  const Recorded recorded(1);
  const std::vector<double> alone = InnovationsOf(recorded.Series(), {0.0, 1.0});
  const RoundedResidual expected = StandardiseRounded(recorded.readings, recorded.model, kQuantum);
  for (std::size_t i = 0; i < alone.size(); ++i)
    if (std::isfinite(expected.e[i])) {
      EXPECT_NEAR(alone[i], expected.e[i], 1e-9) << i;
    }
}

}  // namespace rounded_memory_test
}  // namespace plenum::calibration
