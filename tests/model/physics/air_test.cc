#include "model/physics/air.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plenum::model {
namespace air_test {

// Choked mass flux of an ideal nozzle per stagnation pressure, times R: the standard volume flow
// up to a factor common to all gases.
double ChokedVolumeFlux(double gamma, double gas_constant) {
  return std::sqrt(gamma * gas_constant) *
         std::pow(2.0 / (gamma + 1.0), (gamma + 1.0) / (2.0 * (gamma - 1.0)));
}

TEST(Air, ReferenceDensity) { EXPECT_NEAR(ReferenceDensity(Gas::kAir), 1.188, 5e-4); }

TEST(Air, CarbonDioxideFlowsAsThroughAnIdealNozzle) {
  EXPECT_EQ(FlowFactor(Gas::kAir), 1.0);
  EXPECT_NEAR(FlowFactor(Gas::kCo2),
              ChokedVolumeFlux(1.29, kGasConstantCo2JPerKgK) /
                  ChokedVolumeFlux(1.4, kGasConstantAirJPerKgK),
              0.005);
}

TEST(Air, EveryGasFlowsAsThroughAnIdealNozzle) {
  const double air = ChokedVolumeFlux(1.4, kGasConstantAirJPerKgK);
  for (std::size_t k = 0; k < kGasNames.size(); ++k) {
    const Gas gas = static_cast<Gas>(k);
    const double constant = kReferencePressurePa / (ReferenceDensity(gas) * kReferenceTemperatureK);
    EXPECT_NEAR(FlowFactor(gas), ChokedVolumeFlux(HeatCapacityRatio(gas), constant) / air, 0.002)
        << kGasNames[k];
  }
  // Molar masses in kg/mol: as dense as these are at 20 °C and 100 kPa.
  EXPECT_NEAR(ReferenceDensity(Gas::kHelium), 4.0026e-3 * 1e5 / (8.31446 * 293.15), 1e-3);
  EXPECT_NEAR(ReferenceDensity(Gas::kArgon), 39.948e-3 * 1e5 / (8.31446 * 293.15), 1e-3);
}

TEST(Air, CarbonDioxideOfTheExosuitRun) {
  // 897 standard litres are 1.06 kg of air or 1.62 kg of CO2.
  EXPECT_NEAR(0.897 * ReferenceDensity(Gas::kAir), 1.06, 0.01);
  EXPECT_NEAR(0.897 * ReferenceDensity(Gas::kCo2), 1.62, 0.01);
}

TEST(Air, StandardVolumeCountsMass) {
  EXPECT_DOUBLE_EQ(StandardVolume(3e5 * 2e-3, kReferenceTemperatureK), 6e-3);
  EXPECT_DOUBLE_EQ(StandardVolume(3e5 * 2e-3, 2.0 * kReferenceTemperatureK), 3e-3);
}

TEST(Air, CompressibilityFollowsTheTable) {
  EXPECT_EQ(CompressibilityOfAir(0.9e5), 1.0);
  EXPECT_DOUBLE_EQ(CompressibilityOfAir(100e5), 0.993);
  EXPECT_DOUBLE_EQ(CompressibilityOfAir(150e5), 1.007);
  EXPECT_DOUBLE_EQ(CompressibilityOfAir(200e5), 1.033);
  EXPECT_NEAR(CompressibilityOfAir(250e5), 1.071, 1e-12);
  EXPECT_DOUBLE_EQ(CompressibilityOfAir(300e5), 1.109);
  EXPECT_EQ(CompressibilityOfAir(400e5), 1.109);
}

}  // namespace air_test
}  // namespace plenum::model
