#include "calibration/judge/evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plenum::calibration {
namespace evidence_test {

// Gauss–Markov noise with correlation ρ from one sample to the next has φ = (1 + ρ)/(1 − ρ).
TEST(Evidence, MemoryOfAGaussMarkovSeries) {
  for (const double rho : {0.0, 0.5, 0.9}) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> normal;
    std::vector<std::vector<double>> series(4);
    for (auto& e : series) {
      double x = 0.0;
      for (int i = 0; i < 20'000; ++i) e.push_back(x = rho * x + normal(random));
    }
    const double expected = (1.0 + rho) / (1.0 - rho);
    EXPECT_NEAR(MemoryOf(series), expected, 0.15 * expected) << rho;
  }
}

TEST(Evidence, RepeatedReadingsAddNothing) {
  std::mt19937_64 random(8);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> series(1);
  for (int i = 0; i < 5'000; ++i) series[0].insert(series[0].end(), 5, normal(random));
  EXPECT_NEAR(MemoryOf(series), 5.0, 1.0);
}

// Against the sums themselves, over series of different lengths.
TEST(Evidence, MemoryIsThatOfTheProductsByLag) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> series(3);
  for (std::size_t k = 0; k < series.size(); ++k) {
    double x = 0.0;
    for (std::size_t i = 0; i < 1 + 150 * k; ++i) series[k].push_back(x = 0.8 * x + normal(random));
  }
  const auto product = [&](std::size_t lag) {
    double sum = 0.0;
    for (const std::vector<double>& e : series)
      for (std::size_t i = lag; i < e.size(); ++i) sum += e[i] * e[i - lag];
    return sum;
  };
  double expected = 1.0;
  for (std::size_t lag = 1; product(lag) > 0.0; ++lag) expected += 2.0 * product(lag) / product(0);
  EXPECT_GT(expected, 3.0);
  EXPECT_NEAR(MemoryOf(series), expected, 1e-9);
}

Contender With(std::vector<const model::EffectSpec*> effects, double chi2) {
  Contender contender{std::move(effects), {}};
  contender.fit.status = FitStatus::kConverged;
  contender.fit.rows = 1000;
  contender.fit.chi2_data = chi2;
  contender.fit.coordinates.resize(contender.effects.size() + 1);
  return contender;
}

// A set that is ahead only because its declared numbers are nearer to what was declared.
TEST(Evidence, ASetThatLeavesMoreOfTheReadingsThanAPartOfItDoesNotStand) {
  const auto* ramp = model::FindEffect("valve_ramp");
  const auto* play = model::FindEffect("hysteresis");
  std::vector<Contender> contenders = {With({}, 9000.0), With({ramp}, 1200.0),
                                       With({ramp, play}, 1210.0)};
  contenders[1].fit.chi2_prior = 40.0;
  EXPECT_LT(BicWith(contenders[2].fit, 10.0) + 10.0, BicWith(contenders[1].fit, 10.0));
  EXPECT_EQ(Standing(contenders, 10.0), 1u);
  contenders[2].fit.chi2_data = 1190.0;
  EXPECT_EQ(Standing(contenders, 10.0), 2u);
}

TEST(Evidence, WhatStandsShrinksWithTheMemory) {
  const auto* leak = model::FindEffect("leak", "laminar");
  const auto* lag = model::FindEffect("sensor_lag");
  const std::vector<Contender> contenders = {With({}, 9000.0), With({leak}, 1200.0),
                                             With({lag}, 5000.0), With({leak, lag}, 1100.0)};
  EXPECT_EQ(Standing(contenders, 1.0), 3u);
  EXPECT_EQ(Standing(contenders, 20.0), 1u);
  EXPECT_EQ(Standing(contenders, 500.0), 0u);
  EXPECT_DOUBLE_EQ(BicWith(contenders[1].fit, 1.0),
                   1000.0 * std::log(1.2) + 2.0 * std::log(1000.0));
}

}  // namespace evidence_test
}  // namespace plenum::calibration
