// Price lists and sheets of shops: pumps of free flow and pressure, sizes, prices with currency and
// pack, headings of the trade. What they say was converted with a pocket calculator.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/tables/part_rows.h"
#include "catalog/tables/reading.h"
#include "tests/catalog/foreign_tables.h"

namespace plenum::catalog {
namespace price_list_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using namespace foreign_tables;

class PriceList : public testing::TestWithParam<ForeignTable> {};

TEST_P(PriceList, IsReadWithoutAnEdit) { ExpectReadWithoutAnEdit(GetParam()); }

const ForeignTable kPriceLists[] = {
    {"pumps_shop.csv",
     "compressor",
     {"boxer-dp-12a", "boxer-dp-24b"},
     {{0, "voltage_v", 12},
      {0, kPressure, 150},
      {0, "power_max_w", 10.8},
      {0, kMass, 0.185},
      {0, kBody, 105},
      {0, "price_eur", 48.5 / 1.17},
      {1, kBody, 214.2},
      {1, "power_max_w", 18}}},
    {"knf.csv",
     "compressor",
     {"knf-nms020-12", "knf-nmp830-24"},
     {{0, "voltage_v", 12},
      {0, kPressure, 100},
      {0, "power_max_w", 1.92},
      {0, kMass, 0.036},
      {0, kBody, 21.424},
      {1, kBody, 113.184}},
     BySetting({{"Typ", ""}}, {{"type", "diaphragm"}})},
    {"vacuum_pumps.csv",
     "vacuum_pump",
     {"xavitech-vp-35", "xavitech-vp-6"},
     {{0, "vacuum_max_kpa_gauge", -59.9390789340357},
      {0, "power_max_w", 3.6},
      {0, kBody, 36.8253563862979},
      {1, kBody, 49.4800842940392}}},
    {"packs_wh.csv",
     "battery",
     {"tattu-ta-1300-4s", "ansmann-2447-3049"},
     {{0, "nominal_voltage_v", 14.8},
      {0, "capacity_ah", 1.3},
      {0, "current_max_a", 97.5},
      {0, kMass, 0.155},
      {1, "nominal_voltage_v", 7.2},
      {1, "capacity_ah", 2.6},
      {1, "current_max_a", 5.2}}},
    {"cells_18650.csv",
     "battery",
     {"molicel-inr-18650-p26a", "samsung-inr18650-35e"},
     {{0, "cells_series", 1},
      {0, "nominal_voltage_v", 3.6},
      {0, "capacity_ah", 2.6},
      {0, "current_max_a", 35.1},
      {0, kMass, 0.045},
      {0, kBody, 17.7159059293056},
      {0, "price_eur", 3.95},
      {1, "current_max_a", 7.99},
      {1, "price_eur", 4.49}}},
    {"tubing_feet.csv",
     "tubing",
     {"freelin-wade-pu-14", "freelin-wade-pu-38"},
     {{0, kOuter, 6.35},
      {0, kInner, 4.064},
      {0, kPerMetre, 0.0068 / 0.3048},
      {0, kPressure, 999.739807508},
      {0, "price_eur_per_m", 1.2 / 1.17},
      {1, kInner, 6.35}}},
    {"tubing_rolls.tsv",
     "tubing",
     {"festo-pun-h-4x0-75", "festo-pan-6x1"},
     {{0, kInner, 2.6},
      {0, kPressure, 1000},
      {0, "price_eur_per_m", 1.05},
      {0, kPerMetre, 0.00871},  // π/4·(4² − 2.6²)·1200 kg/m³
      {1, kPerMetre, 0.016},
      {1, "price_eur_per_m", 0.96}}},
    {"valves_bohrung.csv",
     "valve",
     {"buerkert-6012-3", "buerkert-6012-2"},
     {{0, "sonic_conductance_fill_dm3_per_s_bar", 0.180955736846772},  // 0.16·π/4·1.2²
      {0, "sonic_conductance_exhaust_dm3_per_s_bar", 0.180955736846772},
      {0, "critical_ratio_fill", 0.3},
      {0, "coil_power_w", 4},
      {0, "pressure_min_kpa_gauge", 0},
      {0, kPressure, 1000},
      {0, kMass, 0.08},
      {0, kBody, 29.44},
      {1, "sonic_conductance_fill_dm3_per_s_bar", 0.0804247719318987}},
     BySetting({{"Bohrung (mm)", "sonic_conductance_fill_dm3_per_s_bar [orifice mm]"}}, {})},
    {"regulators_range.csv",
     "regulator",
     {"smc-itv1030-31", "smc-ir1000-01"},
     {{0, "inlet_pressure_min_kpa_gauge", 600},
      {0, "inlet_pressure_max_kpa_gauge", 1000},
      {0, "outlet_pressure_min_kpa_gauge", 5},
      {0, "outlet_pressure_max_kpa_gauge", 500},
      {0, "critical_ratio", 0.3},
      {0, kMass, 0.25},
      {0, kBody, 257.5},
      {1, "outlet_pressure_max_kpa_gauge", 200},
      {1, kMass, 0.14}}},
    {"fittings_us.csv",
     "fitting",
     {"parker-p4mc2", "parker-p6mc4"},
     {{0, "tube_outer_diameter_mm", 6.35},
      {0, kC, 2.34301538335},  // 0.16·π/4·4.318²
      {0, "critical_ratio", 0.5},
      {0, kMass, 0.0090718474},
      {0, kBody, 3.02},  // mass over 3 g/mL
      {0, kPressure, 2068.42718795},
      {0, "price_eur", 1.999 / 1.17},
      {1, "price_eur", 2.999 / 1.17}}},
    {"tanks_dollar.csv",
     "reservoir",
     {"viair-91014", "viair-91028"},
     {{0, kVolume, 3800},
      {0, kMass, 3.401942775},
      {0, kPressure, 1034.213593975},
      {0, kBody, 7173.68681336383},  // π/4·6.2²·14.5 in³
      {0, "price_eur", 89.95 / 1.17}}},
    {"packs_lipo.csv",
     "battery",
     {"tattu-ta-rl-1550-4s", "gens-ace-ga-b-2200-3s"},
     {{0, "cells_series", 4},
      {0, "capacity_ah", 1.55},
      {0, "current_max_a", 147.25},
      {0, kBody, 103.36},
      {0, kMass, 0.188},  // 0.00545 kg·(22.94 Wh)^0.9345·95^0.1346
      {0, "price_eur", 27.99 / 0.869},
      {1, "cells_series", 3},
      {1, kBody, 83.16}}},
};
INSTANTIATE_TEST_SUITE_P(Each, PriceList, testing::ValuesIn(kPriceLists));

TEST(PriceLists, APumpOfFreeFlowAndPressureHasTheCurveOfTheSeedsLaw) {
  const Read read = ReadAs("compressor", Bytes("foreign/pumps_shop.csv"));
  ASSERT_EQ(read.parts.size(), 2u);
  const Part& pump = read.parts[0];
  ASSERT_TRUE(pump.curve);
  const Curve& curve = *pump.curve;
  ASSERT_EQ(curve.points.size(), 11u);
  // A straight line from 8.5 L/min to 150 kPa, cut where the air's isothermal work, 100/60 W per
  // L/min times ln(1 + p/100 kPa), is above 0.3589 of 10.8 W.
  EXPECT_DOUBLE_EQ(curve.points[0].free_air_l_per_min, 8.5);
  EXPECT_DOUBLE_EQ(curve.points[4].pressure_kpa_gauge, 60);
  EXPECT_NEAR(curve.points[4].free_air_l_per_min, 4.9484, 1e-3);
  EXPECT_NEAR(curve.points[7].free_air_l_per_min, 2.55, 1e-12);
  EXPECT_DOUBLE_EQ(curve.points[10].free_air_l_per_min, 0);
  EXPECT_DOUBLE_EQ(curve.points[0].current_a, 0.45);
  EXPECT_DOUBLE_EQ(curve.points[10].current_a, 0.9);
  EXPECT_EQ(curve.free_air_provenance, Provenance::kEstimated);
  EXPECT_EQ(curve.free_air_uncertainty, 0.4);
  EXPECT_THAT(curve.free_air_source, HasSubstr("from 8.5 L/min and 150 kPa printed"));
  EXPECT_THAT(curve.current_source, HasSubstr("10.8 W at 12 V"));
  EXPECT_THAT(pump.numbers.at("power_max_w").source, HasSubstr("0.9 A printed"));
  EXPECT_EQ(pump.numbers.at("power_max_w").provenance, Provenance::kDerived);
  EXPECT_EQ(pump.numbers.at("duty_max").provenance, Provenance::kEstimated);
  EXPECT_EQ(pump.numbers.at(kBody).source, "V = l·w·h, 70 x 30 x 50 mm");
  EXPECT_EQ(pump.numbers.at(kBody).provenance, Provenance::kDerived);
}

TEST(PriceLists, APriceIsAnOfferWithItsCurrencyPackAndDate) {
  const auto offer = [](const char* family, const char* file, std::size_t part) {
    return ReadAs(family, Bytes(file)).parts.at(part).offers.at(0);
  };
  EXPECT_EQ(offer("compressor", "foreign/pumps_shop.csv", 0),
            (Offer{"not named", 48.5, "USD", 1, "", ""}));
  EXPECT_EQ(offer("battery", "foreign/cells_18650.csv", 0),
            (Offer{"nkon", 3.95, "EUR", 1, "2024-05-31", ""}));
  EXPECT_EQ(offer("battery", "foreign/cells_18650.csv", 1),
            (Offer{"akkuteile", 4.49, "EUR", 1, "2024-06", ""}));
  EXPECT_EQ(offer("tubing", "foreign/tubing_feet.csv", 1), (Offer{"mcm", 2.05, "USD", 1, "", ""}));
  EXPECT_EQ(offer("tubing", "foreign/tubing_rolls.tsv", 0),
            (Offer{"Landefeld", 52.5, "EUR", 50, "", ""}));
  EXPECT_EQ(offer("fitting", "foreign/fittings_us.csv", 1),
            (Offer{"not named", 29.99, "USD", 10, "", ""}));
  EXPECT_EQ(offer("reservoir", "foreign/tanks_dollar.csv", 1),
            (Offer{"Amazon", 109.95, "USD", 1, "", ""}));
}

TEST(PriceLists, WhatNoColumnGivesIsEstimatedWithTheErrorOfItsLaw) {
  const Read read = ReadAs("battery", Bytes("foreign/packs_lipo.csv"));
  ASSERT_EQ(read.parts.size(), 2u);
  const Number& mass = read.parts[0].numbers.at(kMass);
  EXPECT_EQ(mass.provenance, Provenance::kEstimated);
  EXPECT_EQ(mass.uncertainty, 0.19);
  EXPECT_THAT(mass.source, HasSubstr("regression: mass of a pack"));
  EXPECT_EQ(read.parts[0].numbers.at("cells_series").provenance, Provenance::kDerived);
  const Read fittings = ReadAs("fitting", Bytes("foreign/fittings_us.csv"));
  const Number& body = fittings.parts.at(0).numbers.at(kBody);
  EXPECT_EQ(body.uncertainty, 0.23);
}

TEST(PriceLists, WhatMayBeReadInTwoWaysIsRefusedWithTheQuestion) {
  const auto error = [](const std::string& header, const std::string& cell) {
    const Read read =
        ReadAs("silencer", "Maker;Model;Price (EUR);" + header + "\nA;B;1;" + cell + "\n");
    EXPECT_THAT(read.reading.questions, IsEmpty()) << read.reading.questions.at(0).text;
    return read.errors.empty() ? "" : read.errors[0].column + ": " + read.errors[0].detail;
  };
  EXPECT_THAT(error("Date", "5/6/2024"), HasSubstr("Date: is the month before or behind the day?"));
  EXPECT_EQ(error("Date", "5/31/2024"), "");
  EXPECT_THAT(error("Date", "31/5/24"), HasSubstr("must be a date like"));
  EXPECT_THAT(error("Size (mm)", "18.5 x 65"), HasSubstr("write ⌀ before the diameter"));
  EXPECT_EQ(error("Size (mm)", "⌀18.5 x 65"), "");
  EXPECT_THAT(error("Size (mm)", "70 x 30 x 50 x 2"), HasSubstr("must be three sides"));
  EXPECT_THAT(error("Pack qty", "10 of 12"), HasSubstr("must be a number of pieces"));
  EXPECT_THAT(error("Currency", "¥"), HasSubstr("currency must be one of"));
}

// 19.2 Wh at 7.4 V are 2.59… Ah.
TEST(PriceLists, ACellMayGiveTheEnergyOfAPack) {
  const Read read = ReadAs("battery",
                           "Maker,Part no,Chemistry,V,Capacity (Ah),Max. current (A),Weight (g)\n"
                           "SLS,X2,LiPo,7.4,19.2 Wh,20,120\n");
  ASSERT_EQ(read.parts.size(), 1u);
  const Number& capacity = read.parts[0].numbers.at("capacity_ah");
  EXPECT_NEAR(capacity.value, 19.2 / 7.4, 1e-12);
  EXPECT_EQ(capacity.provenance, Provenance::kDerived);
  EXPECT_EQ(capacity.source, "capacity = energy / nominal voltage, 19.2 Wh, 7.4 V");
}

// 12 and 24 are volts: as millivolts and as kilovolts no pump runs on them.
TEST(PriceLists, VoltagesAreVoltsWhereNothingElseIsInTheRangeOfTheField) {
  const auto questions = [](const std::string& first) {
    const Read read =
        ReadAs("battery", "Maker,Part no,Voltage,Capacity (Ah)\nA,1," + first + ",1\nA,2,12,1\n");
    std::vector<std::string> texts;
    for (const Question& question : read.reading.questions) texts.push_back(question.text);
    return texts;
  };
  EXPECT_THAT(questions("24"), IsEmpty());
  EXPECT_THAT(questions("12000"), testing::ElementsAre(HasSubstr("in which unit is")));
}

TEST(PriceLists, NormalLitresAreAskedForTheirTemperature) {
  const std::string table =
      "Maker,Part no,Voltage (V),Max. pressure (kPa),Flow (%)\nA,1,12,100,5\n";
  const auto with = [&](const std::string& unit) {
    std::string text = table;
    return text.replace(text.find('%'), 1, unit);
  };
  const Read open = ReadAs("compressor", with("Nl/min"));
  ASSERT_EQ(open.reading.questions.size(), 1u);
  EXPECT_THAT(open.reading.questions[0].text, HasSubstr("0 °C or at 20 °C"));
  EXPECT_EQ(open.reading.questions[0].answers,
            (std::vector<std::string>{"free_flow_l_per_min [Nl/min (0 °C)]",
                                      "free_flow_l_per_min [Nl/min (20 °C)]"}));
  TableOptions options;
  options.columns["Flow (Nl/min)"] = open.reading.questions[0].answers[0];
  EXPECT_THAT(ReadAs("compressor", with("Nl/min"), options).reading.questions, IsEmpty());
  EXPECT_THAT(ReadAs("compressor", with("NL/min (0 °C)")).reading.questions, IsEmpty());
}

TEST(PriceLists, APumpWithoutWhatItsCurveNeedsIsRefused) {
  const Read read = ReadAs("compressor", "Maker;SKU;Flow (l/min);Max pressure (bar)\nA;B;8;1,5\n");
  ASSERT_FALSE(read.errors.empty());
  EXPECT_EQ(HeadingOf(read.reading, read.errors[0].column), "Flow (l/min)");
  EXPECT_THAT(read.errors[0].detail, HasSubstr("needs voltage_v"));
}

struct Meaning {
  const char* family;
  const char* heading;
  const char* targets;  // FormatTarget, with '+' between them
};

TEST(Headings, OfForeignPriceListsAreKnown) {
  const Meaning kMeanings[] = {
      {"tubing", "ID (mm)", "inner_diameter_mm [mm]"},
      {"tubing", "ID (inch)", "inner_diameter_mm [inch]"},
      {"tubing", "I.D. [in]", "inner_diameter_mm [in]"},
      {"tubing", "Bohrung [mm]", "inner_diameter_mm [mm]"},
      {"tubing", "ID", ""},
      {"tubing", "PN (bar)", "pressure_max_kpa_gauge [bar]"},
      {"tubing", "PN", "part_number"},
      {"tubing", "g/ft", "mass_kg_per_m [g/ft]"},
      {"tubing", "Weight (lb/100 ft)", "mass_kg_per_m [lb/100 ft]"},
      {"tubing", "max psi", "pressure_max_kpa_gauge [psi]"},
      {"valve", "Max PSI", "pressure_max_kpa_gauge [PSI]"},
      {"valve", "SKU", "part_number"},
      {"valve", "Typ", "part_number"},
      {"valve", "P/N", "part_number"},
      {"valve", "Art.-Nr.", "part_number"},
      {"compressor", "Typ", "part_number+type"},
      {"compressor", "Type", "type"},
      {"compressor", "Max. flow (L/min)", "free_flow_l_per_min [L/min]"},
      {"compressor", "Power (W)", "power_max_w [W]"},
      {"vacuum_pump", "Ultimate vacuum (kPa)", "vacuum_max_kpa_gauge [kPa]"},
      {"battery", "C rating", "c_rate"},
      {"battery", "mAh", "capacity_ah [mAh]"},
      {"battery", "Wh", "energy_wh [Wh]"},
      {"battery", "Capacity (Wh)", "energy_wh [Wh]"},
      {"battery", "Kapazität [Wh]", "energy_wh [Wh]"},
      {"battery", "Energy (Wh)", "energy_wh [Wh]"},
      {"battery", "Capacity (Ah)", "capacity_ah [Ah]"},
      {"battery", "V", "nominal_voltage_v [V]"},
      {"compressor", "V", "voltage_v [V]"},
      {"reservoir", "V", ""},
      {"battery", "CDR (A)", "current_max_a [A]"},
      {"battery", "Diameter (mm)", "body_diameter_mm [mm]"},
      {"battery", "L x W x H (mm)", "body_size_mm [mm]"},
      {"fitting", "Maße (mm)", "body_size_mm [mm]"},
      {"fitting", "Diameter (mm)", "tube_outer_diameter_mm [mm]+body_diameter_mm [mm]"},
      {"tubing", "Price per m ($)", "offer_price [$]"},
      {"fitting", "Price ($)", "offer_price [$]"},
      {"fitting", "Preis [EUR]", "price_eur [EUR]"},
      {"fitting", "Stock", ""},
      {"fitting", "A", ""},
  };
  for (const auto& [family, heading, targets] : kMeanings) {
    std::string read;
    for (const Target& target : MatchHeading(*FindFamily(family), heading).targets)
      read += (read.empty() ? "" : "+") + FormatTarget(target);
    EXPECT_EQ(read, targets) << family << ": " << heading;
  }
}

}  // namespace price_list_test
}  // namespace plenum::catalog
