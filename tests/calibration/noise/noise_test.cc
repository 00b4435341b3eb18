#include "calibration/noise/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "calibration/noise/readings.h"
#include "tests/calibration/noise/processes.h"

namespace plenum::calibration {
namespace noise_test {

using test::AtMostRate;
using test::CorrelatedNoise;
using test::EvenTimes;
using test::RandomTimes;
using test::RoundTo;
using test::WhiteNoise;

constexpr double kSigmaPa = 200.0;
#ifdef PLENUM_SANITIZED
constexpr int kSeeds = 60;
#else
constexpr int kSeeds = 400;
#endif

// A hold that creeps by 6 kPa: what the noise must be told from.
std::vector<double> Creeping(const std::vector<double>& t_s, const std::vector<double>& noise) {
  std::vector<double> y(t_s.size());
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = 2e5 - 6e3 * (1.0 - std::exp(-t_s[i] / 0.8)) + noise[i];
  return y;
}

Noise OfHold(const std::vector<double>& t_s, const std::vector<double>& y) {
  const std::vector<TimeSpan> hold = {{t_s.front(), t_s.back()}};
  return EstimateNoise({t_s, y, hold, {}});
}

struct Spread {
  double mean = 0.0, deviation = 0.0;
};

Spread SpreadOf(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (count - 1.0))};
}

TEST(Noise, WhiteNoiseOnACreepingHoldIsMeasuredAndItsStandardErrorIsAsStated) {
  const std::vector<double> t_s = EvenTimes(400, 0.01);
  std::vector<double> ratios;
  int correlated = 0, wild = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const Noise noise = OfHold(t_s, Creeping(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa)));
    if (noise.memory.theta_s > 0.0) {
      ++correlated;
      continue;
    }
    ratios.push_back(noise.sigma_pa / kSigmaPa);
    wild += !noise.outliers.empty();
    EXPECT_EQ(noise.source, NoiseSource::kClosed);
    EXPECT_NEAR(noise.relative_error, 1.07 / 20.0, 0.002);
  }
  const Spread spread = SpreadOf(ratios);
  EXPECT_NEAR(spread.mean, 1.0, 0.012);
  EXPECT_NEAR(spread.deviation, 1.07 / 20.0, 0.008);
  EXPECT_TRUE(AtMostRate(correlated, kSeeds, 0.045)) << correlated;  // two standard errors
  EXPECT_TRUE(AtMostRate(wild, kSeeds, 0.001)) << wild;
}

TEST(Noise, UnevenSamplingChangesNothing) {
  std::vector<double> ratios;
  int correlated = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const std::vector<double> t_s = RandomTimes(1000 + seed, 400, 0.01);
    const Noise noise = OfHold(t_s, Creeping(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa)));
    ratios.push_back(noise.sigma_pa / kSigmaPa);
    correlated += noise.memory.theta_s > 0.0;
  }
  EXPECT_NEAR(SpreadOf(ratios).mean, 1.0, 0.02);
  EXPECT_TRUE(AtMostRate(correlated, kSeeds, 0.045)) << correlated;
}

class CorrelatedNoiseTest : public ::testing::TestWithParam<double> {};

TEST_P(CorrelatedNoiseTest, CorrelationAndLevelAreRecovered) {
  const double rho = GetParam();
  const std::vector<double> t_s = EvenTimes(2000, 0.005);
  const double theta_s = -0.005 / std::log(rho);
  std::vector<double> lags, ratios;
  for (int seed = 0; seed < kSeeds / 4; ++seed) {
    const std::vector<double> noise = CorrelatedNoise(seed, t_s, theta_s, kSigmaPa);
    const Noise found = OfHold(t_s, Creeping(t_s, noise));
    ratios.push_back(found.sigma_pa / kSigmaPa);
    const double rho_found = std::exp(-0.005 / found.memory.theta_s);
    lags.push_back(found.memory.share * rho_found);
    const double sum = 2.0 * found.memory.share * rho_found / (1.0 - rho_found);
    EXPECT_NEAR(found.effective_samples, 2000.0 / (1.0 + sum), 1e-3);
  }
  EXPECT_NEAR(SpreadOf(lags).mean, rho, 0.04);
  EXPECT_NEAR(SpreadOf(ratios).mean, 1.0, 0.08);
}

INSTANTIATE_TEST_SUITE_P(Rho, CorrelatedNoiseTest, ::testing::Values(0.3, 0.6, 0.8));

