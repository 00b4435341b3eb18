// Vacuum pumps beside a pressure supply, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace both_rails_test {

Json BothRails() {
  Json request = Example("both_rails");
  request["ranking"] = {{"count", 3}, {"per_source", 20}, {"proof", true}};
  return request;
}

const Json& RowOf(const Json& design, const std::string& family) {
  static const Json none;
  for (const Json& row : design["parts"])
    if (row["family"] == family) return row;
  return none;
}

TEST(BothRails, TheListIsProvedAndVerified) {
  const Json answer = Answered(BothRails());
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Refusals(answer), "");
  ASSERT_FALSE(answer["designs"].empty());
  for (const Json& design : answer["designs"]) {
    const Json& settings = design["settings"];
    EXPECT_LE(settings["vacuum_kpa_gauge"].get<double>(), -30.0);
    EXPECT_LT(settings["vacuum_stop_kpa_gauge"].get<double>(),
              settings["vacuum_kpa_gauge"].get<double>());
    EXPECT_GE(settings["vacuum_stop_kpa_gauge"].get<double>(), -80.0);
    EXPECT_GT(settings["vacuum_duty"].get<double>(), 0.0);
    EXPECT_TRUE(settings["reservoir_volume_ml"].is_null());
    EXPECT_EQ(RowOf(design, "vacuum_pump")["family"], "vacuum_pump");
    EXPECT_EQ(RowOf(design, "reservoir")["family"], "reservoir");
    EXPECT_EQ(RowOf(design, "battery")["family"], "battery");
    // What the reservoir takes in a period: 3 · (p_op·V_op − p_low·V_low)/P0 and more of the tubes.
    const double rise_kpa = settings["vacuum_kpa_gauge"].get<double>() -
                            settings["vacuum_stop_kpa_gauge"].get<double>();
    const double taken_l =
        rise_kpa / 100.0 * settings["vacuum_reservoir_volume_ml"].get<double>() / 1e3;
    const double air_l = design["performance"]["air_per_actuation_l_anr"];
    EXPECT_NEAR(taken_l * 293.15 / 293.15, 3.0 * air_l, 1e-6 * taken_l);
    EXPECT_GT(3.0 * air_l, 3.0 * (1.6 * 35e-3 - 0.7 * 20e-3));
  }
}

TEST(BothRails, PumpsAreTheDefault) {
  Json request = BothRails();
  const Json named = Answered(request);
  request["supply"]["vacuum"].erase("configurations");
  EXPECT_EQ(Answered(request)["designs"][0]["parts"], named["designs"][0]["parts"]);
  request["supply"].erase("vacuum");
  const Json free = Answered(request);
  EXPECT_LE(free["designs"][0]["objective"].get<double>(),
            named["designs"][0]["objective"].get<double>() * (1.0 + 1e-9));
}

TEST(BothRails, BesideTheMainsTheWallDrivesThePumps) {
  Json request = BothRails();
  request["supply"]["configurations"] = {"mains"};
  request["supply"]["mains"] = {{"pressure_kpa_gauge", 600}};
  const Json answer = Answered(request);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Refusals(answer), "");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_TRUE(RowOf(answer["designs"][0], "battery").is_null());
  EXPECT_GT(answer["designs"][0]["totals"]["energy_wh"].get<double>(), 0.0);
}

TEST(BothRails, OtherPowerDrivesThePumps) {
  for (const Json& power : {Json{{"kind", "wall"}}, Json{{"kind", "robot"}, {"voltage_v", 12}}}) {
    Json request = BothRails();
    request["supply"]["power"] = power;
    const Json answer = Answered(request);
    EXPECT_EQ(answer["status"], "optimal");
    EXPECT_EQ(Refusals(answer), "");
  }
}

