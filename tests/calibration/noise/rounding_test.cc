#include "calibration/noise/rounding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plenum::calibration {
namespace rounding_test {

// Mean of readings on the grid …, −q, 0, q, … of m plus normal noise, by summing all chances.
double MeanReading(double m, double quantum, double noise) {
  double mean = 0.0;
  for (int k = -40; k <= 40; ++k) {
    const double low = ((k - 0.5) * quantum - m) / noise, high = ((k + 0.5) * quantum - m) / noise;
    mean += k * quantum * 0.5 * (std::erf(high / std::sqrt(2.0)) - std::erf(low / std::sqrt(2.0)));
  }
  return mean;
}

TEST(Grid, ShiftsTheModelToTheMeanReading) {
  const double quantum = 0.4, reading = 1.2;  // on the grid
  for (const double noise : {0.05, 0.1, 0.18, 0.4}) {
    const Grid grid(quantum, noise);
    for (double m = 0.9; m < 1.5; m += 0.037) {
      const double expected = MeanReading(m, quantum, noise);
      EXPECT_NEAR(m + grid.At(reading - m).mean, expected, 1e-4 * quantum) << noise << ' ' << m;
      const double slope =
          (MeanReading(m + 1e-4, quantum, noise) - MeanReading(m - 1e-4, quantum, noise)) / 2e-4;
      EXPECT_NEAR(grid.At(reading - m).slope, slope, 4e-3) << noise << ' ' << m;
    }
  }
}

TEST(Grid, NoneShiftsNothing) {
  EXPECT_EQ(Grid().At(0.3).mean, 0.0);
  EXPECT_EQ(Grid().At(0.3).slope, 1.0);
}

TEST(Grid, TheNoiseBehindItIsFound) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal(0.0, 0.22);
  std::vector<double> readings, model;
  for (int i = 0; i < 4000; ++i) {
    model.push_back(2e-3 * i);
    readings.push_back(std::round(model.back() + normal(random)));
  }
  EXPECT_NEAR(LikeliestNoise(readings, model, 1.0), 0.22, 0.015);
}

}  // namespace rounding_test
}  // namespace plenum::calibration
