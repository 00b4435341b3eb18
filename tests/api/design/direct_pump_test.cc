// Pumps without a reservoir, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace {

// A pump for one group of slow fingers.
Json Asked(int groups = 1) {
  Json request = Example("gripper");
  Json finger = request["actuators"][0];
  finger["count"] = 2;
  finger["rise_time_s_max"] = 2.0;
  finger["fall_time_s_max"] = 2.0;
  request["actuators"] = Json::array();
  for (int g = 0; g < groups; ++g) {
    finger["name"] = "fingers " + std::to_string(g);
    request["actuators"].push_back(finger);
  }
  request["duty"] = {{"frequency_hz", 0.1}, {"actuations", 500}, {"simultaneous", groups == 1}};
  request["supply"] = {{"configurations", {"direct_pump"}}};
  request["ranking"] = {{"count", 2}, {"list", "combinations"}, {"proof", true}};
  return request;
}

TEST(DirectPumpTest, IsDesignedAndVerified) {
  const Json answer = Answered(Asked());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    EXPECT_EQ(design["configuration"], "direct_pump");
    EXPECT_TRUE(design["settings"]["reservoir_volume_ml"].is_null());
    EXPECT_GT(design["settings"]["source_pressure_kpa_gauge"].get<double>(), 60.0);
    const double inflate_share = design["settings"]["valve_duty"];
    EXPECT_NEAR(design["settings"]["compressor_duty"].get<double>(), inflate_share,
                1e-6 * inflate_share);
    for (const Json& row : design["parts"]) EXPECT_NE(row["family"], "reservoir");
  }
}

TEST(DirectPumpTest, DrawsAreVerified) {
  Json request = Asked(2);
  request["robust"] = {{"draws", 10}};
  const Json answer = Answered(request);
  const double probability = answer["designs"][0]["robustness"]["probability"];
  EXPECT_GT(probability, 0.0);
  EXPECT_EQ(Refusals(answer), "");
}

TEST(DirectPumpTest, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {
      {"another pressure", "strokes",
       [](Json& a) {
         Json& pressure = a["designs"][0]["settings"]["source_pressure_kpa_gauge"];
         pressure = 1.01 * pressure.get<double>();
       }},
      {"a reservoir", "supply",
       [](Json& a) { a["designs"][0]["settings"]["reservoir_volume_ml"] = 500; }},
      {"less duty", "strokes",
       [](Json& a) {
         Json& duty = a["designs"][0]["settings"]["compressor_duty"];
         duty = 0.9 * duty.get<double>();
       }},
      {"faster", "strokes", [](Json& a) {
         Json& group = a["designs"][0]["performance"]["groups"][0];
         group["rise_time_s"] = 0.9 * group["rise_time_s"].get<double>();
       }}};
  ExpectRefused(Answered(Asked()), kTamperings);
}

TEST(DirectPumpTest, IsAskedForByNameAlone) {
  Json request = Asked();
  request.erase("supply");
  const auto parsed = ParseRequirements(request, Project().parts);
  const auto& problem = std::get<DesignRequest>(parsed).problem;
  EXPECT_FALSE(problem.configurations.contains(optimizer::Configuration::kDirectPump));
}

std::string Pointers(const Json& request) {
  std::string all;
  for (const Error& error : ErrorsOf(ParseRequirements(request, Project().parts)))
    all += error.pointer + " ";
  return all;
}

TEST(DirectPumpTest, NamesWhatIsWrongWithARequest) {
  Json request = Asked(2);
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "shared";
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "per_group";
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["supply"]["pumps"] = "each";
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["supply"].erase("pumps");
  request["duty"]["simultaneous"] = true;
  EXPECT_EQ(Pointers(request), "/duty/simultaneous ");
  request = Asked();
  request["supply"]["pumps"] = "per_group";
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "per_actuator";
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["supply"] = {{"configurations", {"cylinder"}}, {"pumps", "shared"}};
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request = Asked();
  request["ranking"] = {{"count", 1}};
  request["guarantee"] = true;
  EXPECT_EQ(Pointers(request), "/guarantee ");
}

Parsed<Json> Evaluated(const Json& request, const Json& design) {
  return RunEvaluation({{"schema", "evaluation/1"}, {"requirements", request}, {"design", design}},
                       Project().parts, {});
}

TEST(DirectPumpTest, ADesignIsEvaluatedAsItWasListed) {
  const Json request = Asked(2);
  Json design = Answered(request)["designs"][0];
  for (const bool stated : {true, false}) {
    if (!stated) design["settings"].erase("source_pressure_kpa_gauge");
    const auto evaluated = Evaluated(request, design);
    for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
    const Json& answer = std::get<Json>(evaluated);
    EXPECT_EQ(answer["works"], true);
    const double energy_wh = design["totals"]["energy_wh"];
    EXPECT_NEAR(answer["totals"]["energy_wh"].get<double>(), energy_wh, 1e-6 * energy_wh);
    EXPECT_EQ(answer["margins"].size(), design["margins"].size());
  }
}

TEST(DirectPumpTest, ADesignWithALone32IsNamed) {
  const Json request = Asked();
  Json design = Answered(request)["designs"][0];
  const auto holds_not =
      std::find_if(Project().parts.begin(), Project().parts.end(), [](const catalog::Part& part) {
        return part.family == "valve" && part.texts.at("function").value == "3/2";
      });
  ASSERT_NE(holds_not, Project().parts.end());
  for (Json& row : design["parts"])
    if (row["family"] == "valve") {
      row["id"] = holds_not->id;
      row["quantity"] = 2;
    }
  bool named = false;
  for (const Error& error : ErrorsOf(Evaluated(request, design)))
    named = named || error.detail.find("cannot hold") != std::string::npos;
  EXPECT_TRUE(named);
}

}  // namespace
}  // namespace plenum::api
