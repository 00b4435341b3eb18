#include "api/catalogue/part_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "api/catalogue/catalogue_parts.h"
#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "catalog/fields/csv.h"
#include "catalog/fields/fields.h"
#include "tests/api/support.h"
#include "tests/catalog/samples.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace part_document_test {

using testing::HasSubstr;

TEST(Parts, RoundTripKeepsEveryNumberAndItsSource) {
  for (catalog::Part part : SmallCatalogue()) {
    part.notes = "from \"the\" shelf\n";
    if (!part.numbers.empty()) {
      part.numbers.begin()->second.value *= 1.0 + 1e-15;  // all digits survive
      part.numbers.begin()->second.provenance = catalog::Provenance::kEstimated;
    }
    const Json text = Parse(RenderPart(part).dump());
    const auto parsed = ParsePart(text);
    for (const Error& error : ErrorsOf(parsed))
      ADD_FAILURE() << part.family << error.pointer << ": " << error.detail;
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed));
    EXPECT_EQ(std::get<catalog::Part>(parsed), part) << text.dump(1);
  }
}

// The parts that the project ships: all can be shown, given back, and used by the search.
TEST(Parts, EverySeedPartRoundTripsAndConverts) {
  std::vector<catalog::Part> all;
  for (const catalog::Family& family : catalog::Families()) {
    std::ifstream file(test::SourceDir().string() + "/catalog/data/" + std::string(family.name) +
                       ".csv");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const catalog::CsvParts csv = catalog::ReadCsv(family.name, text);
    ASSERT_TRUE(csv.errors.empty()) << family.name << " " << csv.errors.front().detail;
    EXPECT_FALSE(csv.parts.empty()) << family.name;
    for (catalog::Part part : csv.parts) {
      part.origin = "user";
      const auto parsed = ParsePart(Parse(RenderPart(part).dump()));
      for (const Error& error : ErrorsOf(parsed))
        ADD_FAILURE() << part.id << error.pointer << ": " << error.detail;
      ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << part.id;
      EXPECT_EQ(std::get<catalog::Part>(parsed), part);
      all.push_back(std::move(part));
    }
  }
  const model::Parts parts = ToModelParts(all, {});
  EXPECT_EQ(
      parts.tubing.size() + parts.fittings.size() + parts.valves.size() + parts.compressors.size() +
          parts.batteries.size() + parts.cylinders.size() + parts.co2.size() +
          parts.regulators.size() + parts.reservoirs.size() + parts.vacuum_pumps.size() +
          parts.manifolds.size() + parts.ejectors.size() + parts.check_valves.size(),
      static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto& part) {
        const bool vacuum = part.family == "vacuum_pump" || part.family == "ejector";
        const auto knows = [&](const char* field) { return part.numbers.contains(field); };
        const bool checks = knows("mass_kg") && knows("body_volume_ml") &&
                            knows("sonic_conductance_dm3_per_s_bar") &&
                            knows("cracking_pressure_kpa_gauge") && knows("pressure_max_kpa_gauge");
        const bool complete = (!vacuum || StandsVacuum(part)) &&
                              (part.family != "manifold" || IsJoint(part)) &&
                              (part.family != "check_valve" || checks);
        return complete && UseInSearch(part.family, "price_eur") == "adds up";
      })));
}

TEST(Parts, RandomPartsWithDetailsRoundTrip) {
  std::mt19937 random(17);
  for (const catalog::Family& family : catalog::Families())
    for (int i = 0; i < 20; ++i) {
      const catalog::Part part = catalog::AnyPart(family, "p", random);
      const auto parsed = ParsePart(Parse(RenderPart(part).dump()));
      for (const Error& error : ErrorsOf(parsed))
        ADD_FAILURE() << part.family << error.pointer << ": " << error.detail;
      ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed));
      EXPECT_EQ(std::get<catalog::Part>(parsed), part);
    }
}

