#include "calibration/fit/fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calibration/bench.h"
#include "tests/support/bench/bench_dataset.h"

namespace plenum::calibration {
namespace fit_test {

using test::EffectRig;
using test::MeasuredBench;

#ifdef PLENUM_SANITIZED
constexpr int kSeeds = 3;
#else
constexpr int kSeeds = 40;
#endif

struct Bench {
  explicit Bench(Dataset measured) : dataset(std::move(measured)), forward(dataset) {
    observed = Observe(dataset);
    data.forward = &forward;
    data.observed = &observed;
    data.runs = {0, 1, 2};
    data.sizes = SizesOf(dataset);
  }
  Bench(const Bench&) = delete;
  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  FitData data;
};

ModelState StartOf(const Bench& bench, const char* id) {
  ModelState state = bench.forward.Declared();
  state.effects = {EffectStarts(*model::FindEffect(id), bench.data.sizes).front()};
  return state;
}

TEST(Fit, FindsTheTrueEffectAndLeavesTheNoise) {
  const Bench bench(MeasuredBench([](EffectRig& rig) { rig.leak = test::LaminarLeak{4e-12}; }, 3));
  ModelState start = bench.forward.Declared();
  start.effects = EffectStarts(*model::FindEffect("leak", "laminar"), bench.data.sizes);
  const Fit fit = FitModel(bench.data, start, {});
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.detail;
  EXPECT_NEAR(fit.chi2_data / static_cast<double>(fit.rows), 1.0, 0.15);
  EXPECT_NEAR(fit.state.effects[0].parameters[0], 4e-12, 2e-13);
}

// Far above all pressures an offset and a loss in the line take each other back.
TEST(Fit, ASensorIsOffByNoMoreThanAWorkingOne) {
  const Bench bench(MeasuredBench({}, 4));
  ModelState start = bench.forward.Declared();
  start.effects = {{model::FindEffect("cracking_pressure"), {5e5}},
                   {model::FindEffect("sensor_offset"), {-5e5}}};
  const Fit fit = FitModel(bench.data, start, {});
  ASSERT_TRUE(fit.Usable()) << fit.detail;
  EXPECT_LE(std::abs(fit.state.effects[1].parameters[0]), 0.25 * bench.data.sizes.gauge_pa + 1e-6);
}

// What the bench does not have goes to its bound at zero, or as near as noise lets it.
TEST(Fit, AnAbsentEffectVanishes) {
  const Bench bench(MeasuredBench({}, 4));
  const Fit fit = FitModel(bench.data, StartOf(bench, "valve_delay"), {});
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.detail;
  EXPECT_LT(fit.state.effects[0].parameters[0], 1e-3);
  EXPECT_GE(fit.state.effects[0].parameters[0], 0.0);
}

// Intervals of 95 % hold the truth about as often: of 3·40 between 88 and 100 % (binomial, 1e-3).
TEST(Fit, IntervalsHoldTheTruth) {
  int held = 0, asked = 0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double volume = 1.0 + 0.02 * test::WhiteNoise(500 + seed, 1, 1.0)[0];
    const double conductance = 1.0 + 0.03 * test::WhiteNoise(700 + seed, 1, 1.0)[0];
    const Bench bench(MeasuredBench(
        [&](EffectRig& rig) {
          rig.rest_volume_m3 *= volume;
          rig.fill[0].conductance *= conductance, rig.exhaust[0].conductance *= conductance;
          rig.valve_delay_s = 0.03;
        },
        seed));
    const Fit fit = FitModel(bench.data, StartOf(bench, "valve_delay"), {});
    ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.detail;
    const std::vector<Estimate> estimates = Intervals(fit, Covariance(bench.data, fit, {}));
    for (std::size_t j = 0; j < estimates.size(); ++j) {
      const Parameter& parameter = fit.coordinates[j].parameter;
      const double truth = parameter.kind == Parameter::Kind::kEffect    ? 0.03
                           : parameter.declared == Declared::kRestVolume ? volume
                                                                         : conductance;
      held += truth >= estimates[j].low && truth <= estimates[j].high;
      ++asked;
    }
  }
  EXPECT_EQ(asked, 3 * kSeeds);
  EXPECT_GE(held, static_cast<int>(0.88 * asked));
  if (kSeeds >= 40) {
    EXPECT_LT(held, asked);
  }
}

// Volume and conductance of one chamber cannot be told apart: unknown both, neither is fixed.
TEST(Fit, AnAliasIsNotIdentified) {
  Dataset dataset = MeasuredBench({}, 5);
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = kUnknown;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = kUnknown;
  const Bench bench(std::move(dataset));
  const Fit fit = FitModel(bench.data, bench.forward.Declared(), {});
  ASSERT_TRUE(fit.Usable()) << fit.detail;
  for (const Estimate& estimate : Intervals(fit, Covariance(bench.data, fit, {})))
    EXPECT_FALSE(estimate.identified);
}

TEST(Fit, ClocksThatAreOffAreFound) {
  Dataset dataset = MeasuredBench({}, 6);
  const double late_s[] = {4e-3, -3e-3, 2e-3};
  for (std::size_t i = 0; i < 3; ++i)
    for (double& t_s : dataset.runs[i].t_s) t_s += late_s[i];
  Bench bench(std::move(dataset));
  bench.data.clocks = true;
  const Fit fit = FitModel(bench.data, bench.forward.Declared(), {});
  ASSERT_EQ(fit.status, FitStatus::kConverged) << fit.detail;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.state.clock_s[i], late_s[i], 1e-3) << i;
}

