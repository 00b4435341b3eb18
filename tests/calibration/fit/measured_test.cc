// Numbers of parts that runs measure: their derivatives, and how often their intervals hold the
// truth of an independent simulator.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "calibration/experiment/test_precision.h"
#include "calibration/fit/fit.h"
#include "tests/calibration/bottle.h"

namespace plenum::calibration {
namespace measured_test {

using test::BottleTestOfAPump;
using test::BottleTestOfAValve;
using test::HiddenBottle;

PredictOptions Tight() { return {.relative_tolerance = 1e-10}; }

std::vector<Parameter> Measured(const Dataset& dataset) {
  std::vector<Parameter> parameters;
  for (std::size_t i = 0; i < dataset.measured.size(); ++i)
    parameters.push_back({.kind = Parameter::Kind::kMeasured, .number = i});
  return parameters;
}

void ExpectDifferences(const Dataset& dataset, double relative_step, double allowed) {
  const ForwardModel forward(dataset);
  const ModelState state = forward.Declared();
  const std::vector<Parameter> parameters = Measured(dataset);
  const Prediction p = forward.Predict(0, state, parameters, Tight());
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const double step = relative_step * NumberOf(state, parameters[j]);
    ModelState above = state, below = state;
    NumberOf(above, parameters[j]) += step;
    NumberOf(below, parameters[j]) -= step;
    const auto up = forward.Predict(0, above, {}, Tight()).reading.pressure_pa;
    const auto down = forward.Predict(0, below, {}, Tight()).reading.pressure_pa;
    double largest = 0.0, off = 0.0;
    for (std::size_t k = 0; k < up.size(); ++k) {
      const double slope = (up[k] - down[k]) / (2.0 * step);
      largest = std::max(largest, std::abs(slope));
      off = std::max(off, std::abs(slope - p.derivatives[j].pressure_pa[k]));
    }
    EXPECT_GT(largest, 0.0) << j;
    EXPECT_LT(off, allowed * largest) << dataset.measured[j].name << " " << j;
  }
}

TEST(Measured, DerivativesAgreeWithDifferences) {
  ExpectDifferences(BottleTestOfAValve({}, 1), 1e-4, 5e-3);
  ExpectDifferences(BottleTestOfAPump(test::kPumpDelivery, 1.0, 1), 1e-2, 3e-2);
}

TEST(Measured, TakesThePlaceOfTheCommonFactor) {
  const Dataset dataset = BottleTestOfAValve({}, 1);
  EXPECT_FALSE(Has(dataset.runs[0], Declared::kSonicConductance));
  EXPECT_FALSE(Has(dataset.runs[0], Declared::kCriticalRatio));
  EXPECT_TRUE(Has(dataset.runs[0], Declared::kRestVolume));
  const ForwardModel forward(dataset);
  ModelState state = forward.Declared();
  state.factor[static_cast<std::size_t>(Declared::kSonicConductance)] = 2.0;
  state.measured[0] = 0.7e-9;
  const model::Rig rig = forward.RigOf(0, state);
  EXPECT_EQ(rig.groups[0].fill[0].sonic_conductance_m3_per_s_pa, 0.7e-9);
  EXPECT_EQ(rig.groups[0].exhaust[0].sonic_conductance_m3_per_s_pa, test::kValveC);
}

struct Fitted {
  Fit fit;
  std::vector<MeasuredEstimate> estimates;
};

// With the effects that the bench has: what the search does is not tested here.
Fitted FitOf(const Dataset& dataset, const std::vector<model::Effect>& effects) {
  const ForwardModel forward(dataset);
  const std::vector<ObservedRun> observed = Observe(dataset);
  FitData data;
  data.forward = &forward;
  data.observed = &observed;
  data.runs.resize(dataset.runs.size());
  std::iota(data.runs.begin(), data.runs.end(), std::size_t{0});
  data.sizes = SizesOf(dataset);
  ModelState state = forward.Declared();
  state.effects = effects;
  Fitted fitted{FitModel(data, state, {}), {}};
  fitted.estimates = MeasuredEstimates(dataset, fitted.fit, Covariance(data, fitted.fit, {}));
  WidenByRoom(dataset, fitted.estimates);
  return fitted;
}

// How many of all intervals hold the truth, and each number's spread over its stated deviation.
struct Coverage {
  int inside = 0, all = 0;
  std::vector<double> squares;  // of (value − truth)/truth, by number
  void Add(const std::vector<MeasuredEstimate>& estimates, const std::vector<double>& truth) {
    ASSERT_EQ(estimates.size(), truth.size());
    squares.resize(truth.size());
    for (std::size_t i = 0; i < truth.size(); ++i) {
      inside += estimates[i].low <= truth[i] && truth[i] <= estimates[i].high;
      ++all;
      squares[i] += std::pow(estimates[i].value / truth[i] - 1.0, 2);
    }
  }
};

std::vector<double> TruthOf(const HiddenBottle& hidden) {
  return {test::kValveC * hidden.fill_c, hidden.fill_b, test::kValveC * hidden.exhaust_c,
          hidden.exhaust_b};
}

constexpr std::uint64_t kDraws = 50, kSpreadDraws = 100;

std::vector<model::Effect> Heat(std::optional<double> heat_s) {
  if (!heat_s) return {};
  return {{model::FindEffect("heat_transfer"), {*heat_s}}};
}

// 95 % intervals of 200 numbers hold 90 to 99 % of the truths.
void ExpectCoverage(std::optional<double> heat_s, std::uint64_t seed) {
  Coverage coverage;
  for (std::uint64_t k = seed; k < seed + kDraws; ++k) {
    HiddenBottle hidden = test::DrawBottle(k);
    hidden.heat_s = heat_s;
    coverage.Add(FitOf(BottleTestOfAValve(hidden, k), Heat(heat_s)).estimates, TruthOf(hidden));
  }
  const double share = static_cast<double>(coverage.inside) / coverage.all;
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.99);
}

