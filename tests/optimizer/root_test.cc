#include "optimizer/root.h"

#include <gtest/gtest.h>

#include <limits>

namespace plenum::optimizer {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Finds the root, returns a point where the excess is not positive, and counts the calls.
template <typename Excess>
void ExpectRoot(Excess&& excess, double low, double high, double root, int calls_max) {
  int calls = 0;
  const double x = SmallestFeasible(
      [&](double at) {
        ++calls;
        return excess(at);
      },
      low, high);
  EXPECT_LE(excess(x), 0.0);
  EXPECT_GE(x, root * (1.0 - 1e-15));
  EXPECT_LE(x - root, 1.1e-9 * high);
  EXPECT_LE(calls, calls_max);
}

TEST(SmallestFeasibleTest, SmoothFunctionsTakeFewCalls) {
  ExpectRoot([](double x) { return 1.0 / x - 0.25; }, 1.0, 10.0, 4.0, 20);
  ExpectRoot([](double x) { return 3.0 - x; }, 1.0, 10.0, 3.0, 12);
  ExpectRoot([](double x) { return std::exp(-x) - 1e-3; }, 0.5, 50.0, std::log(1e3), 40);
}

TEST(SmallestFeasibleTest, StepsAndInfinitiesAreBisected) {
  ExpectRoot([](double x) { return x < 2.7 ? 1.0 : -1.0; }, 1.0, 8.0, 2.7, 80);
  ExpectRoot([](double x) { return x < 2.7 ? kInfinity : -1.0; }, 1.0, 8.0, 2.7, 80);
  ExpectRoot([](double x) { return x < 2.0 ? kInfinity : 1.0 / (x - 1.99) - 10.0; }, 1.0, 8.0, 2.09,
             60);
  ExpectRoot([](double x) { return x < 2.0 ? kInfinity : -kInfinity; }, 1.0, 8.0, 2.0, 80);
}

TEST(SmallestFeasibleTest, FlatPartsAreCrossed) {
  ExpectRoot([](double x) { return x < 3.0 ? 1.0 : 4.0 - x; }, 1.0, 10.0, 4.0, 80);
  // Zero from the root on: only every fourth step, the halving, makes way.
  ExpectRoot([](double x) { return std::max(0.0, 5.0 - x); }, 1.0, 10.0, 5.0, 4 * 31);
}

TEST(SmallestFeasibleTest, LowEndThatIsFeasibleComesBackAtOnce) {
  int calls = 0;
  EXPECT_EQ(SmallestFeasible(
                [&](double) {
                  ++calls;
                  return -1.0;
                },
                2.0, 5.0),
            2.0);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace plenum::optimizer
