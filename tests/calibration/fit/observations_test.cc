#include "calibration/fit/observations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace observations_test {

using test::EffectRig;
using test::MeasuredBench;

std::vector<Reading> DeclaredReadings(const ForwardModel& forward, std::size_t runs) {
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < runs; ++i)
    readings.push_back(forward.Predict(i, forward.Declared(), {}, {}).reading);
  return readings;
}

TEST(Observations, AWildReadingThatOnlyAFitShowsIsLeftOut) {
  Dataset dataset = MeasuredBench({}, 11);
  std::vector<double>& readings = dataset.runs[0].pressure_pa;
  const std::size_t wild = 12;  // beside a gap, where the stroke begins
  readings[wild] += 20.0 * test::kBenchNoisePa;
  readings[wild + 1] = readings[wild + 2] = std::nan("");
  const ForwardModel forward(dataset);
  std::vector<ObservedRun> observed = Observe(dataset);
  const auto used = [&] {
    const auto& samples = observed[0].signals[0].samples;
    return std::find(samples.begin(), samples.end(), wild) != samples.end();
  };
  ASSERT_TRUE(used());
  const std::vector<Reading> predicted = DeclaredReadings(forward, 4);
  EXPECT_TRUE(LeaveOutWild(dataset, {0, 1, 2}, predicted, observed));
  EXPECT_FALSE(used());
  EXPECT_EQ(observed[0].noise.outliers, std::vector<std::size_t>{wild});
  EXPECT_EQ(observed[0].signals[0].steps.size(), observed[0].signals[0].samples.size());
  EXPECT_FALSE(LeaveOutWild(dataset, {0, 1, 2}, predicted, observed));
}

TEST(Observations, StructureIsNotLeftOut) {
  Dataset dataset = MeasuredBench([](EffectRig& rig) { rig.valve_delay_s = 0.06; }, 12, 20.0);
  const ForwardModel forward(dataset);
  std::vector<ObservedRun> observed = Observe(dataset);
  EXPECT_FALSE(LeaveOutWild(dataset, {0, 1, 2}, DeclaredReadings(forward, 4), observed));
}

TEST(Observations, WhatJumpsDoesNotCountBesideACommand) {
  Dataset dataset = MeasuredBench({}, 14);
  calibration::Run& run = dataset.runs[0];
  run.t_s = {0.0, 0.1, 0.2, 0.3, 0.3, 0.4, 0.5, 0.6, 0.7};
  run.pressure_pa = {1.0e5, 1.0e5, 1.1e5, 1.2e5, 1.2e5, 1.3e5, 1.3e5, 1.3e5, 1.3e5};
  run.channels.inlet_pressure_pa = {1.0e5, 1.0e5, 1.8e5, 1.8e5, 1.8e5, 1.9e5, 1.3e5, 1.3e5, 1.3e5};
  run.channels.volume_m3 = {1.0, 1.0, 1.1, 1.2, 1.2, 1.3, 1.3, 1.3, 1.3};
  run.valve = {{0.0, model::ValveState::kHold},
               {0.15, model::ValveState::kInflate},
               {0.45, model::ValveState::kHold},
               {0.6, model::ValveState::kHold}};
  const ObservedRun observed = Observe(dataset)[0];
  ASSERT_EQ(observed.signals.size(), 3u);
  EXPECT_EQ(observed.signals[0].samples.size(), 9u);
  EXPECT_EQ(observed.signals[1].samples, (std::vector<std::size_t>{0, 3, 4, 7, 8}));
  EXPECT_EQ(observed.signals[1].steps.size(), 5u);
  EXPECT_EQ(observed.signals[2].samples.size(), 9u);
  // Turned at every sample it counts nowhere.
  run.valve.clear();
  for (std::size_t i = 0; i < run.t_s.size(); ++i)
    run.valve.push_back(
        {run.t_s[i], i % 2 ? model::ValveState::kHold : model::ValveState::kInflate});
  EXPECT_EQ(Observe(dataset)[0].signals.size(), 2u);
}

