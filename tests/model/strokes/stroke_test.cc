#include "model/strokes/stroke.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

#include "model/strokes/closed_form.h"

namespace plenum::model {
namespace stroke_test {

using Line = std::vector<FlowElement>;

const Line kFourElements = {{0.4e-8, 0.35}, {0.5e-8, 0.2}, {0.9e-8, 0.5}, {0.6e-8, 0.1}};

Chamber TestChamber(double expansion = 2.0, double operating_pa = 2e5) {
  Chamber chamber;
  chamber.rest_volume_m3 = 50e-6;
  chamber.expansion_ratio = expansion;
  chamber.operating_pressure_pa = operating_pa;
  return chamber;
}

Chamber TableChamber() {
  Chamber chamber = TestChamber();
  chamber.dead_volume_m3 = 4e-6;
  chamber.volume_curve =
      MonotoneCurve({0.9e5, 1.2e5, 1.5e5, 1.8e5, 2.1e5}, {48e-6, 55e-6, 80e-6, 95e-6, 101e-6});
  return chamber;
}

// Time for the content of `chamber` to reach that of `to`, by Runge–Kutta 4 in time on the content;
// the last step is cut by the secant through cubic Hermite data. `inflow(p)` in m³/s ANR.
template <class Inflow>
double TimeByRungeKutta(const Chamber& chamber, double from, double to, double step,
                        const Inflow& inflow) {
  const auto rate = [&](double p) { return 1e5 * inflow(p) / ContentSlope(chamber, p); };
  double p = from;
  double t = 0.0;
  while (true) {
    const double k1 = rate(p);
    const double k2 = rate(p + 0.5 * step * k1);
    const double k3 = rate(p + 0.5 * step * k2);
    const double k4 = rate(p + step * k3);
    const double next = p + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    if ((next - to) * (to - from) >= 0.0) {
      double low = 0.0, high = 1.0;
      const double slope_1 = step * k1;
      const double slope_2 = step * rate(next);
      for (int i = 0; i < 60; ++i) {
        const double s = 0.5 * (low + high);
        const double value = p * (1 + 2 * s) * (1 - s) * (1 - s) + slope_1 * s * (1 - s) * (1 - s) +
                             next * s * s * (3 - 2 * s) + slope_2 * s * s * (s - 1);
        ((value - to) * (to - from) < 0.0 ? low : high) = s;
      }
      return t + low * step;
    }
    p = next;
    t += step;
  }
}

TEST(Stroke, OneElementReproducesTheClosedForm) {
  constexpr double kRows[][4] = {
      {3.0, 2.0, 2.0, 0.30}, {2.2, 2.0, 2.0, 0.30}, {1.5, 1.3, 1.2, 0.20}, {6.0, 2.0, 1.0, 0.30},
      {6.0, 5.0, 1.5, 0.30}, {2.0, 1.7, 1.5, 0.60}, {2.0, 2.0, 1.5, 0.00}, {8.0, 6.0, 1.5, 0.00}};
  for (const auto& [source, operating, expansion, b] : kRows) {
    SCOPED_TRACE(source);
    const Chamber chamber = TestChamber(expansion, operating * 1e5);
    const double conductance = 2e-8;
    const Series line = MakeSeries(Line{{conductance, b}});
    const double c = conductance * 1e5 / chamber.rest_volume_m3;
    const NormalisedStroke stroke{operating, expansion, b};
    EXPECT_NEAR(c * FillTime(line, chamber, source * 1e5, 1e5, operating * 1e5),
                NormalisedRiseTime(stroke, source, 1.0, operating), 1e-8);
    const double end = 1.0 + 0.05 * (operating - 1.0);
    EXPECT_NEAR(c * EmptyTime(line, chamber, operating * 1e5, end * 1e5),
                NormalisedFallTime(stroke, operating, end), 1e-8);
    EXPECT_NEAR(c * EmptyTime(line, chamber, operating * 1e5, 1e5),
                NormalisedFallTime(stroke, operating, 1.0), 1e-8);
  }
}

TEST(Stroke, OneLitreTank) {
  Chamber tank = TestChamber(1.0, 701.3e3);
  tank.rest_volume_m3 = 1e-3;
  tank.ambient_pressure_pa = 101.3e3;
  const Series line = MakeSeries(Line{{1e-8, 0.3}});
  EXPECT_NEAR(FillTime(line, tank, 701.3e3, 101.3e3, 101.3e3 + 0.98 * 600e3), 1.100, 0.0055);
  EXPECT_NEAR(EmptyTime(line, tank, 701.3e3, 101.3e3 + 0.02 * 600e3), 1.976, 0.0099);
}

TEST(Stroke, AgreesWithRungeKuttaInTime) {
  const Series line = MakeSeries(kFourElements);
  for (const Chamber& chamber : {TestChamber(), TestChamber(1.0), TableChamber()}) {
    const double fill = TimeByRungeKutta(
        chamber, 1e5, 1.9e5, 1e-5, [&](double p) { return 3e5 * FlowAtRatio(line, p / 3e5); });
    EXPECT_NEAR(FillTime(line, chamber, 3e5, 1e5, 1.9e5), fill, 1e-8 * fill);
    const double empty = TimeByRungeKutta(
        chamber, 2e5, 1.05e5, 1e-5, [&](double p) { return -p * FlowAtRatio(line, 1e5 / p); });
    EXPECT_NEAR(EmptyTime(line, chamber, 2e5, 1.05e5), empty, 1e-8 * empty);
  }
}

TEST(Stroke, AgreesWithRungeKuttaUnderAFlowCap) {
  const Series line = MakeSeries(kFourElements);
  const double cap = 0.4 * 3e5 * line.choked_flow_m3_per_s_pa;
  const double uncapped = FillTime(line, TestChamber(), 3e5, 1e5, 2.9e5);
  const double capped = TimeByRungeKutta(TestChamber(), 1e5, 2.9e5, 1e-5, [&](double p) {
    return std::min(cap, 3e5 * FlowAtRatio(line, p / 3e5));
  });
  // The kink costs the reference its order there.
  EXPECT_NEAR(FillTime(line, TestChamber(), 3e5, 1e5, 2.9e5, kReferenceTemperatureK, cap), capped,
              1e-7 * capped);
  EXPECT_GT(capped, 1.3 * uncapped);
  EXPECT_EQ(FillTime(line, TestChamber(), 3e5, 1e5, 2e5, kReferenceTemperatureK, 1.0),
            FillTime(line, TestChamber(), 3e5, 1e5, 2e5));
  EXPECT_EQ(FillTime(line, TestChamber(), 3e5, 1e5, 2e5, kReferenceTemperatureK, 0.0), kNever);
}

TEST(Stroke, ReservoirAgreesWithRungeKuttaAndConservation) {
  const Series line = MakeSeries(kFourElements);
  const double reservoir = 0.4e-3;
  for (const Chamber& chamber : {TestChamber(), TableChamber()}) {
    const double total = 6e5 * reservoir + 3 * Content(chamber, 1e5);
    const double time = TimeByRungeKutta(chamber, 1e5, 2e5, 1e-5, [&](double p) {
      const double source = (total - 3 * Content(chamber, p)) / reservoir;
      return source * FlowAtRatio(line, p / source);
    });
    EXPECT_NEAR(FillTimeFromReservoir(line, chamber, 3, reservoir, 6e5, 1e5, 2e5), time,
                1e-8 * time);
  }
}

TEST(Stroke, HugeReservoirIsAConstantSource) {
  const Series line = MakeSeries(kFourElements);
  for (const double source : {2.05e5, 3e5, 6e5}) {
    const double constant = FillTime(line, TestChamber(), source, 1e5, 2e5);
    EXPECT_NEAR(FillTimeFromReservoir(line, TestChamber(), 2, 1e6, source, 1e5, 2e5), constant,
                1e-8 * constant);
  }
}

TEST(Stroke, ReservoirThatIsTooSmallNeverFills) {
  const Series line = MakeSeries(kFourElements);
  // One actuator takes 0.150 L ANR from 1 to 2 bar; 1 L at 2.15 bar just ends at 2 bar.
  EXPECT_EQ(FillTimeFromReservoir(line, TestChamber(), 1, 1e-3, 2.149e5, 1e5, 2e5), kNever);
  EXPECT_TRUE(
      std::isfinite(FillTimeFromReservoir(line, TestChamber(), 1, 1e-3, 2.151e5, 1e5, 2e5)));
}

TEST(Stroke, LimitsOfTheRange) {
  const Series line = MakeSeries(kFourElements);
  const Chamber chamber = TestChamber();
  EXPECT_EQ(FillTime(line, chamber, 3e5, 2e5, 2e5), 0.0);
  EXPECT_EQ(FillTime(line, chamber, 1.9e5, 1e5, 2e5), kNever);
  EXPECT_EQ(EmptyTime(line, chamber, 1e5, 1.5e5), 0.0);
  EXPECT_EQ(EmptyTime(line, chamber, 2e5, 0.99e5), kNever);
  const double full = FillTime(line, chamber, 2e5, 1e5, 2e5);
  EXPECT_TRUE(std::isfinite(full));
  EXPECT_NEAR(FillTime(line, chamber, 2e5, 1e5, 1.5e5) + FillTime(line, chamber, 2e5, 1.5e5, 2e5),
              full, 1e-9 * full);
}

TEST(Stroke, TableOfALineIsTheLinearLaw) {
  const Series line = MakeSeries(kFourElements);
  Chamber table = TestChamber();
  table.volume_curve = MonotoneCurve({1e5, 1.2e5, 1.7e5, 2e5}, {50e-6, 60e-6, 85e-6, 100e-6});
  const double fill = FillTime(line, TestChamber(), 4e5, 1e5, 2e5);
  EXPECT_NEAR(FillTime(line, table, 4e5, 1e5, 2e5), fill, 1e-9 * fill);
  const double empty = EmptyTime(line, TestChamber(), 9e5, 1e5);
  EXPECT_NEAR(EmptyTime(line, table, 9e5, 1e5), empty, 1e-9 * empty);
}

TEST(Stroke, HotterGasIsFasterByTheRootOfTemperature) {
  const double hot_k = 1.21 * kReferenceTemperatureK;
  const double cold = FillTime(MakeSeries(kFourElements), TestChamber(), 3e5, 1e5, 2e5);
  const double hot =
      FillTime(MakeSeries(kFourElements, 1.0 / 1.1), TestChamber(), 3e5, 1e5, 2e5, hot_k);
  EXPECT_NEAR(hot, cold / 1.1, 1e-12);
}

// ∫ W dp/Q by the midpoint rule in u, p = to + (from − to)·u², for any subsonic index.
TEST(Stroke, OtherSubsonicIndexAgreesWithMidpointRule) {
  for (const double m : {0.4, 0.6}) {
    for (const double to : {1.9e5, 1.9999e5}) {
      const Line elements = {{0.5e-8, 0.3, m}, {0.8e-8, 0.2}};
      const Series line = MakeSeries(elements);
      const Chamber chamber = TestChamber();
      constexpr int kPanels = 100000;
      double sum = 0.0;
      for (int i = 0; i < kPanels; ++i) {
        const double u = (i + 0.5) / kPanels;
        const double p = to + (1e5 - to) * u * u * u;
        sum += ContentSlope(chamber, p) / (1e5 * 2e5 * FlowAtRatio(line, p / 2e5)) * 3.0 * u * u;
      }
      sum *= (to - 1e5) / kPanels;
      EXPECT_NEAR(FillTime(line, chamber, 2e5, 1e5, to), sum, 1e-7 * sum);
    }
  }
  const Series linear = MakeSeries(Line{{1e-8, 0.3, 1.0}});
  EXPECT_EQ(FillTime(linear, TestChamber(), 2e5, 1e5, 2e5), kNever);
}

}  // namespace stroke_test
}  // namespace plenum::model
