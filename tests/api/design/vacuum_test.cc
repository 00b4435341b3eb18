// Evacuated actuators, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/requirements_reader.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace vacuum_test {

Json Asked() {
  Json request = Example("jamming_gripper");
  request["ranking"] = {{"count", 3}, {"per_source", 20}, {"proof", true}};
  return request;
}

const Json& TheAnswer() {
  static const Json answer = Answered(Asked());
  return answer;
}

TEST(VacuumTest, IsDesignedAndVerified) {
  const Json& answer = TheAnswer();
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    const bool direct = design["configuration"] == "direct_vacuum_pump";
    EXPECT_TRUE(direct || design["configuration"] == "vacuum_pump");
    const double vacuum = design["settings"]["vacuum_kpa_gauge"];
    EXPECT_LE(vacuum, -60.0);
    EXPECT_GE(vacuum, -85.0);
    EXPECT_EQ(design["settings"]["source_pressure_kpa_gauge"], vacuum);
    EXPECT_EQ(design["settings"]["reservoir_volume_ml"].is_null(), direct);
    std::set<std::string> families;
    for (const Json& row : design["parts"]) families.insert(row["family"]);
    EXPECT_TRUE(families.contains("vacuum_pump"));
    EXPECT_FALSE(families.contains("compressor"));
    for (const Json& pressure : design["response"]["groups"][0]["pressure_kpa_gauge"]) {
      EXPECT_LE(pressure.get<double>(), 1e-6);
      EXPECT_GE(pressure.get<double>(), -63.0);
    }
    std::set<std::string> requirements;
    for (const Json& margin : design["margins"]) {
      requirements.insert(margin["requirement"]);
      EXPECT_GE(margin["relative_margin"].get<double>(), -1e-9) << margin;
    }
    EXPECT_TRUE(requirements.contains("/actuators/0/pressure_kpa_gauge_min"));
    EXPECT_TRUE(requirements.contains("/supply/vacuum/vacuum_kpa_gauge_min"));
  }
}

// 200 mL and the bore of the tube at ambient, 160 mL and that bore at 40 kPa absolute.
TEST(VacuumTest, AnActuationTakesTheAirThatTheGasLawSays) {
  for (const Json& design : TheAnswer()["designs"]) {
    double bore_ml = 0.0;
    for (const Json& row : design["parts"])
      if (row["family"] == "tubing")
        for (const catalog::Part& part : Project().parts)
          if (part.id == row["id"]) {
            const double bore_mm = part.numbers.at("inner_diameter_mm").value;
            bore_ml = 3.14159265358979 / 4.0 * bore_mm * bore_mm;  // of 1 m
          }
    const double air_l = (100.0 * (200.0 + bore_ml) - 40.0 * (160.0 + bore_ml)) / 100.0 / 1e3;
    const double told = design["performance"]["air_per_actuation_l_anr"];
    EXPECT_NEAR(told, air_l, 1e-4);
  }
}

TEST(VacuumTest, ADesignIsEvaluatedAsItWasListed) {
  Json request = Asked();
  for (Json design : TheAnswer()["designs"]) {
    for (const char* left_out : {"", "vacuum_kpa_gauge", "source_pressure_kpa_gauge"}) {
      Json given = design;
      if (*left_out) given["settings"].erase(left_out);
      const auto evaluated = Evaluated(request, given);
      for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
      const Json& answer = std::get<Json>(evaluated);
      EXPECT_EQ(answer["works"], true);
      const double energy_wh = design["totals"]["energy_wh"];
      EXPECT_NEAR(answer["totals"]["energy_wh"].get<double>(), energy_wh, 1e-6 * energy_wh);
      EXPECT_EQ(answer["margins"].size(), design["margins"].size());
    }
  }
}

