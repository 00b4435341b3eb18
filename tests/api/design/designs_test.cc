#include "api/design/designs.h"

#include <gtest/gtest.h>

#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace designs_test {

using optimizer::Family;

DesignRequest Request() {
  Json request = Requirements();
  request["ambient"]["pressure_kpa_abs"] = 90;
  return std::get<DesignRequest>(ParseRequirements(request, SmallCatalogue()));
}

// A compressor design with a made-to-measure reservoir, every number chosen by hand.
optimizer::Design HandMadeDesign() {
  optimizer::Design design;
  design.configuration = optimizer::Configuration::kCompressor;
  design.parts = {
      {Family::kTubing, "tubing-1", 0, 3.0, 0.027, 3.77e-5, 2.4},
      {Family::kValve, "valve-1", 0, 3, 0.06, 24e-6, 90.0},
      {Family::kCompressor, "compressor-1", -1, 1, 1.1, 900e-6, std::nullopt},
      {Family::kReservoir, "custom", -1, 1, 0.2, 800e-6, std::nullopt},
  };
  design.settings = {182e3, 0.78, 730e-6, {0.046}};
  design.totals = {1.387, 1.7617e-3, std::nullopt, 219600.0};
  design.performance = {{{0.44, 0.57, 0.46, 0.98, 191.5e3}}, 0.12, 0.15e-3, 0.9, 1e4};
  design.margins = {{"/actuators/0/rise_time_s_max", 0.5, 0.44, 0.12}};
  design.objective = 1.387;
  design.response = {{0.0, 0.5}, {{90e3, 190e3}}, {272e3, 260e3}};
  return design;
}

optimizer::Answer HandMadeAnswer() {
  optimizer::Answer answer;
  answer.status = optimizer::Status::kOptimal;
  answer.designs = {HandMadeDesign()};
  answer.proof.combinations = *optimizer::BigCount::FromDecimal("1203849216000000000000000000007");
  answer.proof.complete = true;
  answer.proof.lower_bound = 2.31;
  answer.proof.evaluated = 812;
  answer.proof.simulated = 240;
  answer.proof.pruned = {1, 2, 3, 4, 5};
  answer.seconds = 0.4;
  return answer;
}

