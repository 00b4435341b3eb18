#include "optimizer/evaluate/root.h"

#include <gtest/gtest.h>

#include <limits>

namespace plenum::optimizer {
namespace root_test {

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
  ExpectRoot([](double x) { return 1.0 / x - 0.25; }, 1.0, 10.0, 4.0, 12);
  ExpectRoot([](double x) { return 3.0 - x; }, 1.0, 10.0, 3.0, 12);
  ExpectRoot([](double x) { return std::exp(-x) - 1e-3; }, 0.5, 50.0, std::log(1e3), 20);
}

TEST(SmallestFeasibleTest, StepsAndInfinitiesAreBisected) {
  ExpectRoot([](double x) { return x < 2.7 ? 1.0 : -1.0; }, 1.0, 8.0, 2.7, 80);
  ExpectRoot([](double x) { return x < 2.7 ? kInfinity : -1.0; }, 1.0, 8.0, 2.7, 80);
  ExpectRoot([](double x) { return x < 2.0 ? kInfinity : 1.0 / (x - 1.99) - 10.0; }, 1.0, 8.0, 2.09,
             16);
  ExpectRoot([](double x) { return x < 2.0 ? kInfinity : -kInfinity; }, 1.0, 8.0, 2.0, 80);
}

TEST(SmallestFeasibleTest, FlatPartsAreCrossed) {
  ExpectRoot([](double x) { return x < 3.0 ? 1.0 : 4.0 - x; }, 1.0, 10.0, 4.0, 80);
  // Zero from the root on: only every third step, the halving, makes way.
  ExpectRoot([](double x) { return std::max(0.0, 5.0 - x); }, 1.0, 10.0, 5.0, 3 * 31 + 2);
}

TEST(RaisedFloorTest, NearRootsTakeFewCalls) {
  for (double root : {1.7, 2.0, 2.5, 3.0, 7.0}) {
    int calls = 0;
    const auto excess = [&](double x) {
      ++calls;
      return 1.0 / x - 1.0 / root;
    };
    const std::optional<double> floor = RaisedFloor(excess, 1.5, 100.0, 1e-3);
    ASSERT_TRUE(floor.has_value());
    EXPECT_GT(1.0 / *floor, 1.0 / root);
    EXPECT_LE(root - *floor, 1e-3 * 100.0);
    EXPECT_LE(calls, 8) << root;
  }
  EXPECT_FALSE(RaisedFloor([](double) { return 1.0; }, 1.5, 100.0, 1e-3).has_value());
  EXPECT_EQ(RaisedFloor([](double x) { return 1.55 - x; }, 1.5, 100.0, 1e-3), 1.5);
}

TEST(RaisedFloorTest, EndsWhereAFloorThatIsReachedIsTooMuch) {
  int calls = 0;
  const auto excess = [&](double x) {
    ++calls;
    return 7.0 - x;
  };
  const auto floor = [&](double most) {
    return RaisedFloor(excess, 1.5, 100.0, 1e-3, [&](double x) { return x <= most; });
  };
  EXPECT_EQ(floor(1.5), std::nullopt);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(floor(10.0), RaisedFloor(excess, 1.5, 100.0, 1e-3));
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

}  // namespace root_test
}  // namespace plenum::optimizer