TEST(VacuumTest, AGivenPartThatDoesNotStandVacuumIsNamed) {
  const auto& designs = TheAnswer()["designs"];
  const auto with = std::find_if(designs.begin(), designs.end(), [](const Json& design) {
    return design["configuration"] == "vacuum_pump";
  });
  ASSERT_NE(with, designs.end());
  const auto errors = [&](const std::string& id) {
    Json design = *with;
    for (Json& row : design["parts"])
      if (row["family"] == "reservoir") row["id"] = id;
    design["settings"].erase("reservoir_volume_ml");
    std::string all;
    for (const Error& error : ErrorsOf(Evaluated(Asked(), design)))
      all += error.pointer + " " + error.detail;
    return all;
  };
  EXPECT_NE(errors("generic-pet-500ml").find("does not stand a vacuum"), std::string::npos);
  EXPECT_NE(errors("custom").find("not for a vacuum"), std::string::npos);
}

TEST(VacuumTest, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"another vacuum", "strokes",
       [](Json& a) {
         for (const char* field : {"vacuum_kpa_gauge", "source_pressure_kpa_gauge"}) {
           Json& pressure = a["designs"][0]["settings"][field];
           pressure = 1.01 * pressure.get<double>();
         }
       }},
      {"faster", "strokes",
       [](Json& a) {
         Json& group = a["designs"][0]["performance"]["groups"][0];
         group["fall_time_s"] = 0.9 * group["fall_time_s"].get<double>();
       }},
      {"a lower pressure is met", "margins", [](Json& a) {
         for (Json& margin : a["designs"][0]["margins"])
           if (margin["requirement"] == "/actuators/0/pressure_kpa_gauge_min")
             margin["achieved"] = -55.0;
       }}};
  ExpectRefused(TheAnswer(), kTamperings);
}

TEST(VacuumTest, DrawsAreVerified) {
  Json request = Asked();
  request["ranking"] = {{"count", 1}, {"list", "combinations"}, {"proof", true}};
  request["robust"] = {{"draws", 10}};
  const Json answer = Answered(request);
  EXPECT_TRUE(answer["designs"][0]["robustness"]["probability"].is_number());
  EXPECT_EQ(Refusals(answer), "");
}

// Guaranteed with every number at its worst: no lighter, verified, and it works with the numbers as
// they are.
TEST(VacuumTest, IsGuaranteed) {
  Json request = Asked();
  request["ranking"] = {{"count", 1}, {"proof", true}};
  request["guarantee"] = true;
  request["actuators"][0]["relative_uncertainty"] = {{"rest_volume", 0.02}};
  const Json answer = Answered(request);
  EXPECT_EQ(Refusals(answer), "");
  ASSERT_FALSE(answer["designs"].empty());
  const Json& design = answer["designs"][0];
  EXPECT_EQ(design["configuration"], "vacuum_pump");
  EXPECT_GE(design["objective"].get<double>(),
            answer["on_paper"]["designs"][0]["objective"].get<double>());
  request.erase("guarantee");
  Json given = design;
  const auto evaluated = Evaluated(request, given);
  const Json& figures = std::get<Json>(evaluated);
  EXPECT_EQ(figures["works"], true);
  for (const Json& margin : figures["margins"])
    EXPECT_GE(margin["relative_margin"].get<double>(), -1e-9) << margin;
}

