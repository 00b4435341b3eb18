// Pumps without a reservoir, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace direct_pump_test {

Json Asked(int groups = 1) { return SlowFingers(groups); }

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

TEST(DirectPumpTest, NamesWhatIsWrongWithARequest) {
  Json request = Asked(2);
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "shared";
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "per_group";
  EXPECT_EQ(Pointers(request), "");
  request["duty"]["simultaneous"] = true;  // each by pumps of its own
  EXPECT_EQ(Pointers(request), "");
  request["duty"]["simultaneous"] = false;
  request["supply"]["configurations"] = {"direct_pump", "cylinder"};
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["supply"]["configurations"] = {"direct_pump"};
  request["supply"]["pumps"] = "each";
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["supply"].erase("pumps");
  request["duty"]["simultaneous"] = true;
  EXPECT_EQ(Pointers(request), "/duty/simultaneous ");
  request = Asked();
  request["supply"]["pumps"] = "per_group";
  EXPECT_EQ(Pointers(request), "");
  request["supply"]["pumps"] = "per_actuator";
  EXPECT_EQ(Pointers(request), "");
  request["actuators"][0]["phase"] = {0.0, 0.5};
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request["actuators"][0].erase("phase");
  request["require"]["valve"] = {"koge-ksv05a-pair"};  // would fill, too
  EXPECT_NE(Pointers(request), "");
  request.erase("require");
  request["supply"] = {{"configurations", {"cylinder"}}, {"pumps", "shared"}};
  EXPECT_EQ(Pointers(request), "/supply/pumps ");
  request = Asked();
  request["ranking"] = {{"count", 1}};
  request["guarantee"] = true;
  EXPECT_EQ(Pointers(request), "/guarantee ");
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

// A kit: a pump and a valve that only vents for each of four fingers.
Json Kit() {
  Json request = Example("finger_kit");
  request["ranking"] = {{"count", 2}, {"list", "combinations"}, {"proof", true}};
  return request;
}

const Json& RowOf(const Json& design, const std::string& family) {
  for (const Json& row : design["parts"])
    if (row["family"] == family) return row;
  static const Json kNone;
  return kNone;
}

TEST(OwnPumps, OfEachActuatorAreDesignedAndVerified) {
  const Json answer = Answered(Kit());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    const int pumps = RowOf(design, "compressor")["quantity"];
    EXPECT_EQ(pumps % 4, 0);
    const auto valve = std::find_if(
        Project().parts.begin(), Project().parts.end(),
        [&](const catalog::Part& part) { return part.id == RowOf(design, "valve")["id"]; });
    EXPECT_EQ(valve->texts.at("function").value, "2/2");
    EXPECT_EQ(RowOf(design, "manifold")["quantity"], pumps == 4 ? 4 : 8);  // tees
  }
}

// One of four equal fingers with pumps of its own is the whole of one alone, four times.
TEST(OwnPumps, AKitOfFourIsFourKitsOfOne) {
  Json request = Kit();
  request["require"]["battery"] =
      Json::array({RowOf(Answered(request)["designs"][0], "battery")["id"]});
  const Json four = Answered(request)["designs"][0];
  request["actuators"][0]["count"] = 1;
  request["require"]["compressor"] = Json::array({RowOf(four, "compressor")["id"]});
  request["require"]["valve"] = Json::array({RowOf(four, "valve")["id"]});
  request["require"]["tubing"] = Json::array({RowOf(four, "tubing")["id"]});
  const Json one = Answered(request)["designs"][0];
  const auto near = [&](const char* of, const char* field, double times) {
    const double value = one[of][field];
    EXPECT_NEAR(four[of][field].get<double>(), times * value, 1e-6 * times * value) << field;
  };
  near("totals", "energy_wh", 4.0);
  near("performance", "air_total_l_anr", 4.0);
  near("settings", "compressor_duty", 1.0);
  near("settings", "source_pressure_kpa_gauge", 1.0);
  const auto mass = [](const Json& design) {
    return design["totals"]["mass_kg"].get<double>() -
           RowOf(design, "battery")["mass_kg"].get<double>();
  };
  EXPECT_NEAR(mass(four), 4.0 * mass(one), 1e-9);
}

TEST(OwnPumps, VerifyRefusesWhatIsTamperedWith) {
  const Tampering kTamperings[] = {{"one pump for all", "parts",
                                    [](Json& a) {
                                      for (Json& row : a["designs"][0]["parts"])
                                        if (row["family"] == "compressor") row["quantity"] = 1;
                                    }},
                                   {"a quarter of the energy", "strokes",
                                    [](Json& a) {
                                      Json& energy = a["designs"][0]["totals"]["energy_wh"];
                                      energy = 0.25 * energy.get<double>();
                                    }},
                                   {"no tees", "parts", [](Json& a) {
                                      Json& parts = a["designs"][0]["parts"];
                                      for (std::size_t i = parts.size(); i-- > 0;)
                                        if (parts[i]["family"] == "manifold") parts.erase(i);
                                    }}};
  ExpectRefused(Answered(Kit()), kTamperings);
}

// A stroke that begins as the period ends is done in the next one, and takes as much.
TEST(OwnPumps, AStrokeMayCrossThePeriodsEnd) {
  Json request = Kit();
  const Json from_the_start = Answered(request)["designs"][0];
  request["actuators"][0]["phase"] = 0.9;
  const Json answer = Answered(request);
  EXPECT_EQ(Refusals(answer), "");
  for (const char* setting : {"compressor_duty", "source_pressure_kpa_gauge"}) {
    const double before = from_the_start["settings"][setting];
    EXPECT_NEAR(answer["designs"][0]["settings"][setting].get<double>(), before, 1e-6 * before);
  }
}

TEST(OwnPumps, OfEachGroupMayFillAtOnce) {
  Json request = Asked(2);
  request["supply"]["pumps"] = "per_group";
  const Json in_turn = Answered(request);
  request["duty"]["simultaneous"] = true;
  const Json at_once = Answered(request);
  for (const Json* answer : {&in_turn, &at_once}) {
    EXPECT_EQ((*answer)["status"], "optimal");
    EXPECT_EQ(Refusals(*answer), "");
    EXPECT_EQ(RowOf((*answer)["designs"][0], "compressor")["quantity"].get<int>() % 2, 0);
  }
  // Both pumps at once ask more of a battery, and of nothing else.
  EXPECT_LE(in_turn["designs"][0]["objective"], at_once["designs"][0]["objective"]);
}

TEST(OwnPumps, AGivenDesignIsCheckedForItsNumberAndItsValves) {
  const Json request = Kit();
  Json design = Answered(request)["designs"][0];
  EXPECT_EQ(std::get<Json>(Evaluated(request, design))["works"], true);
  const auto said = [&](const Json& changed) {
    std::string all;
    for (const Error& error : ErrorsOf(Evaluated(request, changed))) all += error.detail + "\n";
    return all;
  };
  Json few = design;
  for (Json& row : few["parts"])
    if (row["family"] == "compressor") row["quantity"] = 3;
  EXPECT_NE(said(few).find("must be 4, or a multiple of it"), std::string::npos) << said(few);
  Json pair = design;
  for (Json& row : pair["parts"])
    if (row["family"] == "valve") row["id"] = row["id"].get<std::string>() + "-pair";
  EXPECT_NE(said(pair).find("has a way for filling, too"), std::string::npos) << said(pair);
}

}  // namespace direct_pump_test
}  // namespace plenum::api
