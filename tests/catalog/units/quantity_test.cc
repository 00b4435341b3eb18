#include "catalog/units/quantity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "catalog/fields/fields.h"

namespace plenum::catalog {
namespace quantity_test {

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

TEST(Quantity, ReadsTheUnitsOfPriceLists) {
  const struct {
    const char* text;
    const char* field;
    double value;
  } cases[] = {
      {"6.8 g/ft", "mass_kg_per_m", 0.0223097112860892},
      {"1.5 lb/100 ft", "mass_kg_per_m", 0.0223224591535433},
      {"0.24 oz/ft", "mass_kg_per_m", 0.0223224591535433},
      {"1.2 kg/100 m", "mass_kg_per_m", 0.012},
      {"2 lbs", "mass_kg", 0.90718474},
      {"45 grams", "mass_kg", 0.045},
      {"5 kg/cm2", "pressure_max_kpa_gauge", 490.3325},
      {"12 V DC", "voltage_v", 12},
      {"8 LPM", "flow_max_l_per_min_anr", 8},
      {"0.25 inches", "outer_diameter_mm", 6.35},
  };
  for (const auto& [text, field, value] : cases) {
    const Quantity quantity = ParseQuantity(text, field);
    ASSERT_TRUE(quantity.value) << text << ": " << quantity.error;
    EXPECT_NEAR(*quantity.value, value, 1e-12 * value) << text;
  }
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

// Expected values were taken from NIST SP 811 (2008), appendix B.8, and worked out by hand.
TEST(Quantity, ReadsTheUnitsOfRequests) {
  const struct {
    const char* text;
    const char* field;
    double value;
  } cases[] = {
      {"15 psi", "operating_pressure_kpa_gauge", 103.4213594},
      {"-20 inHg", "pressure_kpa_gauge", -67.7277728},
      {"\u2212300 mmHg", "pressure_kpa_gauge", -39.9967162},
      {"50 cmH2O", "pressure_kpa_gauge", 4.903325},
      {"2 bar(g)", "pressure_kpa_gauge_max", 200},
      {"1013.25 mbar", "pressure_kpa_abs", 101.325},
      {"14.7 psia", "pressure_kpa_abs", 101.3529321},
      {"29.92 inHg", "pressure_kpa_abs", 101.3207481},
      {"1 psi", "half_width_kpa", 6.894757293},
      {"200 ms", "rise_time_s_max", 0.2},
      {"2 min", "t_end_s", 120},
      {"6 1/min", "frequency_hz", 0.1},
      {"30 per minute", "frequency_hz", 0.5},
      {"12 rpm", "frequency_hz", 0.2},
      {"90 per hour", "frequency_hz", 0.025},
      {"every 4 s", "frequency_hz", 0.25},
      {"Every 0,5 min", "frequency_hz", 1.0 / 30},
      {"once every minute", "frequency_hz", 1.0 / 60},
      {"2 hours", "t_end_s", 7200},
      {"500 mHz", "frequency_hz", 0.5},
      {"20 °C", "temperature_k", 293.15},
      {"20 degC", "temperature_k", 293.15},
      {"68 °F", "temperature_k", 293.15},
      {"20 in", "tube_length_m", 0.508},
      {"2 ft", "tube_length_m", 0.6096},
      {"1/4 in", "inner_diameter_mm", 6.35},
      {"3/32\"", "inner_diameter_mm", 2.38125},
      {"1 in2", "effective_area_mm2", 645.16},
      {"10 scfm", "flow_l_per_min_anr_max", 283.16846592},
      {"100 Nl/min (20 °C)", "flow_l_per_min_anr_max", 100},
      {"100 Nl/min (0 °C)", "flow_l_per_min_anr_max", 108.7440005},
      {"100 NL/min, 0 °C", "flow_l_per_min_anr_max", 108.7440005},
      {"100 NL/min, 20 °C", "flow_l_per_min_anr_max", 100},
      {"6 Nm3/h at 0 °C", "flow_l_per_min_anr_max", 108.7440005},
      {"5 Hz", "natural_frequency_rad_per_s", 31.41592654},
      {"0.5 rad", "braid_angle_deg", 28.64788976},
      {"36 kJ", "energy_wh_max", 10},
      {"2 lb", "mass_kg_max", 0.90718474},
      {"0,5 s", "rise_time_s_max", 0.5},
      {"0,125 s", "rise_time_s_max", 0.125},
      {"12,5 mL", "rest_volume_ml", 12.5},
      {"1.250,5 mL", "rest_volume_ml", 1250.5},
      {"1,250.5 mL", "rest_volume_ml", 1250.5},
      {"1,250,000 mL", "rest_volume_ml", 1.25e6},
      {"1.500 mL", "rest_volume_ml", 1.5},
  };
  const QuantityContext asked{.ambient_kpa_abs = {}, .needs_unit = true};
  for (const auto& [text, field, value] : cases) {
    const Quantity quantity = ParseQuantity(text, field, asked);
    ASSERT_TRUE(quantity.value) << text << ": " << quantity.error;
    EXPECT_NEAR(*quantity.value, value, 1e-6 * std::abs(value)) << text;
  }
}

TEST(Quantity, MakesAbsolutePressuresGaugeByTheAmbientOnly) {
  const QuantityContext high_up{.ambient_kpa_abs = 80.0, .needs_unit = true};
  for (const char* text : {"1.8 bar abs", "1.8 bara", "1.8 bar(a)", "180 kPa abs", "180 kPa (a)",
                           "26.10679279 psia", "180kPaa"})
    EXPECT_NEAR(ParseQuantity(text, "pressure_kpa_gauge", high_up).value.value_or(0), 100, 1e-6)
        << text;
  for (const char* text : {"1 bar", "1 barg", "1 bar (g)", "100 kPa gauge", "14.5037738 psig"})
    EXPECT_NEAR(ParseQuantity(text, "pressure_kpa_gauge", high_up).value.value_or(0), 100, 1e-6)
        << text;
  EXPECT_THAT(ParseQuantity("2 bara", "pressure_kpa_gauge").error, HasSubstr("needs an ambient"));
  EXPECT_THAT(ParseQuantity("2 barg", "pressure_kpa_abs").error, HasSubstr("is absolute"));
  EXPECT_FALSE(ParseQuantity("2 psig", "half_width_kpa").value);
}

TEST(Quantity, RefusesWhatMayMeanTwoThings) {
  const QuantityContext asked{.ambient_kpa_abs = {}, .needs_unit = true};
  EXPECT_THAT(ParseQuantity("1,500 mL", "rest_volume_ml", asked).error, HasSubstr("the comma"));
  EXPECT_THAT(ParseQuantity("100 Nl/min", "flow_l_per_min_anr_max", asked).error,
              HasSubstr("0 °C or at 20 °C"));
  EXPECT_THAT(ParseQuantity("100", "rest_volume_ml", asked).error, HasSubstr("unit is missing"));
  for (const char* text : {"5 s", "5 psi", "5 Nl/min (15 °C)", "5 Nscfm (0 °C)", "1,5,0 mL",
                           "1.50.0 mL", ", mL", "5e mL", "1/0 mL", "--5 mL"})
    EXPECT_FALSE(ParseQuantity(text, "rest_volume_ml", asked).value) << text;
}

TEST(Quantity, KnowsTheUnitOfAName) {
  EXPECT_EQ(UnitOf("source_pressure_kpa_gauge_max"), "kPa gauge");
  EXPECT_EQ(UnitOf("free_air_l_per_min"), "L/min");
  EXPECT_EQ(UnitOf("viscous_pa2_s_per_kg"), "Pa²·s/kg");
  for (const char* name : {"count", "critical_ratio", "cylinders_max", "co2_max", "to_fraction"})
    EXPECT_EQ(UnitOf(name), "") << name;
}

TEST(Quantity, NamesItsUnitsAsTheyAreWritten) {
  EXPECT_EQ(UnitNames("sonic_conductance_dm3_per_s_bar"),
            "dm3/(s·bar), L/(s·bar), L/(min·bar), m3/(s·Pa)");
  EXPECT_EQ(UnitNames("frequency_hz"), "Hz, mHz, kHz, 1/min");
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

}  // namespace quantity_test
}  // namespace plenum::catalog