TEST(Parts, AnOfferMakesThePrice) {
  Json valve = RenderPart(PartOf("valve"));
  valve["price_eur"] = 1;
  valve["offers"] = Parse(R"([{"supplier": "Shop", "price": 25, "currency": "EUR", "pack": 10}])");
  const auto part = std::get<catalog::Part>(ParsePart(valve));
  EXPECT_EQ(part.numbers.at("price_eur").value, 2.5);
  EXPECT_EQ(part.numbers.at("price_eur").provenance, catalog::Provenance::kDerived);
}

TEST(Parts, DetailsThatAreMissingOrNullAreEmpty) {
  Json valve = RenderPart(PartOf("valve"));
  for (const char* field : {"series", "orderable", "aliases", "offers", "documents"})
    valve[field] = nullptr;
  const auto from_null = std::get<catalog::Part>(ParsePart(valve));
  for (const char* field : {"series", "orderable", "aliases", "offers", "documents"})
    valve.erase(field);
  const auto from_none = std::get<catalog::Part>(ParsePart(valve));
  EXPECT_EQ(from_null, from_none);
  EXPECT_EQ(from_none.series, "");
  EXPECT_FALSE(from_none.orderable);
}

TEST(Parts, RenderIsFlat) {
  const Json json = RenderPart(PartOf("compressor"));
  EXPECT_EQ(json["id"], "compressor-1");
  EXPECT_EQ(json["family"], "compressor");
  EXPECT_EQ(json["voltage_v"], 12.0);
  EXPECT_EQ(json["type"], "piston");
  EXPECT_EQ(json["curve"][1],
            Parse(R"({"pressure_kpa_gauge": 69.0, "free_air_l_per_min": 14.2, "current_a": 8.0})"));
  EXPECT_EQ(json["provenance"]["mass_kg"], Parse(R"({"kind": "datasheet", "source": "sheet 1"})"));
  EXPECT_EQ(json["provenance"]["current"]["kind"], "derived");
}

TEST(Parts, APartOfAUsersOwnNeedsNeitherIdNorProvenance) {
  Json json = RenderPart(PartOf("battery"));
  for (const char* field : {"id", "provenance", "notes", "origin"}) json.erase(field);
  json["manufacturer"] = "Turnigy Ltd.";
  json["part_number"] = "T5000/3S (XT60)";
  const auto parsed = ParsePart(json);
  ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed));
  const auto& part = std::get<catalog::Part>(parsed);
  EXPECT_EQ(part.id, "turnigy-ltd-t5000-3s-xt60");
  EXPECT_EQ(part.origin, "user");
  EXPECT_EQ(part.numbers.at("mass_kg"),
            (catalog::Number{0.4, catalog::Provenance::kThirdParty, "user"}));
}

// C 1.1, b 0.28 and 276 L/min are printed for one valve.
TEST(Parts, AConductanceMayBeGivenAsItIsPrinted) {
  const char* const name = "sonic_conductance_fill_dm3_per_s_bar";
  const auto read = [&](const Json& value) {
    Json json = With(RenderPart(PartOf("valve")), "/critical_ratio_fill", 0.28);
    json[name] = value;
    json["provenance"][name]["source"] = "sheet 7";
    return ParsePart(json);
  };
  for (const char* given :
       {R"({ "qn_l_per_min": 276, "at": "6 to 5 bar" })", R"({ "qn_l_per_min": "4.6 L/s" })",
        R"("Qn 276 L/min at 6 to 5 bar")", R"("Qn 253.807 Nl/min at 0 °C")"}) {
    const auto parsed = read(Parse(given));
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << given;
    const catalog::Number& number = std::get<catalog::Part>(parsed).numbers.at(name);
    EXPECT_NEAR(number.value, 1.1, 0.005) << given;
    EXPECT_EQ(number.provenance, catalog::Provenance::kDerived);
    EXPECT_THAT(number.source, HasSubstr("L/min from 6 to 5 bar gauge, b 0.28; sheet 7"));
  }
  const auto error = [&](const char* wrong, const std::string& at) {
    return DetailAt(ErrorsOf(read(Parse(wrong))), std::string("/") + name + at);
  };
  EXPECT_THAT(error(R"({ "qn_l_per_min": 1, "cv": 1 })", ""), HasSubstr("must hold one of"));
  EXPECT_THAT(error(R"({})", ""), HasSubstr("must hold one of"));
  EXPECT_THAT(error(R"({ "qn_l_per_min": 1, "at": "5 to 6 bar" })", "/at"),
              HasSubstr("must be like \"6 to 5 bar\""));
  EXPECT_THAT(error(R"({ "cv": 0.05, "at": "6 to 5 bar" })", "/at"), HasSubstr("unknown field"));
  EXPECT_THAT(error(R"({ "kv": -1 })", "/kv"), HasSubstr("must be ≥ 1e-6"));
  EXPECT_THAT(error(R"("Cv many")", ""), HasSubstr("is \"many\""));
}