TEST(VacuumTest, NamesWhatIsWrongWithARequest) {
  const auto with = [](const auto& change) {
    Json request = Example("jamming_gripper");
    change(request, request["actuators"][0]);
    return Pointers(request);
  };
  EXPECT_EQ(with([](Json&, Json&) {}), "");
  EXPECT_EQ(with([](Json& r, Json&) { r.erase("supply"); }), "");
  EXPECT_EQ(with([](Json&, Json& bag) { bag["operating_pressure_kpa_gauge"] = "-60 kPa"; }), "");
  EXPECT_EQ(with([](Json&, Json& bag) { bag["operating_pressure_kpa_gauge"] = "40 kPa abs"; }), "");
  const std::string operating = "/actuators/0/operating_pressure_kpa_gauge ";
  EXPECT_EQ(with([](Json&, Json& bag) { bag["operating_pressure_kpa_gauge"] = -0.5; }), operating);
  EXPECT_EQ(with([](Json&, Json& bag) { bag["operating_pressure_kpa_gauge"] = -120; }), operating);
  // Below ambient all the same: nothing else follows from what cannot be read.
  for (const char* text : {"-0.6 baar", "-60", " -60 kp", "-2 bar"})
    EXPECT_EQ(with([&](Json& r, Json& bag) {
                Json second = bag;
                second["name"] = "second";
                bag["operating_pressure_kpa_gauge"] = text;
                r["actuators"].push_back(second);
              }),
              operating)
        << text;
  EXPECT_EQ(with([](Json&, Json& bag) { bag["expansion_ratio"] = 1.5; }),
            "/actuators/0/expansion_ratio ");
  EXPECT_EQ(with([](Json&, Json& bag) { bag["expansion_ratio"] = 0; }),
            "/actuators/0/expansion_ratio ");
  EXPECT_EQ(with([](Json&, Json& bag) { bag["pressure_kpa_gauge_max"] = 105; }),
            "/actuators/0/pressure_kpa_gauge_max ");
  EXPECT_EQ(with([](Json&, Json& bag) { bag["pressure_kpa_gauge_min"] = -50; }),
            "/actuators/0/pressure_kpa_gauge_min ");
  EXPECT_EQ(with([](Json&, Json& bag) {
              bag.erase("rest_volume_ml");
              bag.erase("expansion_ratio");
              bag["pouch"] = {{"width_mm", 30}, {"length_mm", 60}};
            }),
            operating);
  EXPECT_EQ(with([](Json& r, Json&) { r["supply"]["vacuum"]["vacuum_kpa_gauge_min"] = -50; }),
            operating);
  EXPECT_EQ(with([](Json& r, Json&) { r["supply"]["vacuum"]["configurations"] = {"ejector"}; }),
            "/supply/mains ");
  EXPECT_EQ(with([](Json& r, Json&) { r["supply"]["vacuum"]["configurations"] = {"hose"}; }),
            "/supply/vacuum/configurations/0 ");
  EXPECT_EQ(with([](Json& r, Json&) { r["supply"]["vacuum"]["configurations"] = {"mains"}; }),
            "/supply/vacuum/mains ");
  const auto from_wall = [&](double kpa) {
    return with([&](Json& r, Json&) {
      r["supply"]["vacuum"] = {{"configurations", {"mains"}},
                               {"mains", {{"pressure_kpa_gauge", kpa}}}};
    });
  };
  EXPECT_EQ(from_wall(-80.0), "");
  EXPECT_EQ(from_wall(-50.0), operating);
  EXPECT_EQ(from_wall(80.0), "/supply/vacuum/mains/pressure_kpa_gauge ");
  EXPECT_EQ(with([](Json& r, Json&) { r["guarantee"] = true; }), "");
  EXPECT_EQ(with([](Json& r, Json& bag) {
              r["guarantee"] = true;
              bag["relative_uncertainty"] = {{"expansion_ratio", 0.05}};
            }),
            "/guarantee ");
  EXPECT_EQ(with([](Json& r, Json& bag) {
              Json finger = bag;
              finger["name"] = "finger";
              finger["operating_pressure_kpa_gauge"] = 60;
              finger["expansion_ratio"] = 1.5;
              r["actuators"].push_back(finger);
            }),
            "/actuators/1/operating_pressure_kpa_gauge ");
  Json pressed = Example("gripper");
  pressed["supply"]["vacuum"] = Json::object();
  EXPECT_EQ(Pointers(pressed), "/supply/vacuum ");
}

TEST(VacuumTest, PartsThatVacuumFlattensAreLeftOut) {
  std::set<std::string> kinds;
  for (const catalog::Part& part : Project().parts) {
    if (StandsVacuum(part)) continue;
    kinds.insert(part.family);
    if (part.family == "reservoir") {
      EXPECT_EQ(part.texts.at("material").value, "PET");
    }
    if (part.family == "tubing") {
      EXPECT_EQ(part.texts.at("material").value, "silicone");
    }
  }
  EXPECT_TRUE(kinds.contains("reservoir"));
  EXPECT_TRUE(kinds.contains("valve"));
  for (const Json& design : TheAnswer()["designs"])
    for (const Json& row : design["parts"])
      for (const catalog::Part& part : Project().parts)
        if (part.id == row["id"]) {
          EXPECT_TRUE(StandsVacuum(part)) << part.id;
        }
  EXPECT_TRUE(TheAnswer()["left_out"]["vacuum"].contains("valve"));
  // What is assumed of a valve that does not say so is marked.
  const Json& estimated = TheAnswer()["designs"][0]["data_quality"]["estimated"];
  EXPECT_NE(std::find(estimated.begin(), estimated.end(), "vacuum_pump.duty_max"), estimated.end());
}

