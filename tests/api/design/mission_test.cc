// CO2 by the length of the mission: a short one draws on the heat of the bottle itself.
#include <gtest/gtest.h>

#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace {

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

// What bottles hold is not what they give in so short a time.
TEST(Mission, TheActuationsThatWouldBePossibleAre) {
  for (const char* configuration : {"co2", "tank"}) {
    Json request = Asked(3000);
    request["supply"]["configurations"] = {configuration};
    request["supply"]["volume_l_max"] = 0.5;
    request["actuators"][0]["rest_volume_ml"] = 60;
    const Json answer = Answered(request);
    ASSERT_EQ(answer["status"], "infeasible") << configuration;
    const Json& relaxation = answer["relaxation"];
    ASSERT_EQ(relaxation.size(), 1u) << configuration;
    ASSERT_EQ(relaxation[0]["requirement"], "/duty/actuations");
    EXPECT_LT(relaxation[0]["value"], 3000);
    request["duty"]["actuations"] = relaxation[0]["value"];
    EXPECT_EQ(Answered(request)["status"], "optimal") << configuration << relaxation;
  }
}

}  // namespace
}  // namespace plenum::api