TEST(Parts, ABodyMayBeGivenByItsSides) {
  const auto read = [](const char* value) {
    Json json = RenderPart(PartOf("battery"));
    json["body_volume_ml"] = Parse(value);
    json["provenance"]["body_volume_ml"]["source"] = "sheet 7";
    return ParsePart(json);
  };
  for (const auto& [given, value] :
       {std::pair{R"({ "length_mm": 70, "width_mm": "3 cm", "height_mm": 50 })", 105.0},
        std::pair{R"("70 x 30 x 50 mm")", 105.0},
        std::pair{R"({ "diameter_mm": 18.5, "length_mm": 65 })", 17.4721639},
        std::pair{R"("⌀18.5 x 65")", 17.4721639}}) {
    const auto parsed = read(given);
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << given;
    const catalog::Number& number = std::get<catalog::Part>(parsed).numbers.at("body_volume_ml");
    EXPECT_NEAR(number.value, value, 1e-6) << given;
    EXPECT_EQ(number.provenance, catalog::Provenance::kDerived);
    EXPECT_THAT(number.source, HasSubstr("V = ")) << given;
    EXPECT_THAT(number.source, HasSubstr("; sheet 7")) << given;
  }
  const auto error = [&](const char* wrong, const std::string& at) {
    return DetailAt(ErrorsOf(read(wrong)), "/body_volume_ml" + at);
  };
  EXPECT_THAT(error(R"("18.5 x 65 mm")", ""), HasSubstr("write ⌀ before the diameter"));
  EXPECT_THAT(error(R"({ "length_mm": 70, "width_mm": 0 , "height_mm": 5 })", "/width_mm"),
              HasSubstr("must be"));
  EXPECT_THAT(error(R"({ "length_mm": 70 })", "/width_mm"), HasSubstr("required"));
}

TEST(Parts, APumpMayBeGivenByItsFreeFlow) {
  const auto read = [](const Json& curve) {
    Json json = RenderPart(PartOf("compressor"));
    json["voltage_v"] = 12;
    json["pressure_max_kpa_gauge"] = 150;
    json["type"] = "diaphragm";
    json["curve"] = curve;
    json.erase("power_max_w");
    json.erase("power_min_w");
    json.erase("provenance");
    return ParsePart(json);
  };
  for (const char* given : {R"({ "free_flow_l_per_min": 8.5, "current_a": "900 mA" })",
                            R"("free flow 8.5 L/min, 0.9 A")"}) {
    const auto parsed = read(Parse(given));
    for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << given;
    const catalog::Part& pump = std::get<catalog::Part>(parsed);
    ASSERT_EQ(pump.curve->points.size(), 11u);
    EXPECT_EQ(pump.curve->points[0].free_air_l_per_min, 8.5);
    EXPECT_EQ(pump.curve->points[10].pressure_kpa_gauge, 150);
    EXPECT_EQ(pump.curve->points[10].current_a, 0.9);
    EXPECT_EQ(pump.curve->free_air_provenance, catalog::Provenance::kEstimated);
    EXPECT_TRUE(pump.curve->free_air_uncertainty);
    EXPECT_NEAR(pump.numbers.at("power_max_w").value, 10.8, 1e-12);
  }
  EXPECT_THAT(DetailAt(ErrorsOf(read(Parse(R"({ "free_flow_l_per_min": 0 })"))),
                       "/curve/free_flow_l_per_min"),
              HasSubstr("must be"));
  EXPECT_THAT(DetailAt(ErrorsOf(read("free flow much")), "/curve"), HasSubstr("free flow must"));
}

