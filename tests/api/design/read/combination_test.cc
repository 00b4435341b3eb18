// A given design must be a combination of the problem; what is missing or does not fit is named.
#include "api/design/read/combination.h"

#include <gtest/gtest.h>

#include "api/catalogue/stores.h"
#include "api/design/given/evaluation.h"
#include "api/json/json.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace combination_test {

// Six actuators on three valves of two channels, and the pump, pack and bottle of the catalogue.
Json Compressor() {
  return Parse(R"({
    "configuration": "compressor",
    "parts": [
      { "family": "valve", "id": "valve-1", "group": "spa_pack", "quantity": 3 },
      { "family": "fitting", "id": "fitting-1", "group": "spa_pack", "quantity": 12 },
      { "family": "tubing", "id": "tubing-1", "group": "spa_pack", "quantity": 3.0 },
      { "family": "compressor", "id": "compressor-1", "quantity": 1 },
      { "family": "battery", "id": "battery-1", "quantity": 1 },
      { "family": "reservoir", "id": "reservoir-1", "quantity": 2 } ],
    "settings": { "source_pressure_kpa_gauge": 300 } })");
}

Json Cylinder() {
  Json design = Compressor();
  design["configuration"] = "cylinder";
  design["parts"].erase(5);
  design["parts"][3] = Parse(R"({ "family": "cylinder", "id": "cylinder-1", "quantity": 1 })");
  design["parts"].push_back(
      Parse(R"({ "family": "regulator", "id": "regulator-1", "quantity": 1 })"));
  return design;
}

Json Asked() { return Without(Without(Requirements(), "/require"), "/exclude"); }

Parsed<Json> Evaluated(const Json& design, const Json& requirements = Asked(),
                       const std::vector<catalog::Part>& parts = SmallCatalogue()) {
  return RunEvaluation(
      {{"schema", "evaluation/1"}, {"requirements", requirements}, {"design", design}}, parts, {});
}

std::vector<catalog::Part> Changed(std::string_view family, const std::string& field,
                                   double value) {
  auto parts = SmallCatalogue();
  for (catalog::Part& part : parts)
    if (part.family == family) part.numbers.at(field).value = value;
  return parts;
}

void ExpectRefused(const Parsed<Json>& answer, const std::string& pointer,
                   const std::string& text) {
  const std::string detail = DetailAt(ErrorsOf(answer), pointer);
  EXPECT_NE(detail.find(text), std::string::npos)
      << pointer << " should say \"" << text << "\", says \"" << detail << "\"";
}

TEST(Combination, AStockReservoirHasItsOwnVolume) {
  const Json answer = std::get<Json>(Evaluated(Compressor()));
  ASSERT_TRUE(answer.at("works").get<bool>());
  EXPECT_DOUBLE_EQ(answer.at("settings").at("reservoir_volume_ml").get<double>(), 1000.0);
  for (const Json& same : {Json(nullptr), Json(1000)})
    EXPECT_EQ(std::get<Json>(Evaluated(With(Compressor(), "/settings/reservoir_volume_ml", same))),
              answer);
}

