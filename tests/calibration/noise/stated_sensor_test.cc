// Range and resolution of a sensor as its data sheet states them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibration/diagnose.h"
#include "calibration/noise/noise.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace stated_sensor_test {

using test::MeasuredBench;

Readings Held(const std::vector<double>& t_s, const std::vector<double>& y, const Sensor& sensor) {
  return {t_s, y, {{t_s.front(), t_s.back()}}, {}, sensor};
}

std::vector<double> Drifting(const std::vector<double>& t_s, double sigma_pa) {
  std::vector<double> y = test::WhiteNoise(7, t_s.size(), sigma_pa);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += 2e5 - 500.0 * t_s[i];
  return y;
}

TEST(StatedSensor, NoiseIsAtLeastThatOfItsResolution) {
  const std::vector<double> t_s = test::EvenTimes(300, 0.01);
  const std::vector<double> y = Drifting(t_s, 10.0);
  EXPECT_NEAR(EstimateNoise(Held(t_s, y, {})).sigma_pa, 10.0, 1.5);
  const Noise noise = EstimateNoise(Held(t_s, y, {.resolution_pa = 600.0}));
  EXPECT_DOUBLE_EQ(noise.sigma_pa, 600.0 / std::sqrt(12.0));
}

// Three readings that saturate tell nobody but the data sheet.
TEST(StatedSensor, ReadingsAtAnEndAreCutOffHoweverFew) {
  const std::vector<double> t_s = test::EvenTimes(100, 0.01);
  std::vector<double> y = Drifting(t_s, 100.0);
  const double end_pa = 2e5;
  for (double& pa : y) pa = std::min(pa, end_pa);
  const auto at_end = std::count(y.begin(), y.end(), end_pa);
  ASSERT_GE(at_end, 2);
  const Noise noise = EstimateNoise(Held(t_s, y, {.low_pa = 1e5, .high_pa = end_pa}));
  EXPECT_EQ(static_cast<long>(noise.clipped.size()), at_end);
  EXPECT_EQ(noise.clip_high_pa, end_pa);
  EXPECT_GE(noise.near_end.size(), noise.clipped.size());
}

// A pressure that stays at its lowest for a long time is one, where the sensor reads further.
TEST(StatedSensor, NothingIsGuessedWithinItsRange) {
  const std::vector<double> t_s = test::EvenTimes(200, 0.01);
  std::vector<double> y = Drifting(t_s, 100.0);
  for (std::size_t i = 60; i < 120; ++i) y[i] = 1e5;
  EXPECT_FALSE(EstimateNoise(Held(t_s, y, {})).clipped.empty());
  EXPECT_TRUE(EstimateNoise(Held(t_s, y, {.low_pa = 0.0, .high_pa = 1e6})).clipped.empty());
}

// A range that is stated as of 0 gauge, while readings scatter about 0, has no end there.
TEST(StatedSensor, AnEndThatReadingsPassIsNone) {
  const std::vector<double> t_s = test::EvenTimes(200, 0.01);
  std::vector<double> y = test::WhiteNoise(9, t_s.size(), 100.0);
  for (double& pa : y) pa += 1e5;
  const Noise noise = EstimateNoise(Held(t_s, y, {.low_pa = 1e5, .high_pa = 1e6}));
  EXPECT_TRUE(noise.clipped.empty());
  EXPECT_TRUE(std::isinf(noise.clip_low_pa));
}

// The chamber goes above what the gauge shows, in a few readings of each run.
TEST(StatedSensor, AModelIsFittedToWhatTheGaugeShows) {
  Dataset dataset = MeasuredBench({}, 51);
  for (auto& run : dataset.runs) {
    const double most_pa = *std::max_element(run.pressure_pa.begin(), run.pressure_pa.end());
    run.sensor = {.low_pa = 0.5e5, .high_pa = most_pa - 4e3};
    for (double& pa : run.pressure_pa) pa = std::min(pa, run.sensor.high_pa);
  }
  const Diagnosis d = Diagnose(dataset, {});
  EXPECT_EQ(d.verdict, Verdict::kAdequate) << d.sentence;
  for (const Estimate& factor : {d.fitted.front().factor, d.fitted.back().factor})
    EXPECT_NEAR(factor.value, 1.0, 0.02);
}

}  // namespace stated_sensor_test
}  // namespace plenum::calibration
