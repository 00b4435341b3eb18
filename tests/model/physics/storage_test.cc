#include "model/physics/storage.h"

#include <gtest/gtest.h>

#include <cmath>

namespace plenum::model {
namespace storage_test {

constexpr double kRoomK = 293.15;
constexpr double kLitre = 1e-3;

TEST(Battery, UsableEnergyIsFourFifthsOfTheNominal) {
  // 5 Ah at 14.8 V is 74 Wh.
  EXPECT_NEAR(UsableEnergy(5.0, 14.8), 0.8 * 74.0 * 3600.0, 1e-6);
}

TEST(Battery, VoltageRuleHoldsAtBothEdgesAndEndsThere) {
  EXPECT_TRUE(VoltageMatches(12.0, 12.0));
  EXPECT_TRUE(VoltageMatches(10.2, 12.0));
  EXPECT_TRUE(VoltageMatches(13.8, 12.0));
  EXPECT_FALSE(VoltageMatches(10.199, 12.0));
  EXPECT_FALSE(VoltageMatches(13.801, 12.0));
  EXPECT_TRUE(VoltageMatches(11.1, 12.0));   // 3 cells
  EXPECT_FALSE(VoltageMatches(14.8, 12.0));  // 4 cells
  EXPECT_TRUE(VoltageMatches(27.6, 24.0));
  EXPECT_TRUE(VoltageMatches(20.4, 24.0));
}

TEST(Cylinder, IdealGasOverstatesHighFills) {
  const auto overstated = [](double fill_pa) {
    const double ideal_kg = 1.0 * kLitre * fill_pa / (287.05 * kRoomK);
    return ideal_kg / CylinderCharge(1.0 * kLitre, fill_pa, kRoomK) - 1.0;
  };
  EXPECT_NEAR(overstated(200e5), 0.033, 0.001);
  EXPECT_NEAR(overstated(300e5), 0.109, 0.001);
  EXPECT_NEAR(overstated(100e5), -0.007, 0.001);
}

TEST(Cylinder, UsableGasIsWhatLeavesTheBottle) {
  constexpr double kVolume = 2.88 * kLitre, kFill = 139e5, kLeft = 11e5;
  const double kg = CylinderCharge(kVolume, kFill, kRoomK) - CylinderCharge(kVolume, kLeft, kRoomK);
  EXPECT_NEAR(CylinderUsableVolume(kVolume, kFill, kLeft, kRoomK) * kReferenceDensityKgPerM3, kg,
              1e-12);
  // 897 L need about 2.4 of them.
  EXPECT_NEAR(0.897 / CylinderUsableVolume(kVolume, kFill, kLeft, kRoomK), 2.4, 0.1);
}

TEST(Cylinder, HoldsMoreGasWhenColdAndNoneBelowItsLimit) {
  EXPECT_GT(CylinderUsableVolume(kLitre, 200e5, 10e5, 273.15),
            CylinderUsableVolume(kLitre, 200e5, 10e5, 293.15));
  EXPECT_EQ(CylinderUsableVolume(kLitre, 10e5, 10e5, kRoomK), 0.0);
  EXPECT_EQ(CylinderUsableVolume(kLitre, 5e5, 10e5, kRoomK), 0.0);
}

TEST(Co2, MassBecomesStandardLitres) {
  struct Cartridge {
    double grams, litres;
  };
  for (const Cartridge& c : {Cartridge{12, 6.65}, Cartridge{16, 8.86}, Cartridge{88, 48.7}})
    EXPECT_NEAR(Co2UsableVolume(c.grams * 1e-3, 0.0, 5e5, kRoomK) / kLitre, c.litres, 0.05)
        << c.grams << " g";
}

TEST(Co2, GasThatStaysInTheBottleIsNotUsable) {
  // 0.7 L of gas left at 6 bar and 20 °C is 4.2 L at 1 bar.
  const double full = Co2UsableVolume(0.5, 0.0, 6e5, kRoomK);
  EXPECT_NEAR((full - Co2UsableVolume(0.5, 0.7 * kLitre, 6e5, kRoomK)) / kLitre, 4.2, 1e-9);
  EXPECT_EQ(Co2UsableVolume(0.001, 10 * kLitre, 6e5, kRoomK), 0.0);
}

// Span and Wagner 1996, vapour pressure equation.
double SpanWagnerPa(double temperature_k) {
  const double tau = 1.0 - temperature_k / 304.1282;
  return 7.3773e6 * std::exp(304.1282 / temperature_k *
                             (-7.0602087 * tau + 1.9391218 * std::pow(tau, 1.5) -
                              1.6463597 * tau * tau - 3.2995634 * std::pow(tau, 4)));
}

TEST(Co2, SaturationPressureAtKnownTemperatures) {
  struct Point {
    double celsius, mpa;
  };
  for (const Point& p : {Point{-20, 1.97}, Point{0, 3.49}, Point{10, 4.50}, Point{20, 5.73},
                         Point{25, 6.43}, Point{30, 7.21}})
    EXPECT_NEAR(Co2SaturationPressure(273.15 + p.celsius) / 1e6, p.mpa, 0.006) << p.celsius;
  // 852 psi at 70 °F.
  EXPECT_NEAR(Co2SaturationPressure(294.26) / 6894.757, 852, 3);
}

TEST(Co2, SaturationPressureFollowsSpanAndWagnerBetweenThem) {
  for (double t = 243.15; t <= 304.12; t += 0.25)
    EXPECT_NEAR(Co2SaturationPressure(t) / SpanWagnerPa(t), 1.0, 2e-3) << t << " K";
}

TEST(Co2, SaturationPressureKeepsItsEndValuesOutside) {
  EXPECT_EQ(Co2SaturationPressure(200.0), Co2SaturationPressure(243.15));
  EXPECT_EQ(Co2SaturationPressure(320.0), Co2SaturationPressure(304.13));
  EXPECT_NEAR(Co2SaturationPressure(320.0), 7.377e6, 1e3);  // critical point
}

TEST(MadeReservoir, AgreesWithAThinWall) {
  // Half a litre at 1 MPa: 30 g, 75 g of least wall and 45 g for pressure.
  const MadeReservoir made = MakeReservoir(0.5 * kLitre, 1e6);
  EXPECT_NEAR(made.mass_kg, 0.150, 1e-12);
  EXPECT_NEAR(made.body_volume_m3, 0.550e-3, 1e-12);
  // Wall of a closed cylinder against hoop stress p·r/t ≤ σ/4: 2·ρ·p·V/(σ/4) in mass.
  const double wall_kg = MakeReservoir(kLitre, 1e6).mass_kg - MakeReservoir(kLitre, 0.0).mass_kg;
  EXPECT_NEAR(wall_kg, 2 * 2700.0 * 1e6 * kLitre / (240e6 / 4), 1e-12);
}

TEST(MadeReservoir, IsPositiveAndGrowsWithVolumeAndPressure) {
  for (double v = kMadeReservoirSmallestM3; v < kMadeReservoirLargestM3; v *= 2)
    for (double p = 0.0; p < kMadeReservoirPressureMaxGaugePa; p += 1e5) {
      const MadeReservoir made = MakeReservoir(v, p);
      EXPECT_GT(made.mass_kg, 0.0);
      EXPECT_GT(made.body_volume_m3, v);
      EXPECT_GT(MakeReservoir(v, p + 1e5).mass_kg, made.mass_kg);
      EXPECT_GT(MakeReservoir(2 * v, p).mass_kg, made.mass_kg);
      EXPECT_GT(MakeReservoir(2 * v, p).body_volume_m3, made.body_volume_m3);
    }
}

// Against the equation of its temperature, step by step.
TEST(Storage, AColdBottleGivesWhatCoolsItByTwentyKelvin) {
  for (const double mission_s : {10.0, 140.0, 1000.0, 1e5}) {
    const double endless = 3e-6, empty_kg = 0.04, co2_kg = 0.012;
    const double draw = Co2Draw(endless, empty_kg, co2_kg, mission_s);
    const double loss_w_per_k = endless * 274e3 / 20.0;
    double cooled_k = 0.0;
    constexpr int kSteps = 200000;
    for (int i = 0; i < kSteps; ++i)
      cooled_k += mission_s / kSteps * (draw * 274e3 - loss_w_per_k * cooled_k) /
                  (empty_kg * 460.0 + 0.5 * co2_kg * 3000.0);
    EXPECT_NEAR(cooled_k, 20.0, 0.01) << mission_s;
    EXPECT_GE(draw, endless);
  }
  // 2.7 g in 140 s, 1.5 standard litres, come out of a cartridge of 12 g.
  EXPECT_GT(Co2Draw(3e-6, 0.04, 0.012, 140.0) * 140.0, 1.5e-3);
}

}  // namespace storage_test
}  // namespace plenum::model