TEST(Combination, AMadeReservoirHasTheVolumeStated) {
  Json design = With(Compressor(), "/parts/5/id", "custom");
  design["parts"][5]["quantity"] = 1;
  const std::string volume = "/settings/reservoir_volume_ml";
  ExpectRefused(Evaluated(design), "/design" + volume,
                "is required with a reservoir made to measure");
  for (const double ml : {9.9, 20'001.0})
    ExpectRefused(Evaluated(With(design, volume, ml)), "/design" + volume,
                  "must be ≥ 10 and ≤ 20000");
  for (const double ml : {10.0, 700.0, 20'000.0}) {
    const Json answer = std::get<Json>(Evaluated(With(design, volume, ml)));
    if (!answer.at("works").get<bool>()) continue;
    EXPECT_DOUBLE_EQ(answer.at("settings").at("reservoir_volume_ml").get<double>(), ml);
  }
}

TEST(Combination, OtherConfigurationsHaveNoReservoir) {
  ASSERT_TRUE(std::get<Json>(Evaluated(Cylinder())).at("works").get<bool>());
  ExpectRefused(Evaluated(With(Cylinder(), "/settings/reservoir_volume_ml", 500)),
                "/design/settings/reservoir_volume_ml", "a cylinder design has no reservoir");
}

struct Broken {
  const char* pointer;  // into the design
  const char* value;    // none: taken away
  const char* at;
  const char* says;
};

class Rules : public testing::TestWithParam<Broken> {};

TEST_P(Rules, AreNamedWhereTheyAreBroken) {
  const auto& [pointer, value, at, says] = GetParam();
  Json design = Compressor();
  const Json::json_pointer place(pointer);
  if (value)
    design[place] = Parse(value);
  else if (design.at(place.parent_pointer()).is_array())
    design.at(place.parent_pointer()).erase(std::stoul(place.back()));
  else
    design.at(place.parent_pointer()).erase(place.back());
  ExpectRefused(Evaluated(design), at, says);
}

INSTANTIATE_TEST_SUITE_P(
    Broken, Rules,
    testing::Values(
        Broken{"/parts/0", nullptr, "/design/parts", "a valve for group spa_pack is missing"},
        Broken{"/parts/1", nullptr, "/design/parts", "a fitting for group spa_pack is missing"},
        Broken{"/parts/2", nullptr, "/design/parts", "tubing for group spa_pack is missing"},
        Broken{"/parts/3", nullptr, "/design/parts", "a compressor is missing"},
        Broken{"/parts/4", nullptr, "/design/parts", "a battery is missing"},
        Broken{"/parts/5", nullptr, "/design/parts", "a reservoir is missing"},
        Broken{"/parts/0/quantity", "1", "/design/parts/0/quantity",
               "must be 3 (a channel for each of the 6 lines of spa_pack, 2 a piece), not 1"},
        Broken{"/parts/0/quantity", "2.5", "/design/parts/0/quantity", "must be 3"},
        Broken{"/parts/1/quantity", "6", "/design/parts/1/quantity", "must be 12 (fittings"},
        Broken{"/parts/2/quantity", "2.9", "/design/parts/2/quantity", "must be 3 (metres"},
        Broken{"/parts/3/quantity", "1.5", "/design/parts/3/quantity",
               "must be a whole number ≥ 1 and ≤ 2 (limits.compressors_max), not 1.5"},
        Broken{"/parts/4/quantity", "5", "/design/parts/4/quantity", "≤ 4 (limits.batteries_max)"},
        Broken{"/parts/5/quantity", "3", "/design/parts/5/quantity", "≤ 2 (limits.reservoirs_max)"},
        Broken{"/parts/0/group", nullptr, "/design/parts/0/group", "is required"},
        Broken{"/parts/3/group", "\"spa_pack\"", "/design/parts/3/group", "must be left out"},
        Broken{"/parts/0/id", "\"valve-2\"", "/design/parts/0/id",
               "no part \"valve-2\" in the catalogue; nearest valve: valve-1"},
        Broken{"/parts/0/id", "\"fitting-1\"", "/design/parts/0/id",
               "\"fitting-1\" is a fitting, not a valve"},
        Broken{"/parts/6", R"({ "family": "battery", "id": "battery-1", "quantity": 1 })",
               "/design/parts/6/family", "an earlier row is a battery"},
        Broken{"/parts/6", R"({ "family": "cylinder", "id": "cylinder-1", "quantity": 1 })",
               "/design/parts/6/family", "a compressor design has no cylinder"},
        Broken{"/configuration", "\"cylinder\"", "/design/parts/3/family",
               "a cylinder design has no compressor"},
        Broken{"/configuration", "\"mains\"", "/design/parts", "a regulator is missing"},
        Broken{"/settings/reservoir_volume_ml", "100", "/design/settings/reservoir_volume_ml",
               "must be 1000, the volume of \"reservoir-1\", or left out, not 100"},
        Broken{"/settings/reservoir_volume_ml", "0", "/design/settings/reservoir_volume_ml",
               "must be ≥ 0.001"},
        Broken{"/settings/source_pressure_kpa_gauge", "-1",
               "/design/settings/source_pressure_kpa_gauge", "must be ≥ 0"},
        Broken{"/settings/source_pressure_kpa_gauge", "1e300",
               "/design/settings/source_pressure_kpa_gauge", "≤ 50000"}));

TEST(Combination, KeepsToWhatTheRequestAllows) {
  Json asked = Asked();
  asked["exclude"] = {"battery-1"};
  asked["supply"]["configurations"] = {"compressor", "mains"};
  ExpectRefused(Evaluated(Compressor(), asked), "/design/parts/4/id", "exclude keeps out");
  asked = Asked();
  asked["require"]["reservoir"] = {"custom"};
  ExpectRefused(Evaluated(Compressor(), asked), "/design/parts/5/id", "require.reservoir asks for");
  asked = Asked();
  asked["supply"]["configurations"] = {"cylinder", "co2"};
  ExpectRefused(Evaluated(Compressor(), asked), "/design/configuration",
                "must be one that supply.configurations asks for, cylinder or co2");
  asked = Asked();
  asked["actuators"][0]["fittings_per_line"] = 0;
  ExpectRefused(Evaluated(Compressor(), asked), "/design/parts/1/family",
                "the lines of spa_pack have no fittings");
}

TEST(Combination, NeighboursMate) {
  ExpectRefused(Evaluated(Compressor(), Asked(), Changed("tubing", "outer_diameter_mm", 6)),
                "/design/parts/1/id", "takes tube of 4 mm");
  auto parts = SmallCatalogue();
  parts[1].texts.at("thread").value = "G1/8";
  ExpectRefused(Evaluated(Compressor(), Asked(), parts), "/design/parts/1/id",
                "has the thread \"G1/8\"");
  ExpectRefused(Evaluated(Compressor(), Asked(), Changed("battery", "nominal_voltage_v", 7.4)),
                "/design/parts/4/id", "has 7.4 V, but \"compressor-1\" runs at 12 V");
  ExpectRefused(
      Evaluated(Cylinder(), Asked(), Changed("regulator", "inlet_pressure_max_kpa_gauge", 15000)),
      "/design/parts/5/id", "stands 15000 kPa gauge at its inlet; the supply has 20000 kPa gauge");
}

TEST(Combination, WithoutAPriceACostIsNotKnown) {
  Json asked = Asked();
  asked["supply"]["cost_eur_max"] = 500;
  const Json answer = std::get<Json>(Evaluated(Compressor(), asked));
  EXPECT_TRUE(answer.at("totals").at("cost_eur").is_null());
  int limits = 0;
  for (const Json& margin : answer.at("margins")) {
    if (margin.at("requirement") != "/supply/cost_eur_max") continue;
    ++limits;
    EXPECT_TRUE(margin.at("achieved").is_null());
  }
  EXPECT_EQ(limits, 1);
}

}  // namespace combination_test
}  // namespace plenum::api
