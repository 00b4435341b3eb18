#include "calibration/fit/profile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace profile_test {

using test::EffectRig;
using test::MeasuredBench;

struct Fitted {
  // From `start` in SI; empty: from the effect's own.
  Fitted(Dataset measured, const char* id, const std::vector<double>& start = {})
      : dataset(std::move(measured)), forward(dataset) {
    observed = Observe(dataset);
    data.forward = &forward;
    data.observed = &observed;
    data.runs = {0, 1, 2};
    data.sizes = SizesOf(dataset);
    options.function_tolerance = 1e-9;
    options.noise_share = 1e-3;
    ModelState state = forward.Declared();
    state.effects = {EffectStarts(*model::FindEffect(id), data.sizes).front()};
    if (!start.empty()) state.effects.back().parameters = start;
    fit = FitModel(data, state, options);
    covariance = Covariance(data, fit, options);
    parabola = profile = Intervals(fit, covariance);
    ProfileIntervals(data, fit, covariance, Inflation(fit, 1.0), options, profile);
  }
  Fitted(const Fitted&) = delete;
  Dataset dataset;
  ForwardModel forward;
  std::vector<ObservedRun> observed;
  FitData data;
  FitOptions options;
  Fit fit;
  Eigen::MatrixXd covariance;
  std::vector<Estimate> parabola, profile;
};

TEST(Profile, OfADelayIsAParabola) {
  const Fitted f(MeasuredBench([](EffectRig& rig) { rig.valve_delay_s = 0.03; }, 21),
                 "valve_delay");
  ASSERT_TRUE(f.fit.Usable());
  for (std::size_t j = 0; j < f.profile.size(); ++j) {
    const double width = f.parabola[j].high - f.parabola[j].low;
    EXPECT_NEAR(f.profile[j].low, f.parabola[j].low, 0.05 * width) << j;
    EXPECT_NEAR(f.profile[j].high, f.parabola[j].high, 0.05 * width) << j;
  }
}

// At each end that is not a bound, the others fitted again from `truth`, Q is 3.84 above its least.
// Returns how many such ends there are.
int ExpectEndsAtTheRise(const Fitted& f, const std::vector<double>& truth) {
  const double inflation = Inflation(f.fit, 1.0);
  int ends = 0;
  for (std::size_t j = 0; j < f.fit.coordinates.size(); ++j) {
    const Coordinate& coordinate = f.fit.coordinates[j];
    if (coordinate.parameter.kind != Parameter::Kind::kEffect) continue;
    const double one = coordinate.Number(coordinate.low),
                 other = coordinate.Number(coordinate.high);
    for (const double end : {f.profile[j].low, f.profile[j].high}) {
      if (end <= std::min(one, other) || end >= std::max(one, other)) continue;
      FitOptions options = f.options;
      options.fixed = coordinate.parameter;
      options.weight = 1.0 / inflation;
      options.iterations_max = 200;
      double least = std::numeric_limits<double>::infinity();
      for (const bool from_truth : {false, true}) {
        ModelState start = f.fit.state;
        if (from_truth) start.effects.back().parameters = truth;
        NumberOf(start, coordinate.parameter) = end;
        const Fit moved = FitModel(f.data, start, options);
        if (!moved.Usable()) continue;
        EXPECT_EQ(NumberOf(moved.state, coordinate.parameter), end);
        least = std::min(least, (moved.chi2_data - f.fit.chi2_data) / inflation + moved.chi2_prior -
                                    f.fit.chi2_prior);
      }
      EXPECT_NEAR(least, 3.84, 1.2) << j << ' ' << end;
      ++ends;
    }
  }
  return ends;
}

TEST(Profile, EndsWhereTheOthersCanMakeUpForNoMore) {
  const Fitted f(MeasuredBench(
                     [](EffectRig& rig) {
                       rig.exhaust.push_back({0.08e-8, 0.2});
                     },
                     22),
                 "exhaust_restriction");
  ASSERT_TRUE(f.fit.Usable());
  EXPECT_GE(ExpectEndsAtTheRise(f, {0.08e-8, 0.2}), 2);
}

// Volume and refill of a droop make up for each other along a bent ridge, which the parabola leaves
// for where the refill is so wide that nothing droops.
TEST(Profile, FollowsABentRidge) {
  const std::vector<double> truth = {150e-6, 0.02e-8, 0.3};
  const Fitted f(MeasuredBench(
                     [&](EffectRig& rig) {
                       rig.supply_droop = test::SupplyDroop{truth[0], truth[1], truth[2]};
                     },
                     22),
                 "supply_droop", truth);
  ASSERT_TRUE(f.fit.Usable());
  EXPECT_GE(ExpectEndsAtTheRise(f, truth), 2);
}

}  // namespace profile_test
}  // namespace plenum::calibration