// Every twentieth reading: strokes of two, the first half a sample after the start.
TEST(Fit, ClocksOfRunsThatBeginWithinASampleOfAStrokeAreFound) {
  Dataset dataset = MeasuredBench({}, 6);
  const double late_s[] = {0.1, 0.08, -0.06};
  for (std::size_t i = 0; i < 3; ++i) {
    calibration::Run few = dataset.runs[i];
    few.t_s.clear();
    few.pressure_pa.clear();
    for (std::size_t k = 0; k < dataset.runs[i].t_s.size(); k += 20) {
      few.t_s.push_back(dataset.runs[i].t_s[k] + late_s[i]);
      few.pressure_pa.push_back(dataset.runs[i].pressure_pa[k]);
    }
    dataset.runs[i] = few;
  }
  Bench bench(std::move(dataset));
  bench.data.clocks = true;
  const Fit fit = FitModel(bench.data, bench.forward.Declared(), {});
  ASSERT_TRUE(fit.Usable()) << fit.detail;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fit.state.clock_s[i], late_s[i], 0.02) << i;
}

// A stroke cannot come before the run.
TEST(BaseCoordinates, AClockIsEarlyByNoMoreThanThereIsBeforeTheFirstStroke) {
  Dataset dataset = MeasuredBench({}, 6);
  const auto clock_of = [&](double first_s) {
    dataset.runs[0].valve[1].time_s = first_s;
    const ForwardModel forward(dataset);
    std::vector<Coordinate> clocks = BaseCoordinates(forward, {0}, true);
    std::erase_if(clocks, [](const Coordinate& coordinate) {
      return coordinate.parameter.kind != Parameter::Kind::kClock;
    });
    return clocks;
  };
  for (const double intervals : {0.5, 1.5, 2.0, 9.0}) {
    const std::vector<Coordinate> clocks = clock_of(0.02 * intervals);
    ASSERT_EQ(clocks.size(), 1u) << intervals;
    EXPECT_NEAR(clocks[0].low * clocks[0].scale, -0.02 * std::min(intervals, 2.0), 1e-12);
    EXPECT_NEAR(clocks[0].high * clocks[0].scale, 0.04, 1e-12);
  }
  EXPECT_TRUE(clock_of(0.0).empty());
}

// The critical ratio of a leak that is not there costs nothing, of one that is plain most of what
// any number does.
TEST(Fit, ARatioCostsWhatTheReadingsTellOfIt) {
  const auto numbers_counted = [](const test::Change& change) {
    const Bench bench(MeasuredBench(change, 8, 1.0));
    ModelState start = bench.forward.Declared();
    start.effects = EffectStarts(*model::FindEffect("leak", "orifice"), bench.data.sizes);
    Fit fit = FitModel(bench.data, start, {});
    const double nats = std::log(static_cast<double>(fit.rows));
    EXPECT_NEAR(Penalty(fit, 1.0), 2.0 * nats, 1e-9);
    const double bic = fit.bic;
    Narrow(bench.data, {}, fit);
    EXPECT_NEAR(bic - fit.bic, 2.0 * nats - Penalty(fit, 1.0), 1e-6);
    return Penalty(fit, 1.0) / nats;
  };
  EXPECT_NEAR(numbers_counted({}), 1.0, 0.3);
  const auto leak = [](EffectRig& rig) { rig.leak = test::OrificeLeak{1e-11, 0.3}; };
  EXPECT_NEAR(numbers_counted(leak), 2.0, 0.3);
}