class QuantisedTest : public ::testing::TestWithParam<double> {};

// The true error of a reading is known here: reading less signal. The level at which the signal
// settles takes every place within a quantum in turn.
TEST_P(QuantisedTest, ReportsTheErrorOfTheReadings) {
  const double quantum = 500.0, sigma = GetParam() * quantum;
  const std::vector<double> t_s = EvenTimes(3000, 0.002);
  constexpr int kLevels = kSeeds / 10;
  double found_squares = 0.0, true_squares = 0.0;
  for (int level = 0; level < kLevels; ++level) {
    const double offset = quantum * (level + 0.5) / kLevels;
    std::vector<double> y = Creeping(t_s, WhiteNoise(level, t_s.size(), sigma));
    const std::vector<double> signal = Creeping(t_s, std::vector<double>(t_s.size(), 0.0));
    for (std::size_t i = 0; i < y.size(); ++i) {
      y[i] = RoundTo(y[i] + offset, quantum);
      const double error = y[i] - signal[i] - offset;
      true_squares += error * error / static_cast<double>(y.size());
    }
    const Noise found = OfHold(t_s, y);
    EXPECT_NEAR(found.quantum_pa, quantum, 1e-6 * quantum);
    EXPECT_EQ(found.staircase, GetParam() < 0.35);
    found_squares += found.sigma_pa * found.sigma_pa;
  }
  EXPECT_NEAR(std::sqrt(found_squares / true_squares), 1.0, 0.1) << GetParam() << " quanta";
}

INSTANTIATE_TEST_SUITE_P(NoiseInQuanta, QuantisedTest,
                         ::testing::Values(0.0, 0.1, 0.25, 0.5, 1.0, 3.0));

TEST(Quantum, FindsAGridThroughRoundedDecimalsAndNoneElsewhere) {
  // Steps of 5000/4095 kPa printed with two decimals, as a 12-bit converter's log has them.
  std::vector<double> y;
  for (const double value : WhiteNoise(1, 300, 20.0))
    y.push_back(RoundTo(RoundTo(value, 5000.0 / 4095.0), 0.01));
  EXPECT_NEAR(Quantum(y), 5000.0 / 4095.0, 1e-3);
  for (double& value : y) value = 101.3e3 + 1e3 * value;  // kPa gauge to Pa absolute
  EXPECT_NEAR(Quantum(y), 5e6 / 4095.0, 1.0);
  int found = 0;
  for (int seed = 0; seed < kSeeds; ++seed) found += Quantum(WhiteNoise(seed, 20)) > 0.0;
  EXPECT_EQ(found, 0);
  EXPECT_EQ(Quantum(std::vector<double>(50, 3.0)), 0.0);
  EXPECT_EQ(Quantum(std::vector<double>{}), 0.0);
}

TEST(Noise, WildReadingsAreNamedAndDoNotRaiseTheLevel) {
  const std::vector<double> t_s = EvenTimes(600, 0.01);
  std::vector<double> ratios;
  for (int seed = 0; seed < kSeeds / 10; ++seed) {
    std::vector<double> y = Creeping(t_s, WhiteNoise(seed, t_s.size(), kSigmaPa));
    const std::vector<std::size_t> planted = {50, 120, 121 + 80, 444};
    for (const std::size_t i : planted) y[i] += (i % 2 ? -1.0 : 1.0) * 25.0 * kSigmaPa;
    const Noise noise = OfHold(t_s, y);
    EXPECT_EQ(noise.outliers, planted) << seed;
    ratios.push_back(noise.sigma_pa / kSigmaPa);
  }
  EXPECT_NEAR(SpreadOf(ratios).mean, 1.0, 0.03);
}

TEST(Noise, AKinkAStepAndAFastRiseAreNoWildReadings) {
  const std::vector<double> t_s = EvenTimes(400, 0.01);
  for (int seed = 0; seed < kSeeds / 10; ++seed) {
    std::vector<double> y = WhiteNoise(seed, t_s.size(), 20.0);
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double t = t_s[i];
      if (t > 0.5) y[i] += 8e4 * (1.0 - std::exp(-(t - 0.5) / 0.03));  // three samples a constant
      if (t > 2.0) y[i] -= 3e4;                                        // a step
      if (t > 3.0) y[i] -= 2e4 * (t - 3.0);                            // a kink
    }
    const std::vector<TimeSpan> quiet = {{0.0, 0.5}, {1.0, 3.99}}, stroke = {{0.5, 1.0}};
    const Noise noise = EstimateNoise({t_s, y, quiet, stroke});
    EXPECT_TRUE(noise.outliers.empty()) << seed;
    EXPECT_NEAR(noise.sigma_pa, 20.0, 6.0);
  }
}