TEST(Parts, ACurrentMayBeGivenAsACRate) {
  for (const char* given : {R"({ "c_rate": 25 })", R"("25C")"}) {
    Json json = RenderPart(PartOf("battery"));
    json["capacity_ah"] = 2.2;
    json["current_max_a"] = Parse(given);
    const auto parsed = ParsePart(json);
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << given;
    EXPECT_NEAR(std::get<catalog::Part>(parsed).numbers.at("current_max_a").value, 55, 1e-12);
  }
}

// 19.2 Wh at the pack's nominal voltage; a C-rate is one of the capacity that this comes to.
TEST(Parts, ACapacityMayBeGivenAsAnEnergy) {
  for (const char* given : {R"({ "energy_wh": 19.2 })", R"("19.2 Wh")"}) {
    Json json = RenderPart(PartOf("battery"));
    json["nominal_voltage_v"] = 7.5;
    json["capacity_ah"] = Parse(given);
    json["current_max_a"] = "10C";
    const auto parsed = ParsePart(json);
    ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed)) << given;
    const auto& numbers = std::get<catalog::Part>(parsed).numbers;
    EXPECT_NEAR(numbers.at("capacity_ah").value, 2.56, 1e-12);
    EXPECT_NEAR(numbers.at("current_max_a").value, 25.6, 1e-12);
    EXPECT_THAT(numbers.at("capacity_ah").source,
                HasSubstr("capacity = energy / nominal voltage, 19.2 Wh, 7.5 V"));
  }
  Json json = RenderPart(PartOf("battery"));
  json.erase("nominal_voltage_v");
  json["capacity_ah"] = "19.2 Wh";
  EXPECT_THAT(DetailAt(ErrorsOf(ParsePart(json)), "/capacity_ah"), HasSubstr("nominal_voltage_v"));
}

TEST(Parts, NumbersMayCarryUnits) {
  Json json = RenderPart(PartOf("battery"));
  json["mass_kg"] = "400 g";
  json["capacity_ah"] = "5000 mAh";
  const auto parsed = ParsePart(json);
  ASSERT_TRUE(std::holds_alternative<catalog::Part>(parsed));
  EXPECT_EQ(std::get<catalog::Part>(parsed).numbers.at("mass_kg").value, 0.4);
  EXPECT_EQ(std::get<catalog::Part>(parsed).numbers.at("capacity_ah").value, 5.0);
  EXPECT_THAT(DetailAt(ErrorsOf(ParsePart(With(json, "/mass_kg", "0.4"))), "/mass_kg"),
              HasSubstr("the unit is missing"));
}

TEST(Parts, WhatTheServerSetsIsIgnored) {
  const auto parsed = ParsePart(With(RenderPart(PartOf("valve")), "/origin", "seed"));
  EXPECT_EQ(std::get<catalog::Part>(parsed).origin, "user");
}