TEST(Measured, IntervalsHoldTheTruthAtConstantTemperature) { ExpectCoverage({}, 2000); }
TEST(Measured, IntervalsHoldTheTruthWithHeat) { ExpectCoverage(8.0, 3000); }

// The spread of what benches give whose part is as declared, over what was to be expected.
TEST(Measured, TheSpreadIsWhatWasExpectedBeforeTheTest) {
  for (const std::optional<double> heat_s : {std::optional<double>(), std::optional<double>(8.0)}) {
    Coverage coverage;
    for (std::uint64_t k = 1; k <= kSpreadDraws; ++k) {
      HiddenBottle hidden;
      hidden.heat_s = heat_s;
      const HiddenBottle drawn = test::DrawBottle(4000 + k);
      hidden.volume = drawn.volume, hidden.source = drawn.source;
      hidden.ambient_k = drawn.ambient_k;
      coverage.Add(FitOf(BottleTestOfAValve(hidden, 4000 + k), Heat(heat_s)).estimates,
                   TruthOf(hidden));
    }
    Dataset planned = BottleTestOfAValve({}, 1);
    for (calibration::Run& run : planned.runs) run.pressure_pa.clear();
    const auto expected = PrecisionOf(planned, Heat(heat_s), HiddenBottle().noise_pa);
    ASSERT_TRUE(expected);
    for (std::size_t i = 0; i < coverage.squares.size(); ++i) {
      const double reached = std::sqrt(coverage.squares[i] / static_cast<double>(kSpreadDraws));
      const double stated = expected->numbers[i].deviation / expected->numbers[i].value;
      EXPECT_NEAR(reached / stated, 1.0, 0.25) << planned.measured[i].name << " " << stated;
      EXPECT_LE(expected->from_noise[i], expected->numbers[i].deviation * (1.0 + 1e-9));
    }
  }
}

TEST(Measured, ACurveOfAPumpHoldsTheTruth) {
  Coverage coverage;
  constexpr std::uint64_t kPumps = 40;
  for (std::uint64_t k = 0; k < kPumps; ++k) {
    std::mt19937_64 generator(k);
    const auto share = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(generator);
    };
    std::vector<double> truth = test::kPumpDelivery;
    const double common = share(0.85, 1.1);
    for (double& q : truth) q *= common * share(0.97, 1.03);
    std::normal_distribution<double> normal;
    const double volume = 1.0 + test::kBottleUncertainty * normal(generator);
    const double ambient_k = 293.15 + kRoomK * normal(generator);
    coverage.Add(FitOf(BottleTestOfAPump(truth, volume, k, ambient_k), {}).estimates, truth);
  }
  const double share = static_cast<double>(coverage.inside) / coverage.all;
  EXPECT_GE(share, 0.90);
  EXPECT_LE(share, 0.99);
}

}  // namespace measured_test
}  // namespace plenum::calibration
