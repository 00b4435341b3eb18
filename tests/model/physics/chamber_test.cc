#include "model/physics/chamber.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

namespace plenum::model {
namespace chamber_test {

Chamber ExosuitChamber() {
  Chamber chamber;
  chamber.rest_volume_m3 = 50e-6;
  chamber.expansion_ratio = 2.0;
  chamber.operating_pressure_pa = 2e5;
  return chamber;
}

Chamber CurvedChamber() {
  Chamber chamber = ExosuitChamber();
  chamber.volume_curve =
      MonotoneCurve({0.9e5, 1.2e5, 1.5e5, 1.8e5, 2.1e5}, {48e-6, 55e-6, 80e-6, 95e-6, 101e-6});
  return chamber;
}

// Gas admitted from ambient to operating pressure, m³ ANR: the paper's air per actuation.
double AirPerActuation(const Chamber& chamber, double temperature_k) {
  return StandardVolume(Content(chamber, chamber.operating_pressure_pa) -
                            Content(chamber, chamber.ambient_pressure_pa),
                        temperature_k);
}

TEST(Chamber, AirPerActuationOfTheExosuit) {
  // 6 actuators × 1000 strokes × 50 mL·(2·2 − 1) = 900 standard litres.
  const double air = AirPerActuation(ExosuitChamber(), kReferenceTemperatureK);
  EXPECT_NEAR(air * 1e6, 150.0, 1e-9);
  EXPECT_NEAR(6.0 * 1000.0 * air, 0.9, 1e-12);
  EXPECT_NEAR(AirPerActuation(ExosuitChamber(), 2.0 * kReferenceTemperatureK) * 1e6, 75.0, 1e-9);
}

TEST(Chamber, LinearLawMeetsItsTwoPoints) {
  Chamber chamber = ExosuitChamber();
  chamber.expansion_ratio = 2.5;
  chamber.dead_volume_m3 = 3e-6;
  EXPECT_NEAR(Volume(chamber, 1e5), 53e-6, 1e-18);
  EXPECT_NEAR(Volume(chamber, 2e5), 128e-6, 1e-18);
  EXPECT_NEAR(Volume(chamber, 2.2e5), 143e-6, 1e-18);
}

TEST(Chamber, DeadVolumeTakesItsShareOfAir) {
  Chamber chamber = ExosuitChamber();
  chamber.dead_volume_m3 = 10e-6;
  EXPECT_NEAR(AirPerActuation(chamber, kReferenceTemperatureK) * 1e6, 160.0, 1e-9);
}

TEST(Chamber, ContentSlopeAgreesWithFiniteDifferences) {
  for (const Chamber& chamber : {ExosuitChamber(), CurvedChamber()}) {
    for (const double p : {0.8e5, 1.0e5, 1.3e5, 1.64e5, 1.99e5, 2.3e5}) {
      const double h = 1.0;
      const double difference = (Content(chamber, p + h) - Content(chamber, p - h)) / (2.0 * h);
      EXPECT_NEAR(ContentSlope(chamber, p), difference, 1e-8 * difference);
    }
  }
}

TEST(Chamber, TableOfALineIsTheLinearLaw) {
  const Chamber linear = ExosuitChamber();
  Chamber table = linear;
  table.volume_curve = MonotoneCurve({1e5, 1.2e5, 1.7e5, 2e5}, {50e-6, 60e-6, 85e-6, 100e-6});
  for (const double p : {0.9e5, 1e5, 1.1e5, 1.45e5, 2e5, 2.4e5}) {
    EXPECT_NEAR(Content(table, p), Content(linear, p), 1e-12 * Content(linear, p));
    EXPECT_NEAR(ContentSlope(table, p), ContentSlope(linear, p), 1e-12 * ContentSlope(linear, p));
  }
}

TEST(Chamber, SaysWhyItIsInvalid) {
  EXPECT_EQ(WhyInvalid(ExosuitChamber()), "");
  EXPECT_EQ(WhyInvalid(CurvedChamber()), "");
  const auto reason = [](auto change) {
    Chamber chamber = ExosuitChamber();
    change(chamber);
    return WhyInvalid(chamber);
  };
  const auto contains = [](const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(reason([](Chamber& c) { c.rest_volume_m3 = 0.0; }), "rest_volume_m3 is 0"));
  EXPECT_TRUE(
      contains(reason([](Chamber& c) { c.expansion_ratio = 0.5; }), "expansion_ratio is 0.5"));
  EXPECT_TRUE(contains(reason([&](Chamber& c) { c.expansion_ratio = nan; }), "expansion_ratio"));
  EXPECT_TRUE(
      contains(reason([](Chamber& c) { c.operating_pressure_pa = 1e5; }), "operating_pressure_pa"));
  EXPECT_TRUE(contains(reason([](Chamber& c) { c.dead_volume_m3 = -1e-6; }), "dead_volume_m3"));
  EXPECT_TRUE(
      contains(reason([](Chamber& c) { c.ambient_pressure_pa = 0.0; }), "ambient_pressure_pa"));
  const auto table = [&](std::vector<double> p, std::vector<double> v) {
    return reason([&](Chamber& c) { c.volume_curve = MonotoneCurve(p, v); });
  };
  EXPECT_TRUE(contains(table({1.1e5, 2e5}, {1e-5, 2e-5}), "first pressure"));
  EXPECT_TRUE(contains(table({1e5, 1.9e5}, {1e-5, 2e-5}), "last pressure"));
  EXPECT_TRUE(contains(table({1e5, 2e5}, {2e-5, 1e-5}), "volume"));
  EXPECT_TRUE(contains(table({1e5, 2e5}, {0.0, 1e-5}), "volume"));
}

}  // namespace chamber_test
}  // namespace plenum::model
