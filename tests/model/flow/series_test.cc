#include "model/flow/series.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <random>
#include <vector>

namespace plenum::model {
namespace series_test {

using Line = std::vector<FlowElement>;

Line RandomLine(std::mt19937_64& random, std::size_t size) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Line line(size);
  for (FlowElement& element : line) {
    element.sonic_conductance_m3_per_s_pa = 1e-8 * std::exp(3.0 * unit(random) - 1.5);
    element.critical_ratio = 0.6 * unit(random);
  }
  return line;
}

// Of one element, by the law itself.
double VolumeFlow(const FlowElement& element, double p1, double p2) {
  return element.sonic_conductance_m3_per_s_pa * p1 * FlowFunction(p2 / p1, element.critical_ratio);
}

// Flow of a line from p1 to p2 by nested bisection on the pressure between the first element and
// the rest, with nothing but the law of one element.
double FlowByPressures(const FlowElement* element, std::size_t size, double p1, double p2) {
  if (size == 1) return VolumeFlow(*element, p1, p2);
  double low = p2;  // pressure behind the first element
  double high = p1;
  for (int i = 0; i < 48; ++i) {
    const double middle = 0.5 * (low + high);
    const bool first_gives_more =
        VolumeFlow(*element, p1, middle) > FlowByPressures(element + 1, size - 1, middle, p2);
    (first_gives_more ? low : high) = middle;
  }
  return VolumeFlow(*element, p1, 0.5 * (low + high));
}

// The single (C, b) that stands for a line: C = q*, and b by least squares from the subsonic points
// at 80, 60, 40 and 20 % of q* (the procedure of ISO 6358-3).
FlowElement Equivalent(const Series& series) {
  // With x = √(1 − (q/q*)²) the ellipse reads r − x = b·(1 − x): linear in b.
  double numerator = 0.0;
  double denominator = 0.0;
  for (const double share : {0.8, 0.6, 0.4, 0.2}) {
    const double x = std::sqrt(1.0 - share * share);
    const double ratio = RatioAtFlow(series, share * series.choked_flow_m3_per_s_pa);
    numerator += (ratio - x) * (1.0 - x);
    denominator += (1.0 - x) * (1.0 - x);
  }
  return {series.choked_flow_m3_per_s_pa, numerator / denominator};
}

void ExpectEquivalent(const Line& line, double conductance, double b) {
  const FlowElement equivalent = Equivalent(MakeSeries(line));
  EXPECT_NEAR(equivalent.sonic_conductance_m3_per_s_pa * 1e8, conductance, 0.005 * conductance);
  EXPECT_NEAR(equivalent.critical_ratio, b, 0.02);
}

TEST(Series, PublishedPairs) {
  const FlowElement valve{0.3e-8, 0.35}, tube{0.5e-8, 0.2}, equal{1e-8, 0.3};
  ExpectEquivalent({equal, equal}, 0.757, 0.200);
  ExpectEquivalent({valve, tube}, 0.283, 0.159);
  ExpectEquivalent({tube, valve}, 0.264, 0.279);
}

TEST(Series, TwoEqualElementsWithoutRecoveryGiveOneOverRootTwo) {
  const FlowElement element{1e-8, 0.0};
  const Series series = MakeSeries(Line{element, element});
  EXPECT_NEAR(series.choked_flow_m3_per_s_pa * 1e8, std::sqrt(0.5), 1e-14);
  EXPECT_EQ(series.choked_ratio, 0.0);
  EXPECT_NEAR(Equivalent(series).critical_ratio, 0.0, 1e-12);
  const Series reduced = MakeSeries(Line{element, element}, 0.79);
  EXPECT_NEAR(reduced.choked_flow_m3_per_s_pa * 1e8, 0.79 * std::sqrt(0.5), 1e-14);
}

TEST(Series, OneElementKeepsItsLaw) {
  for (const double m : {0.5, 0.6, 1.0}) {
    const FlowElement element{2e-8, 0.3, m};
    const Series series = MakeSeries(Line{element});
    EXPECT_EQ(series.choked_flow_m3_per_s_pa, 2e-8);
    EXPECT_EQ(series.choked_ratio, 0.3);
    for (const double r : {0.0, 0.3, 0.31, 0.5, 0.9, 0.999, 1.0}) {
      EXPECT_NEAR(FlowAtRatio(series, r), 2e-8 * FlowFunction(r, 0.3, m), 2e-8 * 1e-12);
    }
  }
}

TEST(Series, AgreesWithBisectionOnThePressures) {
  std::mt19937_64 random(11);
  for (int trial = 0; trial < 12; ++trial) {
    const Line line = RandomLine(random, 2 + trial % 2);
    const Series series = MakeSeries(line);
    for (const double r : {0.02, 0.3, 0.5, 0.7, 0.9, 0.98}) {
      const double expected = FlowByPressures(line.data(), line.size(), 3e5, r * 3e5) / 3e5;
      EXPECT_NEAR(FlowAtRatio(series, r), expected, 1e-8 * series.choked_flow_m3_per_s_pa);
    }
  }
}

TEST(Series, ChokedFlowIsTheLargestThatEveryElementPasses) {
  std::mt19937_64 random(12);
  const auto feasible = [](const Line& line, double flow) {
    double p = 1.0;
    for (const FlowElement& element : line) {
      const double z = flow / (element.sonic_conductance_m3_per_s_pa * p);
      if (z > 1.0) return false;
      p *= element.critical_ratio + (1.0 - element.critical_ratio) * std::sqrt(1.0 - z * z);
    }
    return true;
  };
  for (int trial = 0; trial < 2000; ++trial) {
    const Line line = RandomLine(random, 1 + trial % kMaxSeriesElements);
    const double q = MakeSeries(line).choked_flow_m3_per_s_pa;
    EXPECT_TRUE(feasible(line, q * (1.0 - 2e-14)));
    EXPECT_FALSE(feasible(line, q * (1.0 + 2e-14)));
  }
}

TEST(Series, FlowAtRatioInvertsRatioAtFlow) {
  std::mt19937_64 random(13);
  for (int trial = 0; trial < 500; ++trial) {
    Line line = RandomLine(random, 1 + trial % kMaxSeriesElements);
    if (trial % 3 == 0) line[0].subsonic_index = 0.6;
    const Series series = MakeSeries(line);
    const double q = series.choked_flow_m3_per_s_pa;
    EXPECT_EQ(FlowAtRatio(series, series.choked_ratio), q);
    EXPECT_EQ(RatioAtFlow(series, q), series.choked_ratio);
    EXPECT_EQ(RatioAtFlow(series, 0.0), 1.0);
    double previous = 1.0;
    for (const double share : {0.05, 0.3, 0.6, 0.9, 0.99, 0.9999}) {
      const double ratio = RatioAtFlow(series, share * q);
      EXPECT_LT(ratio, previous);
      previous = ratio;
      EXPECT_NEAR(FlowAtRatio(series, ratio), share * q, 1e-12 * q);
    }
  }
}

TEST(Series, SlopeAgreesWithFiniteDifferences) {
  std::mt19937_64 random(14);
  for (int trial = 0; trial < 200; ++trial) {
    Line line = RandomLine(random, 1 + trial % 5);
    if (trial % 4 == 0) line[0].subsonic_index = 0.7;
    const Series series = MakeSeries(line);
    for (const double share : {0.1, 0.5, 0.9}) {
      const double q = share * series.choked_flow_m3_per_s_pa;
      const double h = 1e-5 * q;
      const double difference = (RatioAtFlow(series, q + h) - RatioAtFlow(series, q - h)) / (2 * h);
      const RatioAndSlope both = RatioAndSlopeAtFlow(series, q);
      EXPECT_NEAR(both.ratio, RatioAtFlow(series, q), 1e-14);
      EXPECT_NEAR(both.slope_pa_s_per_m3, difference, 1e-6 * std::abs(difference));
    }
    EXPECT_TRUE(
        std::isinf(RatioAndSlopeAtFlow(series, series.choked_flow_m3_per_s_pa).slope_pa_s_per_m3));
  }
}

TEST(Series, BetterElementsNeverLowerTheFlow) {
  std::mt19937_64 random(15);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 3000; ++trial) {
    const Line line = RandomLine(random, 1 + trial % 6);
    Line better = line;
    FlowElement& element = better[random() % better.size()];
    if (trial % 2 == 0) {
      element.sonic_conductance_m3_per_s_pa *= 1.0 + unit(random);
    } else {
      element.critical_ratio += (0.9 - element.critical_ratio) * unit(random);
    }
    const Series before = MakeSeries(line);
    const Series after = MakeSeries(better);
    for (const double r : {0.0, 0.2, 0.4, 0.6, 0.8, 0.95}) {
      EXPECT_GE(FlowAtRatio(after, r), FlowAtRatio(before, r) * (1.0 - 1e-12));
    }
  }
}

}  // namespace series_test
}  // namespace plenum::model
