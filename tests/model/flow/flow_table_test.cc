// The tabulated flow curve against the exact march it stands for.
#include "model/flow/flow_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace plenum::model {
namespace flow_table_test {

class RandomChains {
 public:
  explicit RandomChains(unsigned seed) : generator_(seed) {}
  double Uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(generator_);
  }
  Series Draw() {
    std::vector<FlowElement> elements(std::uniform_int_distribution<std::size_t>(1, 8)(generator_));
    for (FlowElement& element : elements)
      element = {1e-8 * std::pow(10.0, Uniform(-1.0, 1.0)), Uniform(0.0, 0.6)};
    return MakeSeries(elements, Uniform(0.7, 1.1));
  }

 private:
  std::mt19937 generator_;
};

TEST(FlowTable, ItsSlopeIsThatOfItsDifferences) {
  RandomChains chains(12);
  for (int trial = 0; trial < 200; ++trial) {
    const Series series = chains.Draw();
    const FlowTable table(series);
    for (int i = 0; i < 20; ++i) {
      const double ratio = chains.Uniform(0.5 * series.choked_ratio, 0.999);
      const double h = 1e-7;
      const FlowTable::FlowAndSlope at = table.WithSlope(ratio);
      EXPECT_EQ(at.flow, table(ratio));
      const double left = (table(ratio) - table(ratio - h)) / h;
      const double right = (table(ratio + h) - table(ratio)) / h;
      const double room = 1e-4 * std::abs(left) + 1e-6 * series.choked_flow_m3_per_s_pa;
      EXPECT_LE(at.slope, std::max(left, right) + room);
      EXPECT_GE(at.slope, std::min(left, right) - room);
    }
  }
}

TEST(FlowTable, FollowsTheExactCurveOnRandomChains) {
  RandomChains chains(11);
  std::vector<double> errors;
  double relative = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Series series = chains.Draw();
    const FlowTable table(series);
    double largest = 0.0;
    // Dense at both ends: y = √(1 − r) even, past the choked ratio as well.
    for (int i = 0; i <= 500; ++i) {
      const double y = i / 500.0;
      const double ratio = 1.0 - y * y * (1.0 - 0.9 * series.choked_ratio);
      const double exact = FlowAtRatio(series, ratio);
      const double error = std::abs(table(ratio) - exact);
      largest = std::max(largest, error / series.choked_flow_m3_per_s_pa);
      if (exact > 0.0) relative = std::max(relative, error / exact);
    }
    errors.push_back(largest);
  }
  std::sort(errors.begin(), errors.end());
  EXPECT_LT(errors[1000], 1.5e-9);
  EXPECT_LT(errors[1980], 1.5e-6);
  EXPECT_LT(errors.back(), 3e-5);
  EXPECT_LT(relative, 3e-5);
  RecordProperty("median", std::to_string(1e9 * errors[1000]) + "e-9");
  RecordProperty("99 in 100", std::to_string(1e9 * errors[1980]) + "e-9");
  RecordProperty("worst", std::to_string(1e9 * errors.back()) + "e-9");
}

// A single element is the ellipse itself, written down here.
TEST(FlowTable, OfOneElementIsTheEllipse) {
  const std::vector<FlowElement> element{{2e-8, 0.35}};
  const FlowTable table(MakeSeries(element));
  for (int i = 0; i <= 1000; ++i) {
    const double ratio = i / 1000.0;
    const double x = std::max(0.0, (ratio - 0.35) / 0.65);
    EXPECT_NEAR(table(ratio), 2e-8 * std::sqrt(1.0 - x * x), 1e-12 * 2e-8) << ratio;
  }
}

TEST(FlowTable, NeverRisesWithTheRatio) {
  RandomChains chains(12);
  for (int trial = 0; trial < 500; ++trial) {
    const Series series = chains.Draw();
    const FlowTable table(series);
    double before = table(0.0);
    EXPECT_EQ(before, series.choked_flow_m3_per_s_pa);
    for (int i = 1; i <= 3000; ++i) {
      const double flow = table(series.choked_ratio + (1.0 - series.choked_ratio) * i / 3000.0);
      ASSERT_LE(flow, before * (1.0 + 1e-15)) << trial << " " << i;
      before = flow;
    }
    EXPECT_EQ(table(1.0), 0.0);
    EXPECT_EQ(table(1.5), 0.0);
  }
}

// q = √((1 − r)/(½·Σ(1 − b)/C²)) to first order: the digits near equal pressures are there.
TEST(FlowTable, KeepsItsDigitsNearEqualPressures) {
  const std::vector<FlowElement> elements{{1e-8, 0.3}, {3e-8, 0.1}, {0.5e-8, 0.5}};
  double loss = 0.0;
  for (const FlowElement& e : elements)
    loss += 0.5 * (1.0 - e.critical_ratio) / std::pow(e.sonic_conductance_m3_per_s_pa, 2);
  const FlowTable table(MakeSeries(elements));
  for (double gap : {1e-6, 1e-8, 1e-10}) {
    const double first_order = std::sqrt(gap / loss);
    EXPECT_NEAR(table(1.0 - gap) / first_order, 1.0, gap + 1e-6) << gap;
  }
}

}  // namespace flow_table_test
}  // namespace plenum::model
