// The stairs of a front against each of their gaps looked at by itself.
#include "optimizer/front/stairs.h"

#include <gtest/gtest.h>

#include <random>

namespace plenum::test {
namespace stairs_test {

using optimizer::kUnlimited;
using optimizer::Pair;
using optimizer::Stairs;

bool Beats(const Pair& a, const Pair& b) { return a[0] <= b[0] && a[1] <= b[1]; }

// Whether some design with these least amounts and this least sum could be new: each of a grid of
// designs is asked.
bool SomeDesignIsNew(const std::vector<Pair>& all, const Pair& low, const Pair& limits,
                     const Pair& weights, double sum) {
  for (double x = 0.5; x < 21.0; ++x)
    for (double y = 0.5; y < 21.0; ++y) {
      const Pair design{x, y};
      if (!Beats(low, design) || !Beats(design, limits)) continue;
      if (weights[0] * x + weights[1] * y < sum) continue;
      bool beaten = false;
      for (const Pair& point : all) beaten = beaten || Beats(point, design);
      if (!beaten) return true;
    }
  return false;
}

TEST(StairsTest, PointsThatOthersBeatGo) {
  Stairs stairs({3.0, 5.0});
  stairs.Add({6.0, 2.0});
  stairs.Add({4.0, 4.0});
  stairs.Add({4.0, 1.0});
  EXPECT_EQ(stairs.points(), (std::vector<Pair>{{3.0, 5.0}, {4.0, 1.0}}));
}

// Points are whole numbers and designs lie halfway between, so that none of them ties. A corner of
// a gap is one at its limits, half a unit beyond the last design below it.
TEST(StairsTest, AdmitsWhatMayHoldADesign) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> amount(1, 20);
  int admitted = 0;
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    const auto whole = [&] { return static_cast<double>(amount(random)); };
    std::vector<Pair> all{{whole(), whole()}};
    Stairs stairs(all.front());
    for (int i = 0; i < draw % 8; ++i) {
      const Pair point{whole(), whole()};
      if (std::any_of(all.begin(), all.end(), [&](const Pair& p) { return Beats(p, point); }))
        continue;
      all.push_back(point);
      stairs.Add(point);
    }
    const Pair low{whole() - 0.5, whole() - 0.5}, limits{whole(), whole()};
    const Pair weights{1.0, 0.5 * whole()};
    const double sum = whole() + weights[1] * whole();
    const bool wanted =
        SomeDesignIsNew(all, low, limits, weights, sum - 0.5 * (weights[0] + weights[1]));
    EXPECT_EQ(stairs.Admit(low, limits, weights, sum - 1e-4), wanted) << draw;
    admitted += wanted;
    bool below = true;
    for (const Pair& point : all) below = below && !Beats(point, low);
    EXPECT_EQ(stairs.Below(low), below) << draw;
  }
  EXPECT_GT(admitted, kDraws / 10);
  EXPECT_LT(admitted, kDraws * 9 / 10);
}

}  // namespace stairs_test
}  // namespace plenum::test
