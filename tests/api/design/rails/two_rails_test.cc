// Actuators under pressure that a wall's vacuum pulls below ambient, from the request to the
// checked answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace two_rails_test {

Json TwoRails() {
  Json request = Example("two_rails");
  request["ranking"] = {{"count", 3}, {"per_source", 20}, {"proof", true}};
  return request;
}

std::string IdOf(const Json& design, const std::string& family) {
  for (const Json& row : design["parts"])
    if (row["family"] == family) return row["id"];
  return "";
}

// A finger of a design as a rig by itself, its share of the regulator left out.
Json Simulated(const Json& request, const Json& design) {
  const Json& finger = request["actuators"][0];
  Json elements = Json::array();
  for (const char* family : {"valve", "fitting", "tubing", "fitting"}) {
    Json element = {{"part", IdOf(design, family)}};
    if (std::string(family) == "tubing") element["length_m"] = finger["tube_length_m"];
    elements.push_back(std::move(element));
  }
  Json rig = {{"schema", "simulation/1"},
              {"source",
               {{"kind", "regulated"},
                {"source_pressure_kpa_gauge", design["settings"]["source_pressure_kpa_gauge"]}}},
              {"cycle", {{"frequency_hz", 0.5}, {"inflate_fraction", 0.5}, {"cycles", 3}}},
              {"initial", {{"pressure_kpa_gauge", -40}}}};
  Json actuator = {{"line", {{"elements", elements}}},
                   {"exhaust_pressure_kpa_gauge", -80},
                   {"close_at_operating_pressure", true},
                   {"close_at_low_pressure", true}};
  for (const char* field : {"rest_volume_ml", "expansion_ratio", "operating_pressure_kpa_gauge",
                            "low_pressure_kpa_gauge"})
    actuator[field] = finger[field];
  rig["actuators"] = Json::array({actuator});
  const auto result = RunSimulation(rig, Project().parts);
  for (const Error& error : ErrorsOf(result)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<Json>(result);
}

TEST(TwoRails, TheListIsProvedAndVerified) {
  const Json request = TwoRails();
  const Json answer = Answered(request);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Refusals(answer), "");
  ASSERT_FALSE(answer["designs"].empty());
  for (const Json& design : answer["designs"]) {
    EXPECT_NEAR(design["settings"]["vacuum_kpa_gauge"].get<double>(), -80.0, 1e-9);
    EXPECT_GE(design["settings"]["source_pressure_kpa_gauge"].get<double>(), 60.0);
    const Json& finger = design["performance"]["groups"][0];
    EXPECT_LE(finger["rise_time_s"].get<double>(), 0.4 * (1.0 + 1e-6));
    EXPECT_LE(finger["fall_time_s"].get<double>(), 0.5 * (1.0 + 1e-6));
    const Json simulated = Simulated(request, design);
    const Json& alone = simulated["performance"]["groups"][0];
    const double fall_s = alone["fall_time_s"];
    EXPECT_NEAR(finger["fall_time_s"].get<double>(), fall_s, 1e-4 * fall_s);
    EXPECT_GE(finger["rise_time_s"].get<double>(), alone["rise_time_s"].get<double>() * (1 - 1e-6));
    // (p_op·V_op − p_low·V_low)/P0 and the same of the tube.
    const Json& group = simulated["groups"][0];
    EXPECT_NEAR(design["performance"]["air_per_actuation_l_anr"].get<double>(),
                group["air_in_l_anr"].get<double>() / 3.0,
                1e-6 * group["air_in_l_anr"].get<double>());
    EXPECT_NEAR(group["pressure_kpa_gauge"].back().get<double>(), -40.0, 1e-6);
  }
}

TEST(TwoRails, ADeeperVacuumIsNeverWorse) {
  Json request = TwoRails();
  const double best = Answered(request)["designs"][0]["objective"];
  request["supply"]["vacuum"]["mains"]["pressure_kpa_gauge"] = -60.0;
  const Json shallow = Answered(request);
  ASSERT_FALSE(shallow["designs"].empty());
  EXPECT_GE(shallow["designs"][0]["objective"].get<double>(), best * (1.0 - 1e-9));
}

TEST(TwoRails, ADesignIsEvaluatedAsItWasListed) {
  const Json request = TwoRails();
  Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& document = std::get<Json>(evaluated);
  EXPECT_EQ(document["works"], true);
  const double fall_s = design["performance"]["groups"][0]["fall_time_s"];
  EXPECT_NEAR(document["performance"]["groups"][0]["fall_time_s"].get<double>(), fall_s,
              1e-9 * fall_s);
  design["settings"]["vacuum_kpa_gauge"] = -70.0;
  EXPECT_NE(DetailAt(ErrorsOf(Evaluated(request, design)), "/design/settings/vacuum_kpa_gauge"),
            "");
}

