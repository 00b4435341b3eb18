#include "catalog/fields/quantity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace {

using ::testing::HasSubstr;

// Expected values are the decimals that a person would write; equality is exact.
TEST(Quantity, ConvertsUnitsToThoseOfTheField) {
  const struct {
    const char* text;
    const char* field;
    double value;
  } cases[] = {
      {"6 bar", "pressure_max_kpa_gauge", 600},
      {"6bar(g)", "pressure_max_kpa_gauge", 600},
      {" 6.5 bar gauge ", "pressure_max_kpa_gauge", 650},
      {"0.7 MPa", "pressure_max_kpa_gauge", 700},
      {"500 mbar", "pressure_max_kpa_gauge", 50},
      {"100 psi", "pressure_max_kpa_gauge", 689.4757293168361},
      {"150 psig", "pressure_max_kpa_gauge", 1034.2135939752541},
      {"100000 Pa", "pressure_max_kpa_gauge", 100},
      {"120 L/min", "flow_max_l_per_min_anr", 120},
      {"120 l/min (ANR)", "flow_max_l_per_min_anr", 120},
      {"2 L/s", "flow_sustained_l_per_min_anr", 120},
      {"6 m³/h", "flow_max_l_per_min_anr", 100},
      {"0.25 in", "outer_diameter_mm", 6.35},
      {"1 cm", "outer_diameter_mm", 10},
      {"250 µm", "inner_diameter_mm", 0.25},
      {"12 V", "voltage_v", 12},
      {"3700 mV", "nominal_voltage_v", 3.7},
      {"350 g", "mass_kg", 0.35},
      {"50 mg", "mass_kg", 5e-5},
      {"16 oz", "mass_kg", 0.45359237},
      {"2 lb", "mass_kg", 0.90718474},
      {"9.19 g/m", "mass_kg_per_m", 0.00919},
      {"1.5 L", "internal_volume_ml", 1500},
      {"10 cc", "body_volume_ml", 10},
      {"1 in3", "body_volume_ml", 16.387064},
      {"750 ml", "water_volume_l", 0.75},
      {"2200 mAh", "capacity_ah", 2.2},
      {"850 mA", "current_max_a", 0.85},
      {"350 mW", "coil_power_w", 0.35},
      {"0.01 s", "response_time_ms", 10},
      {"19.9 EUR", "price_eur", 19.9},
      {"2 €", "price_eur", 2},
      {"0.5 EUR/m", "price_eur_per_m", 0.5},
      {"0.3 dm³/(s·bar)", "sonic_conductance_dm3_per_s_bar", 0.3},
      {"3e-9 m3/(s Pa)", "sonic_conductance_fill_dm3_per_s_bar", 0.3},
      {"30 L/(min bar)", "sonic_conductance_dm3_per_s_bar", 0.5},
      {"25 %", "duty_max", 0.25},
      {"25 mm", "_mm", 25},
      {"-1e2 g", "mass_kg", -0.1},
  };
  for (const auto& [text, field, value] : cases) {
    const Quantity quantity = ParseQuantity(text, field);
    ASSERT_TRUE(quantity.value) << text << ": " << quantity.error;
    EXPECT_DOUBLE_EQ(*quantity.value, value) << text;
  }
  EXPECT_EQ(ParseQuantity("350 g", "mass_kg").value, 0.35);  // to the last bit
  EXPECT_EQ(ParseQuantity("0.1", "mass_kg").value, 0.1);
}

TEST(Quantity, RefusesWhatItCannotConvert) {
  const struct {
    const char* text;
    const char* field;
  } cases[] = {
      {"6 bara", "pressure_max_kpa_gauge"},
      {"6 bar abs", "pressure_max_kpa_gauge"},
      {"6 kg", "pressure_max_kpa_gauge"},
      {"6 Bar", "pressure_max_kpa_gauge"},
      {"120 NL/min", "flow_max_l_per_min_anr"},
      {"120 L/min", "mass_kg"},
      {"12 v", "voltage_v"},
      {"1,5 kg", "mass_kg"},
      {"1.5.0 kg", "mass_kg"},
      {"kg", "mass_kg"},
      {"", "mass_kg"},
      {" ", "mass_kg"},
      {"inf g", "mass_kg"},
      {"nan", "mass_kg"},
      {"1e308 bar", "pressure_max_kpa_gauge"},
      {"1e999 g", "mass_kg"},
      {"4 pieces", "channels"},
      {"0x10", "mass_kg"},
  };
  for (const auto& [text, field] : cases) {
    const Quantity quantity = ParseQuantity(text, field);
    EXPECT_EQ(quantity.value, std::nullopt) << text;
    EXPECT_THAT(quantity.error, HasSubstr(std::string("\"") + text + "\""));
  }
  EXPECT_THAT(ParseQuantity("6 bara", "pressure_max_kpa_gauge").error, HasSubstr("kPa, Pa, mbar"));
}

TEST(Quantity, EveryFieldWithAUnitHasOneInItsName) {
  for (const Family& family : Families())
    for (const NumberField& field : family.numbers) {
      const std::string error = ParseQuantity("1 parsec", field.name).error;
      const std::set<std::string_view> bare{"channels", "cells_series", "duty_max", "stages",
                                            "stations"};
      const bool counts = bare.contains(field.name) || field.name.starts_with("critical_ratio");
      EXPECT_EQ(error.find("one of %;") != std::string::npos, counts) << field.name << error;
    }
}

}  // namespace
}  // namespace plenum::catalog
