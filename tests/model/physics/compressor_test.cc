#include "model/physics/compressor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace plenum::model {
namespace compressor_test {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPsi = 6894.757293168;                    // Pa
constexpr double kCubicFootPerMinute = 0.0283168466 / 60;  // m³/s
constexpr double kAmbientPa = 1e5;

// VIAIR 90C at 12 V as measured by a robotics team, 0 to 110 psi gauge in steps of 10.
const std::vector<double> kCfm{0.88, 0.50, 0.43, 0.36, 0.30, 0.27,
                               0.25, 0.24, 0.24, 0.23, 0.22, 0.22};
const std::vector<double> kAmpere{7, 8, 8, 9, 9, 9, 10, 10, 10, 11, 11, 10};

double AbsolutePa(double psi_gauge) { return kAmbientPa + psi_gauge * kPsi; }

CompressorCurve Viair() {
  std::vector<double> pressure, flow;
  for (std::size_t i = 0; i < kCfm.size(); ++i) {
    pressure.push_back(AbsolutePa(10.0 * static_cast<double>(i)));
    flow.push_back(kCfm[i] * kCubicFootPerMinute);
  }
  return {.free_air_m3_per_s = MonotoneCurve(pressure, flow),
          .current_a = MonotoneCurve(pressure, kAmpere),
          .voltage_v = 12.0,
          .pressure_max_pa = AbsolutePa(120)};
}

TEST(Compressor, ReproducesTheMeasuredIsothermalEfficiency) {
  const CompressorCurve pump = Viair();
  const auto efficiency = [&](double psi) {
    const double p = AbsolutePa(psi);
    return kAmbientPa * FreeAirDelivery(pump, p) * std::log(p / kAmbientPa) /
           ElectricalPower(pump, p);
  };
  EXPECT_NEAR(efficiency(10), 0.129, 0.0005);
  for (double psi = 20; psi <= 110; psi += 10) {
    EXPECT_GT(efficiency(psi), 0.16) << psi << " psi";
    EXPECT_LT(efficiency(psi), 0.195) << psi << " psi";
  }
}

TEST(Compressor, PassesThroughTheTableAndFallsBetweenItsPoints) {
  const CompressorCurve pump = Viair();
  for (std::size_t i = 0; i < kCfm.size(); ++i)
    EXPECT_NEAR(FreeAirDelivery(pump, AbsolutePa(10.0 * static_cast<double>(i))),
                kCfm[i] * kCubicFootPerMinute, 1e-15);
  double last = kInfinity;
  for (double psi = 0; psi <= 110; psi += 0.25) {
    const double flow = FreeAirDelivery(pump, AbsolutePa(psi));
    EXPECT_LE(flow, last * (1 + 1e-14)) << psi << " psi";
    EXPECT_GE(flow, 0.22 * kCubicFootPerMinute * (1 - 1e-14)) << psi << " psi";
    last = flow;
  }
}

TEST(Compressor, DeliversNothingPastTheEndOfTheTable) {
  const CompressorCurve pump = Viair();
  EXPECT_DOUBLE_EQ(HighestPressure(pump), AbsolutePa(110));
  EXPECT_GT(FreeAirDelivery(pump, AbsolutePa(110)), 0.0);
  EXPECT_EQ(FreeAirDelivery(pump, AbsolutePa(110.001)), 0.0);
  EXPECT_EQ(FreeAirDelivery(pump, AbsolutePa(500)), 0.0);
  EXPECT_DOUBLE_EQ(ElectricalPower(pump, AbsolutePa(500)), 120.0);
}

TEST(Compressor, DeliversNothingAtItsPressureLimit) {
  CompressorCurve pump = Viair();
  pump.pressure_max_pa = AbsolutePa(50);
  EXPECT_DOUBLE_EQ(HighestPressure(pump), AbsolutePa(50));
  EXPECT_GT(FreeAirDelivery(pump, AbsolutePa(49.999)), 0.0);
  EXPECT_EQ(FreeAirDelivery(pump, AbsolutePa(50)), 0.0);
}

TEST(Compressor, HoldsTheFirstPointBelowTheTable) {
  const CompressorCurve pump = Viair();
  EXPECT_DOUBLE_EQ(FreeAirDelivery(pump, 0.8 * kAmbientPa), 0.88 * kCubicFootPerMinute);
  EXPECT_DOUBLE_EQ(ElectricalPower(pump, 0.8 * kAmbientPa), 84.0);
}

TEST(Compressor, WithoutACurveGivesAndTakesNothing) {
  const CompressorCurve none;
  EXPECT_EQ(HighestPressure(none), 0.0);
  EXPECT_EQ(FreeAirDelivery(none, 2e5), 0.0);
  EXPECT_EQ(ElectricalPower(none, 2e5), 0.0);
  EXPECT_EQ(LargestCurrent(none, 1e5, 2e5), 0.0);
  EXPECT_EQ(EnergyToFill(none, 1e-3, 1e5, 2e5, 293.15), kInfinity);
}

TEST(Compressor, LargestCurrentSeesPointsInsideTheRange) {
  const CompressorCurve pump = Viair();
  EXPECT_DOUBLE_EQ(LargestCurrent(pump, AbsolutePa(0), AbsolutePa(110)), 11.0);
  EXPECT_DOUBLE_EQ(LargestCurrent(pump, AbsolutePa(0), AbsolutePa(10)), 8.0);
  EXPECT_DOUBLE_EQ(LargestCurrent(pump, AbsolutePa(20), AbsolutePa(30)), 9.0);
  EXPECT_DOUBLE_EQ(LargestCurrent(pump, AbsolutePa(200), AbsolutePa(300)), 10.0);
  double sampled = 0.0;
  for (double psi = 32; psi <= 73; psi += 0.01)
    sampled = std::max(sampled, ElectricalPower(pump, AbsolutePa(psi)) / 12.0);
  EXPECT_NEAR(LargestCurrent(pump, AbsolutePa(32), AbsolutePa(73)), sampled, 1e-3);
}

// Energy by stepping a reservoir through time: mass flow and power only.
double EnergyByStepping(const CompressorCurve& pump, double volume_m3, double low, double high,
                        double temperature_k) {
  constexpr int kSteps = 400'000;
  const double rise = (high - low) / kSteps;
  double energy = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double p = low + (i + 0.5) * rise;
    const double kg = rise * volume_m3 / (287.05 * temperature_k);
    const double kg_per_s = FreeAirDelivery(pump, p) * 1e5 / (287.05 * 293.15);
    energy += ElectricalPower(pump, p) * kg / kg_per_s;
  }
  return energy;
}

