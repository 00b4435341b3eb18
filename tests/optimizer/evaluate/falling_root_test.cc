#include "optimizer/evaluate/strokes/falling_root.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plenum::optimizer {
namespace falling_root_test {

// Counts the calls.
template <typename Function>
double Root(Function&& function, double low, double high, double guess, int& calls) {
  return FallingRoot(
      [&](double x) -> ValueAndSlope {
        ++calls;
        return function(x);
      },
      low, high, guess);
}

TEST(FallingRootTest, FewStepsFromANearGuess) {
  int calls = 0;
  const double root = Root(
      [](double x) -> ValueAndSlope {
        return {2.0 - x * x, -2.0 * x};
      },
      1.0, 3.0, 1.4, calls);
  EXPECT_NEAR(root, std::sqrt(2.0), 1e-15);
  EXPECT_LE(calls, 5);
}

TEST(FallingRootTest, AGuessOutsideIsNoHarm) {
  for (const double guess : {0.0, 1.0, 3.0, 17.0, 2.999}) {
    int calls = 0;
    const auto cube = [](double x) -> ValueAndSlope { return {8.0 - x * x * x, -3.0 * x * x}; };
    EXPECT_NEAR(Root(cube, 1.0, 3.0, guess, calls), 2.0, 1e-12);
    EXPECT_LE(calls, 12);
  }
}

// Air out of a regulator, as (1 − x), into a chamber at c, as k·√(x − c): steep where it is full,
// so that the plain method would leave the interval. The root is known in closed form.
TEST(FallingRootTest, SteepWhereAChamberIsFull) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const double c = 0.3 + 0.7 * share(random), k = std::pow(10.0, 8.0 * share(random) - 4.0);
    const auto left = [&](double x) -> ValueAndSlope {
      const double root = std::sqrt(x - c);
      return {1.0 - x - k * root, -1.0 - 0.5 * k / root};
    };
    int calls = 0;
    const double found = Root(left, c, 1.0, c + (1.0 - c) * share(random), calls);
    const double y = 2.0 * (1.0 - c) / (k + std::sqrt(k * k + 4.0 * (1.0 - c)));  // √(x − c)
    EXPECT_NEAR(found, c + y * y, 2e-13);
    EXPECT_LE(calls, 60);
  }
}

TEST(FallingRootTest, EndsWithARootBelowZeroToo) {
  for (const double guess : {-2.0, -0.1, 0.3, 1.0}) {
    int calls = 0;
    const auto line = [](double x) -> ValueAndSlope { return {-0.75 - x, -1.0}; };
    EXPECT_NEAR(Root(line, -4.0, 1.0, guess, calls), -0.75, 1e-13);
    EXPECT_LE(calls, 4);
    const auto steep = [](double x) -> ValueAndSlope {
      return {-std::cbrt(x + 0.75), -1.0 / (3.0 * std::pow(std::abs(x + 0.75), 2.0 / 3.0))};
    };
    EXPECT_NEAR(Root(steep, -4.0, 1.0, guess, calls), -0.75, 2e-13);
    EXPECT_LE(calls, 80);
  }
}

TEST(FallingRootTest, EndsOnNoNumbers) {
  int calls = 0;
  const auto none = [](double) -> ValueAndSlope { return {std::nan(""), std::nan("")}; };
  Root(none, 1.0, 3.0, 2.0, calls);
  Root(none, 1.0, 3.0, std::nan(""), calls);
  EXPECT_LE(calls, 150);
}

TEST(FallingRootTest, AStepEndsWhereItJumps) {
  int calls = 0;
  const auto step = [](double x) -> ValueAndSlope { return {x < 2.5 ? 1.0 : -1.0, 0.0}; };
  EXPECT_NEAR(Root(step, 1.0, 3.0, 1.2, calls), 2.5, 1e-12);
  EXPECT_LE(calls, 60);
}

}  // namespace falling_root_test
}  // namespace plenum::optimizer
