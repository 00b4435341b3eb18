#include "model/physics/monotone_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <random>
#include <vector>

namespace plenum::model {
namespace monotone_curve_test {

TEST(MonotoneCurve, OnePointIsConstantTwoAreALine) {
  const MonotoneCurve constant({2.0}, {5.0});
  EXPECT_EQ(constant(-1.0), 5.0);
  EXPECT_EQ(constant.Slope(3.0), 0.0);
  const MonotoneCurve line({1.0, 3.0}, {2.0, 8.0});
  for (const double x : {0.0, 1.0, 1.7, 3.0, 5.0}) {
    EXPECT_NEAR(line(x), 3.0 * x - 1.0, 1e-14);
    EXPECT_NEAR(line.Slope(x), 3.0, 1e-14);
  }
}

TEST(MonotoneCurve, MatchesPublishedPchipValues) {
  // y = x² at 0, 1, 3, 4 by hand. Secants 1, 4, 7; inner slopes by the weighted harmonic mean:
  // at 1: (5+4)/(5/1+4/4) = 1.5, at 3: 9/(4/4+5/7) = 5.25; end slope (4·1−1·4)/3 = 0 at 0,
  // (4·7−4)/3 = 8 at 4.
  const MonotoneCurve curve({0.0, 1.0, 3.0, 4.0}, {0.0, 1.0, 9.0, 16.0});
  EXPECT_NEAR(curve.Slope(0.0), 0.0, 1e-14);
  EXPECT_NEAR(curve.Slope(1.0), 1.5, 1e-14);
  EXPECT_NEAR(curve.Slope(3.0), 5.25, 1e-13);
  EXPECT_NEAR(curve.Slope(4.0), 8.0, 1e-14);
  // Hermite midpoint: (y0+y1)/2 + h·(s0−s1)/8.
  EXPECT_NEAR(curve(2.0), 5.0 + 2.0 * (1.5 - 5.25) / 8.0, 1e-14);
  EXPECT_NEAR(curve(5.0), 24.0, 1e-13);
  EXPECT_NEAR(curve(-1.0), 0.0, 1e-14);
}

TEST(MonotoneCurve, NotANumberStaysOne) {
  const MonotoneCurve curve({0.0, 1.0, 3.0, 4.0}, {0.0, 1.0, 9.0, 16.0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(curve(nan)));
  EXPECT_GE(curve.Slope(nan), 0.0);  // of some piece, and read from none beyond the last
  EXPECT_EQ(curve.Curvature(nan), 0.0);
}

TEST(MonotoneCurve, StaysMonotoneAndWithinTheData) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<double> x{0.0}, y{0.0};
    for (int i = 0; i < 7; ++i) {
      x.push_back(x.back() + 0.01 + unit(random));
      y.push_back(y.back() + (unit(random) < 0.3 ? 0.0 : std::pow(unit(random), 4.0)));
    }
    const MonotoneCurve curve(x, y);
    double previous = 0.0;
    for (int i = 0; i <= 500; ++i) {
      const double value = curve(x.back() * i / 500.0);
      EXPECT_GE(value, previous - 1e-15);
      EXPECT_LE(value, y.back() + 1e-15);
      previous = value;
    }
  }
}

TEST(MonotoneCurve, SlopeAgreesWithFiniteDifferences) {
  const MonotoneCurve curve({0.0, 0.5, 2.0, 2.2}, {1.0, 1.1, 3.0, 3.05});
  for (const double x : {-0.3, 0.2, 0.49, 0.7, 1.9, 2.1, 3.0}) {
    const double h = 1e-6;
    EXPECT_NEAR(curve.Slope(x), (curve(x + h) - curve(x - h)) / (2.0 * h), 1e-8);
  }
}

}  // namespace monotone_curve_test
}  // namespace plenum::model