TEST(Parts, NameEveryFieldThatIsWrong) {
  const Json valve = RenderPart(PartOf("valve"));
  const struct {
    const char* pointer;
    Json value;
    const char* detail;
  } cases[] = {
      {"/mass_kg", -1, "≥ 1e-6 and ≤ 500, not -1"},
      {"/mass_kg", "heavy", "number"},
      {"/channels", 0, "≥ 1"},
      {"/function", "4/2", "3/2, 2/2 pair, proportional or 2/2"},
      {"/manufacturer", "", "1 to 200"},
      {"/weight_kg", 1, "nearest known: "},
      {"/notes", 5, "text"},
      {"/provenance/mass_kg/kind", "guess",
       "datasheet, third_party, derived, estimated or measured"},
      {"/provenance/mass", Json::object(), "nearest known: mass_kg"},
      {"/provenance/mass_kg/source", 3, "text"},
      {"/provenance/mass_kg/source", std::string(5000, 'x'), "characters"},
      {"/id", "Ventil 1", "a-z"},
      {"/id", "custom", "made-to-measure"},
      {"/channels", 1.5, "whole number"},
      {"/provenance/mass_kg/uncertainty", 0, "≥ 1e-6 and ≤ 1"},
      {"/provenance/mass_kg/uncertainty", "five", "number"},
      {"/provenance/mass_kg/uncertainty", "500 %", "≥ 1e-6 and ≤ 1"},
      {"/series", 5, "text of at most 200"},
      {"/orderable", "yes", "true, false, or null"},
      {"/aliases", Parse(R"(["a", "a"])"), "listed twice"},
      {"/offers", Parse(R"([{"supplier": "S", "price": -1, "currency": "EUR"}])"), "≥ 0"},
      {"/offers", Parse(R"([{"supplier": "S", "price": 1, "currency": "XYZ"}])"), "EUR"},
      {"/offers", Parse(R"([{"supplier": "S", "price": 1, "currency": "EUR", "pack": 0}])"), "> 0"},
      {"/offers", Parse(R"([{"supplier": "S", "price": 1, "currency": "EUR", "date": "May"}])"),
       "like 2024"},
      {"/offers", Parse(R"([{"supplier": "S", "price": 1, "currency": "EUR", "curency": ""}])"),
       "nearest known: currency"},
      {"/documents", Parse(R"([{"sha256": "abc"}])"), "64 digits"},
      {"/documents", Parse("[{}]"), "link or a sha256"},
  };
  for (const auto& [pointer, value, detail] : cases) {
    const Errors errors = ErrorsOf(ParsePart(With(valve, pointer, value)));
    ASSERT_EQ(errors.size(), 1u) << pointer;
    EXPECT_THAT(errors[0].pointer, testing::StartsWith(pointer));  // or an item of a list there
    EXPECT_THAT(errors[0].detail, HasSubstr(detail));
  }
  const auto read = ParsePart(With(valve, "/provenance/mass_kg/uncertainty", "5 %"));
  EXPECT_EQ(std::get<catalog::Part>(read).numbers.at("mass_kg").uncertainty, 0.05);
  EXPECT_THAT(DetailAt(ErrorsOf(ParsePart(With(valve, "/family", "valves"))), "/family"),
              HasSubstr("valve"));
  EXPECT_EQ(ErrorsOf(ParsePart(Without(valve, "/family"))).front().pointer, "/family");
  EXPECT_EQ(ErrorsOf(ParsePart(Json::array())).front().pointer, "");
}

TEST(Parts, CatalogueRulesBecomePointers) {
  Json valve = RenderPart(PartOf("valve"));
  valve.erase("mass_kg");
  valve["provenance"].erase("mass_kg");
  valve.erase("port");
  valve["provenance"].erase("port");
  const Errors errors = ErrorsOf(ParsePart(valve));
  EXPECT_NE(DetailAt(errors, "/mass_kg"), "");
  EXPECT_NE(DetailAt(errors, "/port"), "");
  EXPECT_EQ(errors.size(), 2u);

  Json pump = RenderPart(PartOf("compressor"));
  pump["curve"][2]["free_air_l_per_min"] = 20;  // rises with pressure
  const Errors curve = ErrorsOf(ParsePart(pump));
  ASSERT_EQ(curve.size(), 1u);
  EXPECT_THAT(curve[0].pointer, testing::StartsWith("/curve"));
}

TEST(Parts, ProvenanceOfAMissingValueIsRefused) {
  Json fitting = RenderPart(PartOf("fitting"));
  fitting["provenance"]["price_eur"] = Parse(R"({"kind": "datasheet", "source": "list"})");
  EXPECT_THAT(DetailAt(ErrorsOf(ParsePart(fitting)), "/provenance/price_eur"),
              HasSubstr("no value of price_eur"));
}

}  // namespace part_document_test
}  // namespace plenum::api