TEST(Compressor, EnergyToFillEqualsTheSumOverSmallSteps) {
  const CompressorCurve pump = Viair();
  struct Fill {
    double low_psi, high_psi, temperature_k;
  };
  for (const Fill& fill : {Fill{0, 110, 293.15}, Fill{0, 10, 293.15}, Fill{3.3, 47.1, 310.0},
                           Fill{-3, 20, 273.15}, Fill{71, 72, 293.15}}) {
    const double low = AbsolutePa(fill.low_psi), high = AbsolutePa(fill.high_psi);
    const double expected = EnergyByStepping(pump, 2e-3, low, high, fill.temperature_k);
    EXPECT_NEAR(EnergyToFill(pump, 2e-3, low, high, fill.temperature_k), expected, 1e-8 * expected)
        << fill.low_psi << " to " << fill.high_psi << " psi";
  }
}

TEST(Compressor, EnergyToFillIsAdditiveAndStopsWhereThePumpStops) {
  const CompressorCurve pump = Viair();
  const double a = AbsolutePa(5), b = AbsolutePa(33), c = AbsolutePa(110);
  const double whole = EnergyToFill(pump, 1e-3, a, c, 293.15);
  EXPECT_NEAR(EnergyToFill(pump, 1e-3, a, b, 293.15) + EnergyToFill(pump, 1e-3, b, c, 293.15),
              whole, 1e-9 * whole);
  EXPECT_EQ(EnergyToFill(pump, 1e-3, b, b, 293.15), 0.0);
  EXPECT_EQ(EnergyToFill(pump, 1e-3, c, a, 293.15), 0.0);
  EXPECT_EQ(EnergyToFill(pump, 1e-3, a, c + 1.0, 293.15), kInfinity);
}

TEST(Compressor, EnergyToFillIsInfiniteWhereTheTableEndsInNoFlow) {
  CompressorCurve pump;
  pump.free_air_m3_per_s = MonotoneCurve({1e5, 2e5, 3e5}, {1e-4, 5e-5, 0.0});
  pump.current_a = MonotoneCurve({1e5, 3e5}, {2.0, 4.0});
  pump.voltage_v = 12.0;
  pump.pressure_max_pa = 4e5;
  EXPECT_EQ(EnergyToFill(pump, 1e-3, 1e5, 3e5, 293.15), kInfinity);
  EXPECT_LT(EnergyToFill(pump, 1e-3, 1e5, 2.9e5, 293.15), kInfinity);
}

}  // namespace compressor_test
}  // namespace plenum::model
