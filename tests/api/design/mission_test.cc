// CO2 by the length of the mission: a short one draws on the heat of the bottle itself.
#include <gtest/gtest.h>

#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace mission_test {

// A shifter: two small cylinders now and then, out of cartridges.
Json Asked(double actuations) {
  Json request = Example("gripper");
  Json& group = request["actuators"][0];
  group["count"] = 2;
  group["rest_volume_ml"] = 0.8;
  group["expansion_ratio"] = 10;
  group["operating_pressure_kpa_gauge"] = 410;
  group["tube_length_m"] = 1.0;
  group["rise_time_s_max"] = 0.2;
  group["fall_time_s_max"] = 0.2;
  group.erase("pressure_kpa_gauge_max");
  request["duty"] = {{"frequency_hz", 0.1}, {"actuations", actuations}};
  request["supply"] = {{"configurations", {"co2"}}};
  request["ranking"] = {{"count", 1}, {"list", "combinations"}, {"proof", true}};
  request.erase("require");
  return request;
}

int Bottles(const Json& answer) {
  for (const Json& row : answer["designs"][0]["parts"])
    if (row["family"] == "co2") return row["quantity"];
  return 0;
}

TEST(Mission, AShortOneNeedsOneCartridge) {
  const Json answer = Answered(Asked(14));
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Bottles(answer), 1);
  EXPECT_EQ(Refusals(answer), "");
}

TEST(Mission, ALongerOneIsNeverLighter) {
  double before_kg = 0.0;
  for (const double actuations : {14.0, 60.0, 300.0, 3000.0}) {
    const Json answer = Answered(Asked(actuations));
    ASSERT_FALSE(answer["designs"].empty());
    const double mass_kg = answer["designs"][0]["totals"]["mass_kg"];
    EXPECT_GE(mass_kg, before_kg * (1.0 - 1e-9)) << actuations;
    before_kg = mass_kg;
  }
}

// What bottles hold is not what they give in so short a time, nor what a tank still fills at the
// end.
TEST(Mission, WhatWouldMakeItPossibleDoes) {
  Json bottles = Asked(2000);
  bottles["actuators"] = Json::parse(R"([ { "rest_volume_ml": 530, "expansion_ratio": 3,
      "operating_pressure_kpa_gauge": 266, "tube_length_m": 0.2, "rise_time_s_max": 13,
      "fall_time_s_max": 5.4, "pressure_kpa_gauge_max": 271.3 } ])");
  bottles["duty"]["frequency_hz"] = 0.018;
  bottles["supply"] = {{"configurations", {"co2"}}, {"volume_l_max", 2.7}, {"parts", "orderable"}};
  bottles["objective"] = {{"minimize", "volume_l"}};
  Json tanks = Asked(100);
  tanks["actuators"] = Json::parse(R"([ { "count": 6, "rest_volume_ml": 8.81,
      "expansion_ratio": 1.5, "operating_pressure_kpa_gauge": 264, "tube_length_m": 2,
      "rise_time_s_max": 0.032, "fall_time_s_max": 0.17, "pressure_kpa_gauge_max": 528 } ])");
  tanks["duty"]["frequency_hz"] = 2.2;
  tanks["supply"] = {{"configurations", {"tank"}}, {"source_pressure_kpa_gauge_max", 400}};
  for (Json request : {bottles, tanks}) {
    const Json answer = Answered(request);
    ASSERT_EQ(answer["status"], "infeasible");
    ASSERT_FALSE(answer["relaxation"].empty());
    for (const Json& entry : answer["relaxation"]) {
      EXPECT_NE(entry["value"], entry["required"]) << entry;
      const Json::json_pointer place(entry["requirement"].get<std::string>());
      if (entry["value"].is_null())
        request[place.parent_pointer()].erase(place.back());
      else
        request[place] = entry["value"];
    }
    EXPECT_EQ(Answered(request)["status"], "optimal") << answer["relaxation"];
  }
}

}  // namespace mission_test
}  // namespace plenum::api