Json Rig() {
  return {{"schema", "simulation/1"},
          {"actuators",
           {{{"rest_volume_ml", 100},
             {"expansion_ratio", 0.5},
             {"operating_pressure_kpa_gauge", -60},
             {"line", {{"sonic_conductance_dm3_per_s_bar", 0.05}, {"critical_ratio", 0.3}}},
             {"valve", Json::array({{{"t_s", 0}, {"state", "inflate"}}})}}}},
          {"source", {{"kind", "regulated"}, {"source_pressure_kpa_gauge", -80}}},
          {"t_end_s", 3}};
}

// physics, 2.14: to 95 %, and letting air in from there to 5 %.
TEST(VacuumTest, ASimulationMeetsTheOracle) {
  const auto answer = RunSimulation(Rig(), {});
  for (const Error& error : ErrorsOf(answer)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& response = std::get<Json>(answer);
  EXPECT_EQ(response["status"], "done");
  const Json& group = response["performance"]["groups"][0];
  EXPECT_NEAR(group["rise_time_s"].get<double>(), 2.188496, 2e-5);
  EXPECT_NEAR(group["fall_time_s"].get<double>(), 2.201589, 2e-5);
  for (const Json& pressure : response["groups"][0]["pressure_kpa_gauge"]) {
    EXPECT_LE(pressure.get<double>(), 1e-6);
    EXPECT_GE(pressure.get<double>(), -80.0);
  }
  EXPECT_EQ(response["groups"][0]["air_in_l_anr"], 0.0);
  EXPECT_GT(response["groups"][0]["air_out_l_anr"].get<double>(), 0.05);
  EXPECT_EQ(response["source_pressure_kpa_gauge"][0], -80.0);
}

TEST(VacuumTest, ASimulationOfAPumpAloneMeetsTheOracle) {
  Json rig = Rig();
  rig["actuators"][0]["rest_volume_ml"] = 1000;
  rig["actuators"][0]["expansion_ratio"] = 1;
  rig["actuators"][0]["close_at_operating_pressure"] = true;
  rig["rise"] = {{"to_fraction", 1}};
  rig["source"] = {{"kind", "direct_vacuum_pump"},
                   {"curve",
                    {{{"pressure_kpa_gauge", -80}, {"free_air_l_per_min", 0}},
                     {{"pressure_kpa_gauge", 0}, {"free_air_l_per_min", 10}}}}};
  rig["t_end_s"] = 30;
  const auto answer = RunSimulation(rig, {});
  for (const Error& error : ErrorsOf(answer)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& group = std::get<Json>(answer)["performance"]["groups"][0];
  EXPECT_NEAR(group["rise_time_s"].get<double>(), 19.819339, 2e-4);
}

TEST(VacuumTest, ASimulationNamesWhatIsWrong) {
  const auto pointers = [](const Json& rig) {
    std::string all;
    for (const Error& error : ErrorsOf(RunSimulation(rig, {}))) all += error.pointer + " ";
    return all;
  };
  Json rig = Rig();
  rig["source"]["source_pressure_kpa_gauge"] = 20;
  EXPECT_EQ(pointers(rig), "/source/source_pressure_kpa_gauge ");
  rig = Rig();
  rig["source"] = {{"kind", "compressor"}};
  EXPECT_EQ(pointers(rig), "/source/kind ");
  rig = Rig();
  rig["effects"] =
      Json::array({{{"id", "leak"}, {"parameters", {{"sonic_conductance_dm3_per_s_bar", 1e-4}}}}});
  EXPECT_NE(pointers(rig).find("effects"), std::string::npos);
  rig = Rig();
  Json other = rig["actuators"][0];
  other["name"] = "pressed";
  other["operating_pressure_kpa_gauge"] = 60;
  other["expansion_ratio"] = 1.5;
  rig["actuators"].push_back(other);
  EXPECT_EQ(pointers(rig), "/actuators/1/operating_pressure_kpa_gauge ");
}

}  // namespace vacuum_test
}  // namespace plenum::api