TEST(Fit, PairsOfPartsThatNoRunSharesMoveByThemselves) {
  Dataset dataset = MeasuredBench([](EffectRig& rig) { rig.fill[0].conductance *= 1.05; }, 8);
  const Bench shared(dataset);
  EXPECT_FALSE(HasOwnPairs(shared.data, 3));
  dataset.runs[3].line[0].fill.sonic_conductance_m3_per_s_pa *= 1.01;
  Bench bench(dataset);
  EXPECT_TRUE(HasOwnPairs(bench.data, 3));
  bench.data.runs = {3};
  FitOptions options;
  options.nuisance_only = options.own_pairs = true;
  const Fit fit = FitModel(bench.data, bench.forward.Declared(), options);
  ASSERT_TRUE(fit.Usable());
  ASSERT_EQ(fit.coordinates.size(), 1u);
  EXPECT_EQ(fit.coordinates[0].parameter.declared, Declared::kSonicConductance);
  EXPECT_GT(fit.state.factor[static_cast<std::size_t>(Declared::kSonicConductance)], 1.01);
}

// Readings that weigh less leave a declared number nearer to what was declared.
TEST(Fit, TheWeightOfReadingsIsBesideThePriors) {
  const Bench bench(MeasuredBench([](EffectRig& rig) { rig.rest_volume_m3 *= 1.05; }, 9));
  FitOptions options;
  const Fit full = FitModel(bench.data, bench.forward.Declared(), options);
  options.weight = 1e-3;
  const Fit light = FitModel(bench.data, bench.forward.Declared(), options);
  ASSERT_TRUE(full.Usable() && light.Usable());
  EXPECT_LT(light.chi2_prior, full.chi2_prior);
  EXPECT_GT(light.chi2_data, full.chi2_data);
}

// A supply whose critical ratio wants to be below zero: with that at its bound the declared numbers
// must come as near to what was stated of them as they can.
TEST(Fit, ANumberAtItsBoundHoldsNoOtherBack) {
  Bench bench(test::ToDataset(test::CaseOfSeries(25, 71)));
  bench.data.runs = {0, 1, 2, 3, 4};
  FitOptions options;
  options.noise_share = 1e-3;
  options.function_tolerance = 1e-9;
  options.iterations_max = 100;
  const Fit fit = FitModel(bench.data, StartOf(bench, "supply_droop"), options);
  ASSERT_TRUE(fit.Usable());
  ASSERT_EQ(fit.state.effects[0].parameters[2], 0.0);
  options.fixed = fit.coordinates.back().parameter;
  const Fit held = FitModel(bench.data, fit.state, options);
  ASSERT_TRUE(held.Usable());
  EXPECT_LT(fit.chi2_data + fit.chi2_prior, held.chi2_data + held.chi2_prior + 0.1);
}

TEST(Fit, CancelledSaysSo) {
  const Bench bench(MeasuredBench({}, 7));
  FitOptions options;
  options.cancelled = [] { return true; };
  EXPECT_EQ(FitModel(bench.data, bench.forward.Declared(), options).status, FitStatus::kCancelled);
}

// A lag or a wall that follows within an eighth or a third of a sample still shifts what is read.
TEST(Fit, FastEffectsAreFoundWhereTheyAre) {
  constexpr double kQuietPa = 10.0;
  const auto fitted = [](const test::Change& change, const char* id) {
    const Bench bench(MeasuredBench(change, 31, kQuietPa));
    return FitModel(bench.data, StartOf(bench, id), {}).state.effects[0].parameters[0];
  };
  EXPECT_NEAR(fitted([](EffectRig& rig) { rig.sensor_lag_s = 0.0025; }, "sensor_lag"), 0.0025,
              3e-4);
  EXPECT_NEAR(fitted([](EffectRig& rig) { rig.heat_time_constant_s = 0.007; }, "heat_transfer"),
              0.007, 7e-4);
}

}  // namespace fit_test
}  // namespace plenum::calibration