TEST(Noise, ReadingsThatStandAtTheEndOfTheRangeAreClipped) {
  const std::vector<double> t_s = EvenTimes(500, 0.01);
  std::vector<double> y = Creeping(t_s, WhiteNoise(3, t_s.size(), kSigmaPa));
  std::vector<std::size_t> cut;
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (i < 40) y[i] += 1e4;
    if (y[i] > 2.005e5) {
      y[i] = 2.005e5;
      cut.push_back(i);
    }
  }
  const Noise noise = OfHold(t_s, y);
  ASSERT_GE(cut.size(), 40u);
  EXPECT_EQ(noise.clipped, cut);
  EXPECT_NEAR(noise.sigma_pa, kSigmaPa, 0.2 * kSigmaPa);
  // The same signal on a coarse grid stands still by itself, at its ends as elsewhere.
  for (double& value : y) value = RoundTo(value, 2e3);
  EXPECT_TRUE(OfHold(t_s, y).clipped.empty());
  // Unless what cuts it off lies between the lines of the grid.
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::min(y[i], 1.99e5);
  const Noise coarse = OfHold(t_s, y);
  EXPECT_EQ(coarse.clip_high_pa, 1.99e5);
  for (const std::size_t i : cut)
    EXPECT_TRUE(std::find(coarse.clipped.begin(), coarse.clipped.end(), i) != coarse.clipped.end());
  EXPECT_NEAR(coarse.quantum_pa, 2e3, 1.0);
  // Without noise: a signal that runs into the end, but not one that settles there, nor one that a
  // valve stops.
  const auto rise = [&](double end_pa) {
    std::vector<double> smooth;
    smooth.reserve(t_s.size());
    for (const double t : t_s)
      smooth.push_back(std::round(100.0 * std::min(2e5 - 1e5 * std::exp(-5.0 * t), end_pa)) /
                       100.0);
    return smooth;
  };
  const std::vector<double> cut_off = rise(1.9e5);
  const Noise stopped = OfHold(t_s, cut_off);
  ASSERT_FALSE(stopped.clipped.empty());
  EXPECT_EQ(
      stopped.clipped.front(),
      static_cast<std::size_t>(std::find(cut_off.begin(), cut_off.end(), 1.9e5) - cut_off.begin()));
  EXPECT_EQ(stopped.clipped.back(), t_s.size() - 1);
  EXPECT_TRUE(OfHold(t_s, rise(3e5)).clipped.empty());
  const double shut_s = t_s[stopped.clipped.front()];
  const std::vector<TimeSpan> quiet = {{shut_s, 10.0}}, stroke = {{0.0, shut_s}};
  EXPECT_TRUE(EstimateNoise({t_s, cut_off, quiet, stroke}).clipped.empty());
  // Neither noise nor grid: a signal at rest.
  EXPECT_TRUE(OfHold(t_s, std::vector<double>(t_s.size(), 1e5)).clipped.empty());
}

// A chamber that is filled, held and emptied, read through a converter of step q = 1 and `noise`;
// at rest the level lies `rest` above its floor (no floor: -1e9).
Noise OfConverter(int seed, double noise, double rest, double floor,
                  const std::vector<TimeSpan>& quiet = {{0.0, 1.0}, {1.8, 3.0}, {5.0, 6.0}}) {
  const std::vector<double> t_s = EvenTimes(600, 0.01), e = WhiteNoise(seed, t_s.size(), noise);
  std::vector<double> y;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    const double t = t_s[i];
    const double filled = 100.0 * (1.0 - std::exp(-(t - 1.0) / 0.1));
    const double signal = t < 1.0 ? 0.0 : t < 3.0 ? filled : 100.0 * std::exp(-(t - 3.0) / 0.2);
    y.push_back(std::max(RoundTo(rest + signal + e[i], 1.0), floor));
  }
  return EstimateNoise({t_s, y, quiet, {{1.0, 1.8}, {3.0, 5.0}}});
}