TEST(Observations, BehindAGridIsTheNoiseThatATrueModelLeaves) {
  constexpr double kQuantum = 600.0, kNoise = 90.0;
  Dataset dataset = MeasuredBench({}, 13, kNoise);
  for (calibration::Run& run : dataset.runs)
    for (double& p : run.pressure_pa) p = 1e5 + kQuantum * std::round((p - 1e5) / kQuantum);
  const ForwardModel forward(dataset);
  std::vector<ObservedRun> observed = Observe(dataset);
  ASSERT_EQ(observed[1].signals[0].grid.quantum(), kQuantum);
  EXPECT_EQ(observed[1].signals[0].grid.noise(), kQuantum);
  const std::vector<Reading> predicted = DeclaredReadings(forward, 4);
  EXPECT_TRUE(TakeHiddenNoise(dataset, {0, 1, 2}, predicted, observed));
  EXPECT_NEAR(observed[1].signals[0].grid.noise(), kNoise, 0.2 * kNoise);
  // Residuals from the mean reading are smaller than those from the model.
  double squares = 0.0, plain = 0.0;
  std::vector<double> rows(observed[1].rows());
  Residuals(dataset.runs[1], observed[1], predicted[1], rows);
  for (const double e : rows) squares += e * e;
  observed[1].signals[0].grid = {};
  Residuals(dataset.runs[1], observed[1], predicted[1], rows);
  for (const double e : rows) plain += e * e;
  EXPECT_LT(squares, 0.9 * plain);
}

// Twelve readings of a rise and a fall: the signal bends between them, and their differences are
// its own. What the right model leaves is the noise.
TEST(Observations, NoiseOfFewReadingsIsWhatAFitLeaves) {
  Dataset dataset = test::MeasuredBench(nullptr, 41);
  for (calibration::Run& run : dataset.runs) {
    std::vector<double> t_s, pressure_pa;
    for (std::size_t i = 0; i < run.t_s.size(); i += 21) {
      t_s.push_back(run.t_s[i]);
      pressure_pa.push_back(run.pressure_pa[i]);
    }
    run.t_s = t_s, run.pressure_pa = pressure_pa;
  }
  std::vector<ObservedRun> observed = Observe(dataset);
  ASSERT_GT(observed[0].signals.front().sigma, 5.0 * test::kBenchNoisePa);
  const ForwardModel forward(dataset);
  const std::vector<Reading> predicted = DeclaredReadings(forward, dataset.runs.size());
  EXPECT_TRUE(TakeNoiseOfFit(dataset, {0, 1, 2}, predicted, 4, observed));
  for (const ObservedRun& run : observed) {
    EXPECT_NEAR(run.signals.front().sigma, test::kBenchNoisePa, 0.5 * test::kBenchNoisePa);
    EXPECT_EQ(run.noise.sigma_pa, run.signals.front().sigma);
  }
  EXPECT_FALSE(TakeNoiseOfFit(dataset, {0, 1, 2}, predicted, 4, observed));
}

TEST(Observations, NoiseOfManyReadingsIsTheirOwn) {
  const Dataset dataset = test::MeasuredBench(nullptr, 42);
  std::vector<ObservedRun> observed = Observe(dataset);
  const double sigma_pa = observed[0].signals.front().sigma;
  std::vector<Reading> predicted;
  predicted.reserve(dataset.runs.size());
  for (const calibration::Run& run : dataset.runs)
    predicted.push_back({.pressure_pa = run.pressure_pa, .channels = {}});
  for (Reading& reading : predicted)
    for (double& pa : reading.pressure_pa) pa += 0.7 * sigma_pa;
  EXPECT_FALSE(TakeNoiseOfFit(dataset, {0, 1, 2}, predicted, 4, observed));
  EXPECT_EQ(observed[0].signals.front().sigma, sigma_pa);
}

}  // namespace observations_test
}  // namespace plenum::calibration