TEST(TwoRails, AGroupThatStaysAboveAmbientStandsBeside) {
  Json request = TwoRails();
  Json above = request["actuators"][0];
  above["name"] = "wrist";
  above["count"] = 1;
  above.erase("low_pressure_kpa_gauge");
  request["actuators"].push_back(above);
  request["ranking"] = {{"count", 1}, {"list", "combinations"}, {"proof", true}};
  for (const bool simultaneous : {true, false}) {
    request["duty"]["simultaneous"] = simultaneous;
    const Json answer = Answered(request);
    EXPECT_EQ(answer["status"], "optimal");
    EXPECT_EQ(Refusals(answer), "");
  }
}

TEST(TwoRails, TheVerifierRefusesWhatIsTamperedWith) {
  const Json answer = Answered(TwoRails());
  Json other = answer;
  other["designs"][0]["performance"]["groups"][0]["fall_time_s"] = 0.1;
  EXPECT_NE(Refusals(other), "");
  other = answer;
  other["requirements"]["supply"]["vacuum"]["mains"]["pressure_kpa_gauge"] = -60.0;
  for (Json& design : other["designs"]) design["settings"]["vacuum_kpa_gauge"] = -60.0;
  EXPECT_NE(Refusals(other), "");
}

// Each with the field that is told.
TEST(TwoRails, WhatIsNotThereIsRefusedByName) {
  const Json good = TwoRails();
  EXPECT_EQ(Pointers(good), "");
  const auto refused = [&](const std::string& pointer, Json value) {
    return Pointers(With(good, pointer, std::move(value)));
  };
  const std::string low = "/actuators/0/low_pressure_kpa_gauge ";
  EXPECT_EQ(refused("/actuators/0/low_pressure_kpa_gauge", -120), low);
  EXPECT_EQ(refused("/actuators/0/low_pressure_kpa_gauge", 5), low);
  EXPECT_EQ(refused("/actuators/0/low_pressure_kpa_gauge", -90), low);  // below the wall's
  EXPECT_EQ(refused("/actuators/0/expansion_ratio", 3), low);           // no volume is left
  EXPECT_EQ(Pointers(Without(good, "/supply/vacuum")), "");             // pumps
  EXPECT_EQ(refused("/supply/vacuum/configurations", Json::array({"pump"})),
            "/supply/vacuum/mains ");
  for (const Json& kinds : {Json::array({"ejector"}), Json::array({"pump", "mains"})})
    EXPECT_EQ(refused("/supply/vacuum/configurations", kinds).substr(0, 29),
              "/supply/vacuum/configurations");
  EXPECT_EQ(Pointers(Without(good, "/supply/vacuum/mains")), "/supply/vacuum/mains ");
  EXPECT_EQ(refused("/supply/vacuum/vacuum_kpa_gauge_min", -70),
            "/supply/vacuum/mains/pressure_kpa_gauge ");
  EXPECT_EQ(refused("/supply/configurations", Json::array({"mains", "compressor"})),
            "/supply/configurations ");
  EXPECT_EQ(refused("/guarantee", true), "/guarantee ");
  EXPECT_EQ(Pointers(Without(good, "/actuators/0/low_pressure_kpa_gauge")), "/supply/vacuum ");
  EXPECT_NE(refused("/actuators/0/operating_pressure_kpa_gauge", -60).find(low), std::string::npos);
  // Zero is the default.
  Json plain = With(good, "/actuators/0/low_pressure_kpa_gauge", 0);
  EXPECT_EQ(Pointers(Without(plain, "/supply/vacuum")), "");
}

TEST(TwoRails, ASimulationNamesWhatItLacks) {
  Json rig = Parse(SimulationText());
  rig["actuators"][0]["low_pressure_kpa_gauge"] = -20;
  EXPECT_NE(DetailAt(ErrorsOf(RunSimulation(rig, SmallCatalogue())),
                     "/actuators/0/exhaust_pressure_kpa_gauge"),
            "");
  rig["actuators"][0].erase("low_pressure_kpa_gauge");
  rig["actuators"][0]["close_at_low_pressure"] = true;
  EXPECT_NE(DetailAt(ErrorsOf(RunSimulation(rig, SmallCatalogue())),
                     "/actuators/0/close_at_low_pressure"),
            "");
}

}  // namespace two_rails_test
}  // namespace plenum::api