TEST(RenderAnswer, HasEveryFieldOfTheContract) {
  const Json json = RenderAnswer(Request(), HandMadeAnswer(), SmallCatalogue());
  EXPECT_EQ(json["schema"], "designs/1");
  EXPECT_EQ(json["name"], "exosuit");
  EXPECT_EQ(json["status"], "optimal");
  EXPECT_EQ(json["best_on_measured_flow"], 1);
  EXPECT_EQ(json["seconds"], 0.4);
  EXPECT_FALSE(json.contains("conflict"));
  EXPECT_EQ(json["requirements"]["ambient"]["pressure_kpa_abs"], 90);
  ASSERT_EQ(json["designs"].size(), 1u);
  const Json& design = json["designs"][0];
  EXPECT_EQ(design["rank"], 1);
  EXPECT_EQ(design["configuration"], "compressor");
  EXPECT_EQ(design["parts"][0],
            Parse(R"({"family": "tubing", "id": "tubing-1", "manufacturer": "Acme",
                      "part_number": "tubing 1", "group": "spa_pack", "quantity": 3.0, "unit": "m",
                      "mass_kg": 0.027, "volume_l": 0.0377, "cost_eur": 2.4})"));
  EXPECT_EQ(design["parts"][1]["unit"], "piece");
  EXPECT_TRUE(design["parts"][2]["group"].is_null());
  EXPECT_TRUE(design["parts"][2]["cost_eur"].is_null());
  EXPECT_EQ(design["parts"][3]["id"], "custom");
  EXPECT_EQ(design["settings"], Parse(R"({"source_pressure_kpa_gauge": 92.0, "valve_duty": 0.046,
                      "valve_duty_groups": [0.046], "compressor_duty": 0.78,
                      "reservoir_volume_ml": 730.0, "tank_fill_kpa_gauge": null, "power": null})"));
  EXPECT_EQ(design["totals"], Parse(R"({"mass_kg": 1.387, "volume_l": 1.7617, "cost_eur": null,
                                        "cost_eur_min": 0.0, "energy_wh": 61.0})"));
  EXPECT_EQ(design["performance"],
            Parse(R"({"groups": [{"name": "spa_pack", "rise_time_s": 0.44, "fall_time_s": 0.57,
                                  "inflate_time_s": 0.46, "frequency_hz_max": 0.98,
                                  "peak_kpa_gauge": 101.5}],
                      "frequency_hz_sustained": 0.12, "air_per_actuation_l_anr": 0.15,
                      "air_total_l_anr": 900.0, "run_time_s": 10000.0,
                      "compressed_air_l_per_min_anr": null})"));
  EXPECT_EQ(design["margins"],
            Parse(R"([{"requirement": "/actuators/0/rise_time_s_max", "required": 0.5,
                       "achieved": 0.44, "relative_margin": 0.12, "binding": false}])"));
  EXPECT_EQ(design["response"], Parse(R"({"t_s": [0.0, 0.5],
                      "groups": [{"name": "spa_pack", "pressure_kpa_gauge": [0.0, 100.0]}],
                      "source_pressure_kpa_gauge": [182.0, 170.0]})"));
  EXPECT_EQ(json["proof"],
            Parse(R"({"combinations": "1203849216000000000000000000007", "complete": true,
                      "lower_bound": 2.31, "gap": 0.0, "evaluated": 812, "simulated": 240,
                      "undecided": 0,
                      "pruned": {"incompatible": "1", "infeasible": "2", "bound": "3",
                                 "dominated": "4", "unpriced": "5"},
                      "proved_designs": 1})"));
}

TEST(RenderAnswer, SaysWhatRestsOnEstimates) {
  auto parts = SmallCatalogue();
  for (catalog::Part& part : parts) {
    if (part.family == "valve") {
      part.numbers["mass_kg"].provenance = catalog::Provenance::kEstimated;
      part.numbers["response_time_ms"].provenance = catalog::Provenance::kEstimated;
    }
    if (part.family == "valve" || part.family == "battery") part.orderable = false;
    if (part.family == "battery")  // not in the design
      part.numbers["mass_kg"].provenance = catalog::Provenance::kEstimated;
  }
  const Json quality =
      RenderAnswer(Request(), HandMadeAnswer(), parts)["designs"][0]["data_quality"];
  // Valves 3 × 0.02 kg and the reservoir's 0.2 kg, of 1.387 kg.
  EXPECT_NEAR(quality["mass_share_estimated"].get<double>(), 0.26 / 1.387, 1e-11);
  EXPECT_EQ(quality["estimated"], (Json{"reservoir.body_volume_ml", "reservoir.mass_kg",
                                        "valve.mass_kg", "valve.response_time_ms"}));
  EXPECT_EQ(quality["flow_estimated"], false);
  EXPECT_EQ(quality["not_orderable"], Json{"valve-1"});
}

TEST(RenderAnswer, GasChargeIsNotAnEstimate) {
  auto parts = SmallCatalogue();
  for (catalog::Part& part : parts)
    if (part.family == "co2") part.numbers["mass_kg"].provenance = catalog::Provenance::kEstimated;
  optimizer::Answer answer = HandMadeAnswer();
  answer.designs[0].parts = {{Family::kCo2, "co2-1", -1, 2, 2.2, 2e-3, std::nullopt}};
  answer.designs[0].totals.mass_kg = 2.2;  // two bottles of 0.6 kg with 0.5 kg of CO2 each
  const Json quality = RenderAnswer(Request(), answer, parts)["designs"][0]["data_quality"];
  EXPECT_NEAR(quality["mass_share_estimated"].get<double>(), 1.2 / 2.2, 1e-11);
}

