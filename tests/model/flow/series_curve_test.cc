#include "model/flow/series_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "model/simulate/simulate.h"
#include "tests/model/simulate/simulate_rigs.h"

namespace plenum::model {
namespace series_curve_test {

using Uniform = std::uniform_real_distribution<double>;

Series RandomLine(std::mt19937& random) {
  std::vector<FlowElement> elements(std::uniform_int_distribution<std::size_t>(2, 5)(random));
  for (FlowElement& element : elements)
    element = {.sonic_conductance_m3_per_s_pa = 1e-9 * std::pow(100.0, Uniform(0.0, 1.0)(random)),
               .critical_ratio = Uniform(0.0, 0.95)(random)};
  return MakeSeries(elements);
}

double FlowOf(const Series& series, double cosine) {
  return series.choked_flow_m3_per_s_pa * std::sqrt((1.0 - cosine) * (1.0 + cosine));
}

// The march from the flow to the ratio is explicit: no solution is compared with another.
TEST(SeriesCurve, FlowsComeToTheRatiosThatWereAskedFor) {
  std::mt19937 random(3);
  std::vector<double> worst;
  for (int k = 0; k < 2000; ++k) {
    const Series series = RandomLine(random);
    std::optional<SeriesCurve> curve = SeriesCurve::Of(series);
    if (!curve) continue;
    double largest = 0.0;
    for (int i = 0; i < 200; ++i) {
      const double share = Uniform(0.0, kLinearRatio)(random);
      const double ratio = series.choked_ratio + share * (1.0 - series.choked_ratio);
      const double flow = FlowOf(series, curve->CosineAt(ratio));
      const RatioAndSlope at = RatioAndSlopeAtFlow(series, flow);
      largest = std::max(largest, std::abs((at.ratio - ratio) / at.slope_pa_s_per_m3) / flow);
    }
    worst.push_back(largest);
  }
  std::sort(worst.begin(), worst.end());
  EXPECT_LT(worst.back(), 1.1 * kCurveError);
  ASSERT_GT(worst.size(), 1980u);
  EXPECT_LT(worst[1800], 0.01 * kCurveError);
}

TEST(SeriesCurve, MeetsTheEndsOfTheCurve) {
  std::mt19937 random(4);
  const Series series = RandomLine(random);
  std::optional<SeriesCurve> curve = SeriesCurve::Of(series);
  ASSERT_TRUE(curve);
  EXPECT_NEAR(curve->CosineAt(1.0), 1.0, 1e-12);
  EXPECT_NEAR(curve->CosineAt(series.choked_ratio), 0.0, 1e-12);
  EXPECT_NEAR(curve->CosineAt(1.0), 1.0, 1e-12);
}

// Runs just inside and outside the tolerance from which flows are read from the curve.
TEST(SeriesCurve, RunsAreThoseOfFlowsThatAreSolved) {
  GroupRig group =
      OneActuator(1.6e5, 1.8, {.sonic_conductance_m3_per_s_pa = 0.08e-8, .critical_ratio = 0.3});
  group.fill.push_back({.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.2});
  group.exhaust.push_back({.sonic_conductance_m3_per_s_pa = 0.1e-8, .critical_ratio = 0.2});
  group.schedule = {
      {0.1, ValveState::kInflate}, {0.9, ValveState::kDeflate}, {1.6, ValveState::kInflate}};
  const Rig rig = RigOf(Regulated(1.7e5), {group});
  SimulateOptions read = Until(2.0, 100.0), solved = read;
  read.relative_tolerance = kCurveError;
  solved.relative_tolerance = 0.999 * kCurveError;
  const std::vector<double> of_curve = Simulate(rig, read).groups[0].pressure_pa;
  const std::vector<double> exact = Simulate(rig, solved).groups[0].pressure_pa;
  ASSERT_EQ(of_curve.size(), exact.size());
  EXPECT_NE(of_curve, exact);
  for (std::size_t i = 0; i < exact.size(); ++i) EXPECT_NEAR(of_curve[i], exact[i], 0.02) << i;
}

}  // namespace series_curve_test
}  // namespace plenum::model
