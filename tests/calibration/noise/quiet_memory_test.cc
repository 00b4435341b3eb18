#include "calibration/noise/quiet_memory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calibration/noise/noise.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace quiet_memory_test {

using test::AtMostRate;
using test::CorrelatedNoise;
using test::EvenTimes;
using test::RandomTimes;
using test::WhiteNoise;

constexpr double kSpacingS = 0.01;
#ifdef PLENUM_SANITIZED
constexpr int kSeeds = 6;
#else
constexpr int kSeeds = 24;
#endif

// Half of the variance white, half remembering for θ; unit variance.
std::vector<double> Mixed(int seed, const std::vector<double>& t_s, double theta_s) {
  std::vector<double> slow = CorrelatedNoise(2 * seed, t_s, theta_s);
  const std::vector<double> white = WhiteNoise(2 * seed + 1, t_s.size());
  for (std::size_t i = 0; i < slow.size(); ++i) slow[i] = std::sqrt(0.5) * (slow[i] + white[i]);
  return slow;
}

// Three runs that close at 2 s and hold for 10 s: what the switch leaves behind decays as `bend`.
template <class Bend>
std::vector<Noise> Held(int seed, bool even, double theta_s, const Bend& bend) {
  static std::vector<std::vector<double>> t_s, y;
  t_s.clear(), y.clear();
  std::vector<Readings> all;
  for (int run = 0; run < 3; ++run) {
    t_s.push_back(even ? EvenTimes(1200, kSpacingS) : RandomTimes(seed + run, 1200, kSpacingS));
    y.push_back(Mixed(3 * seed + run, t_s.back(), theta_s));
    for (std::size_t i = 0; i < y.back().size(); ++i) y.back()[i] += 500.0 + bend(t_s.back()[i]);
  }
  for (int run = 0; run < 3; ++run) {
    const auto at = static_cast<std::size_t>(run);
    all.push_back({t_s[at], y[at], {{2.0, t_s[at].back()}}, {{0.0, 2.0}}});
  }
  return EstimateNoise(all);
}

double Settling(double t_s) { return t_s < 2.0 ? 40.0 * t_s : 80.0 + 30.0 * std::exp(2.0 - t_s); }

TEST(QuietMemory, NoiseThatIsHalfSlowIsReadAtItsFullSize) {
  for (const bool even : {true, false})
    for (const double spacings : {3.0, 10.0, 25.0}) {
      double ratio = 0.0, off = 0.0, error = 0.0;
      for (int seed = 0; seed < kSeeds; ++seed) {
        const Noise noise = Held(seed, even, spacings * kSpacingS, Settling).front();
        ratio += noise.sigma_pa / kSeeds;
        off += std::pow(std::log(noise.sigma_pa), 2) / kSeeds;
        error += std::pow(noise.relative_error, 2) / kSeeds;
        EXPECT_FALSE(noise.memories.empty());
      }
      EXPECT_NEAR(ratio, 1.0, 0.08) << spacings << ' ' << even;  // third differences: 0.75
      EXPECT_LT(std::sqrt(off), 2.0 * std::sqrt(error)) << spacings << ' ' << even;
    }
}

// Cooling, creep and a late end of the stroke bend the first part of a hold.
TEST(QuietMemory, WhatASwitchLeavesBehindIsNoMemory) {
  for (const double time_constant_s : {0.05, 0.2, 0.5, 1.0, 3.0}) {
    int found = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
      const auto bend = [&](double t_s) {
        const double since_s = t_s - 2.05;
        return since_s < 0.0 ? 100.0 * t_s : 205.0 + 30.0 * std::exp(-since_s / time_constant_s);
      };
      const Noise noise = Held(seed, true, 1e-9, bend).front();
      found += noise.memory.theta_s > 0.0;
      EXPECT_LT(std::abs(noise.sigma_pa - 1.0), noise.memory.theta_s == 0.0 ? 0.2 : 0.5);
    }
    EXPECT_TRUE(AtMostRate(found, kSeeds, 0.05)) << time_constant_s << ": " << found;
  }
}

TEST(QuietMemory, AStrokeTellsNothingOfMemory) {
  const std::vector<double> t_s = EvenTimes(150, kSpacingS);
  for (int seed = 0; seed < kSeeds; ++seed) {
    std::vector<double> y = WhiteNoise(seed, t_s.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += 500.0 * (1.0 - std::exp(-2.0 * t_s[i]));
    const Noise noise = EstimateNoise({t_s, y, {}, {{0.0, t_s.back()}}});
    EXPECT_EQ(noise.memory.theta_s, 0.0);
    EXPECT_NEAR(noise.sigma_pa, 1.0, 0.35);
  }
}

TEST(QuietMemory, WithoutQuietReadingsAShortMemoryIsAllowed) {
  const QuietMemory none = MemoryOfQuiet({}, kSpacingS);
  EXPECT_EQ(none.memory.theta_s, 0.0);
  ASSERT_FALSE(none.allowed.empty());
  for (const NoiseMemory& memory : none.allowed) EXPECT_LT(memory.theta_s, 5.0 * kSpacingS);
}

}  // namespace quiet_memory_test
}  // namespace plenum::calibration