TEST(Noise, TheFloorOfAConverterIsSeenThroughNoiseAsLargeAsItsStep) {
  int cut = 0, whole = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double noise = 0.6 + 0.05 * (seed % 20);
    const double level = 0.137 * (seed % 5) - 0.4;
    cut += OfConverter(seed, noise, level, 0.0).clip_low_pa == 0.0;
    whole += OfConverter(seed, noise, level, -1e9).clipped.empty();
  }
  EXPECT_GE(cut, 0.9 * kSeeds);
  EXPECT_EQ(whole, kSeeds);
}

// At rest half the noise is cut off: that it is less than half a step there says nothing.
TEST(Noise, WhatTheFloorCutsOffIsNoStaircase) {
  for (int seed = 0; seed < 20; ++seed) {
    const Noise noise = OfConverter(seed, 0.7, -0.4, 0.0, {{0.0, 1.0}, {5.0, 6.0}});
    ASSERT_EQ(noise.clip_low_pa, 0.0) << seed;
    EXPECT_FALSE(noise.staircase) << seed;
    EXPECT_NEAR(noise.sigma_pa, std::hypot(0.7, 1.0 / std::sqrt(12.0)), 0.25) << seed;
  }
}

TEST(Noise, OverlaidSamplesGiveTheScatterOfRepeats) {
  std::vector<double> ratios;
  for (int seed = 0; seed < kSeeds / 4; ++seed) {
    constexpr std::size_t kInstants = 12, kRepeats = 7;
    const std::vector<double> noise = WhiteNoise(seed, kInstants * kRepeats, kSigmaPa);
    std::vector<double> t_s, y;
    for (std::size_t i = 0; i < noise.size(); ++i) {
      const std::size_t place = i / kRepeats;
      const double instant = 0.05 * static_cast<double>(place);
      t_s.push_back(instant + 1e-7 * static_cast<double>(i % kRepeats));
      y.push_back(4e5 * (1.0 - std::exp(-instant / 0.1)) + noise[i]);
    }
    const Noise found = EstimateNoise({t_s, y, {}, {{0.0, t_s.back()}}});
    EXPECT_EQ(found.source, NoiseSource::kRepeats);
    EXPECT_EQ(found.repeat_freedom, 12 * 6);
    EXPECT_NEAR(found.repeat_sigma_pa, found.sigma_pa, 0.2 * found.sigma_pa);
    ratios.push_back(found.sigma_pa / kSigmaPa);
  }
  EXPECT_NEAR(SpreadOf(ratios).mean, 1.0, 0.03);
}

TEST(Noise, MissingSamplesAreLeftOutAndFewSamplesGiveNoNumber) {
  const std::vector<double> t_s = EvenTimes(900, 0.01);
  std::vector<double> y = Creeping(t_s, WhiteNoise(5, t_s.size(), kSigmaPa));
  for (std::size_t i = 0; i < y.size(); i += 3) y[i] = std::nan("");
  EXPECT_NEAR(OfHold(t_s, y).sigma_pa, kSigmaPa, 0.15 * kSigmaPa);
  EXPECT_EQ(OfHold(t_s, y).effective_samples, 600.0);
  const Noise none = OfHold({0.0, 1.0, 2.0}, {1.0, 2.0, 3.0});
  EXPECT_EQ(none.source, NoiseSource::kNone);
  EXPECT_TRUE(std::isnan(none.sigma_pa));
  EXPECT_TRUE(std::isnan(OfHold(t_s, std::vector<double>(900, std::nan(""))).sigma_pa));
}

TEST(Noise, WithoutAClosedValveTheSettledTailCounts) {
  calibration::Run run;
  run.chamber.operating_pressure_pa = 2e5;
  run.valve = {{0.0, model::ValveState::kInflate}, {2.0, model::ValveState::kDeflate}};
  run.t_s = EvenTimes(800, 0.005);
  run.pressure_pa = WhiteNoise(8, run.t_s.size(), kSigmaPa);
  for (std::size_t i = 0; i < run.t_s.size(); ++i) {
    const double t = run.t_s[i];
    run.pressure_pa[i] +=
        t < 2.0 ? 1e5 + 1e5 * (1.0 - std::exp(-t / 0.05)) : 1e5 + 1e5 * std::exp(-(t - 2.0) / 0.05);
  }
  const Noise noise = EstimateNoise(ReadingsOf(run));
  EXPECT_EQ(noise.source, NoiseSource::kTail);
  EXPECT_NEAR(noise.sigma_pa, kSigmaPa, 0.2 * kSigmaPa);
}

}  // namespace noise_test
}  // namespace plenum::calibration