TEST(BothRails, ADesignIsEvaluatedAsItWasListed) {
  const Json request = BothRails();
  Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& document = std::get<Json>(evaluated);
  EXPECT_EQ(document["works"], true);
  for (const char* field : {"vacuum_stop_kpa_gauge", "vacuum_duty", "vacuum_kpa_gauge"}) {
    const double listed = design["settings"][field];
    EXPECT_NEAR(document["settings"][field].get<double>(), listed, 1e-9 * std::abs(listed));
  }
  const auto detail = [&](const Json& given, const char* pointer) {
    return DetailAt(ErrorsOf(Evaluated(request, given)), pointer);
  };
  Json other = design;
  other["settings"].erase("vacuum_kpa_gauge");
  EXPECT_NE(detail(other, "/design/settings/vacuum_kpa_gauge"), "");
  other["settings"]["vacuum_kpa_gauge"] = -20.0;  // the low pressure is −30
  EXPECT_NE(detail(other, "/design/settings/vacuum_kpa_gauge"), "");
  other = design;
  std::erase_if(other["parts"].get_ref<Json::array_t&>(),
                [](const Json& row) { return row["family"] == "vacuum_pump"; });
  EXPECT_NE(detail(other, "/design/parts"), "");
  other = design;
  for (Json& row : other["parts"])
    if (row["family"] == "vacuum_pump") row["quantity"] = 7;
  EXPECT_NE(detail(other, ("/design/parts/" +
                           std::to_string(&RowOf(design, "vacuum_pump") - &design["parts"][0]) +
                           "/quantity")
                              .c_str()),
            "");
}

TEST(BothRails, TheVerifierRefusesWhatIsTamperedWith) {
  const Json answer = Answered(BothRails());
  const auto refuses = [&](const char* field, double value) {
    Json other = answer;
    other["designs"][0]["settings"][field] = value;
    return !Refusals(other).empty();
  };
  EXPECT_TRUE(refuses("vacuum_kpa_gauge", -45.0));
  EXPECT_TRUE(refuses("vacuum_stop_kpa_gauge", -50.0));
  EXPECT_TRUE(refuses("vacuum_duty", 0.1));
  EXPECT_TRUE(refuses("vacuum_reservoir_volume_ml", 5000.0));
  Json other = answer;
  other["designs"][0]["totals"]["energy_wh"] = 0.1;
  EXPECT_NE(Refusals(other), "");
  other = answer;
  other["requirements"]["supply"]["vacuum"]["vacuum_kpa_gauge_min"] = -40.0;
  EXPECT_NE(Refusals(other), "");
}

TEST(BothRails, WhatKeepsADesignAwayIsNamed) {
  Json request = BothRails();
  request["supply"]["vacuum"]["vacuum_kpa_gauge_min"] = -30.5;
  request["limits"] = {{"reservoirs_max", 1}};
  const Json answer = Answered(request);
  EXPECT_EQ(answer["status"], "infeasible");
  std::string named;
  for (const Json& entry : answer["conflict"]) named += entry["requirement"].get<std::string>();
  EXPECT_NE(named.find("/supply/vacuum/vacuum_kpa_gauge_min"), std::string::npos);
}

// Each with the field that is told.
TEST(BothRails, WhatIsNotThereIsRefusedByName) {
  const Json good = BothRails();
  EXPECT_EQ(Pointers(good), "");
  const auto refused = [&](const std::string& pointer, Json value) {
    return Pointers(With(good, pointer, std::move(value)));
  };
  EXPECT_EQ(refused("/actuators/0/low_pressure_kpa_gauge", -90),
            "/actuators/0/low_pressure_kpa_gauge ");  // below the deepest that is allowed
  EXPECT_EQ(refused("/supply/vacuum/configurations", Json::array({"ejector"})),
            "/supply/vacuum/configurations ");
  EXPECT_EQ(refused("/supply/vacuum/configurations", Json::array({"pump", "ejector"})),
            "/supply/vacuum/configurations ");
  EXPECT_EQ(refused("/supply/vacuum/mains", {{"pressure_kpa_gauge", -80}}),
            "/supply/vacuum/mains ");
  EXPECT_EQ(refused("/supply/configurations", Json::array({"cylinder", "compressor"})),
            "/supply/configurations ");
  EXPECT_EQ(refused("/supply/vacuum/vacuum_kpa_gauge_min", -120),
            "/supply/vacuum/vacuum_kpa_gauge_min ");
  EXPECT_EQ(refused("/guarantee", true), "/guarantee ");
  EXPECT_EQ(refused("/require", {{"vacuum_pump", {"no-such-pump"}}}), "/require/vacuum_pump/0 ");
}

}  // namespace both_rails_test
}  // namespace plenum::api
