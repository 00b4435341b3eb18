// Whether energy per air falls anywhere, against millions of looks, also where the dip is narrow.
#include "optimizer/pump/pump_slope.h"

#include <gtest/gtest.h>

#include "tests/support/random_parts.h"

namespace plenum::test {
namespace pump_slope_test {

// The least slope of current over delivery on a fine grid, of what it is in the mean.
double LeastSlope(const model::CompressorCurve& curve, double low_pa, double high_pa) {
  constexpr int kLooks = 200'000;
  double least = 1e300;
  for (int i = 0; i < kLooks; ++i) {
    const double pa = low_pa + (high_pa - low_pa) * (i + 0.5) / kLooks;
    const double flow = curve.free_air_m3_per_s(pa), current = curve.current_a(pa);
    const double slope =
        (curve.current_a.Slope(pa) * flow - current * curve.free_air_m3_per_s.Slope(pa)) /
        (flow * flow);
    least = std::min(least, slope);
  }
  const double mean = curve.current_a(low_pa) / curve.free_air_m3_per_s(low_pa);
  return least * (high_pa - low_pa) / mean;
}

// Rises, then falls by `drop` of itself between two points, and rises again.
model::CompressorCurve Dipping(double drop) {
  model::CompressorCurve curve;
  curve.voltage_v = 12.0;
  const std::vector<double> x{1.0e5, 1.4e5, 1.8e5, 2.2e5, 2.6e5, 3.0e5};
  curve.free_air_m3_per_s = {x, {1.0e-4, 0.9e-4, 0.8e-4, 0.68e-4, 0.5e-4, 0.2e-4}};
  curve.current_a = {x, {0.5, 0.8, 1.0, 1.0 - drop, 1.1, 1.2}};
  curve.pressure_max_pa = 3.0e5;
  return curve;
}

TEST(PumpSlopeTest, ANarrowDipIsSeen) {
  double rises = 0.0, falls = 0.4;  // of the drop
  while (falls - rises > 1e-6) {
    const double drop = 0.5 * (rises + falls);
    (LeastSlope(Dipping(drop), 1.0e5, 3.0e5) >= 0.0 ? rises : falls) = drop;
  }
  EXPECT_GT(rises, 0.01);
  EXPECT_TRUE(optimizer::EnergyPerAirRises(Dipping(rises - 1e-5), 1.0e5, 3.0e5));
  EXPECT_FALSE(optimizer::EnergyPerAirRises(Dipping(falls + 1e-5), 1.0e5, 3.0e5));
}

TEST(PumpSlopeTest, AsManyLooksSayOfDrawnPumps) {
  int rising = 0, falling = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    CatalogueSize size;
    model::CompressorCurve curve = RandomParts(random, size).compressors[0].curve;
    if (seed % 3 != 0) MakePowerFall(random, curve);
    const double low_pa = curve.free_air_m3_per_s.front();
    const double high_pa = 0.98 * model::HighestPressure(curve);
    if (curve.current_a.empty()) continue;
    const double least = LeastSlope(curve, low_pa, high_pa);
    if (std::abs(least) < 1e-6) continue;
    EXPECT_EQ(optimizer::EnergyPerAirRises(curve, low_pa, high_pa), least > 0.0) << least;
    (least > 0.0 ? rising : falling)++;
  }
  EXPECT_GT(rising, 5);
  EXPECT_GT(falling, 5);
}

}  // namespace pump_slope_test
}  // namespace plenum::test