TEST(RenderAnswer, RanksTheBestDesignOnMeasuredFlow) {
  const auto estimate = [](const char* family, const char* field) {
    auto parts = SmallCatalogue();
    for (catalog::Part& part : parts) {
      if (part.family != family) continue;
      if (std::string_view(field) == "free_air")
        part.curve->free_air_provenance = catalog::Provenance::kEstimated;
      else
        part.numbers.at(field).provenance = catalog::Provenance::kEstimated;
    }
    return parts;
  };
  optimizer::Answer answer = HandMadeAnswer();
  answer.designs.push_back(answer.designs[0]);
  answer.designs[1].parts.erase(answer.designs[1].parts.begin());  // no tube
  const auto best = [&](const char* family, const char* field) {
    return RenderAnswer(Request(), answer, estimate(family, field))["best_on_measured_flow"];
  };
  EXPECT_EQ(best("tubing", "inner_diameter_mm"), 2);
  EXPECT_EQ(best("tubing", "outer_diameter_mm"), 1);
  EXPECT_TRUE(best("valve", "critical_ratio_exhaust").is_null());
  EXPECT_TRUE(best("compressor", "free_air").is_null());
  EXPECT_EQ(best("compressor", "mass_kg"), 1);
}

TEST(RenderAnswer, InfeasibleCarriesTheConflict) {
  optimizer::Answer answer;
  answer.status = optimizer::Status::kInfeasible;
  answer.infeasibility = {{{{"/actuators/0/rise_time_s_max", 0.1, 0.3, 0.29},
                            {"/require/valve", std::nullopt, std::nullopt, std::nullopt, false}}},
                          {{"/actuators/0/rise_time_s_max", 0.1, 0.3, 2.0}},
                          true};
  answer.proof.lower_bound = std::numeric_limits<double>::infinity();
  const Json json = RenderAnswer(Request(), answer, SmallCatalogue());
  EXPECT_EQ(json["status"], "infeasible");
  EXPECT_EQ(json["designs"], Json::array());
  EXPECT_TRUE(json["best_on_measured_flow"].is_null());
  EXPECT_TRUE(json["proof"]["lower_bound"].is_null());
  const Json conflict =
      Parse(R"([{"requirement": "/actuators/0/rise_time_s_max", "required": 0.1, "best": 0.3,
                 "best_interval": [0.29, 0.3], "relaxation": 2.0, "proved": true},
                {"requirement": "/require/valve", "required": null, "best": null,
                 "best_interval": null, "relaxation": null, "proved": false}])");
  EXPECT_EQ(json["conflict"], conflict);
  EXPECT_EQ(json["conflicts"], Json::array({conflict}));
  EXPECT_EQ(json["relaxation"],
            Parse(R"([{"requirement": "/actuators/0/rise_time_s_max", "required": 0.1,
                       "value": 0.3, "relative_change": 2.0}])"));
}

TEST(RenderAnswer, SeveralGroupsGiveTheLargestValveDutyAndAllOfThem) {
  DesignRequest request = Request();
  request.problem.groups.push_back(request.problem.groups[0]);
  request.problem.groups[1].name = "thumb";
  optimizer::Answer answer = HandMadeAnswer();
  answer.designs[0].settings.valve_duty = {0.02, 0.05};
  answer.designs[0].parts[1].group = 1;
  const Json design = RenderAnswer(request, answer, SmallCatalogue())["designs"][0];
  EXPECT_EQ(design["settings"]["valve_duty"], 0.05);
  EXPECT_EQ(design["settings"]["valve_duty_groups"], (Json{0.02, 0.05}));
  EXPECT_EQ(design["parts"][1]["group"], "thumb");
}

}  // namespace designs_test
}  // namespace plenum::api
