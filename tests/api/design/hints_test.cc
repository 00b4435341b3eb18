// Configurations that a request does not name.
#include <gtest/gtest.h>

#include "api/design/answer.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace hints_test {

Json Arm(const Json& configurations) {
  Json request = Example("tank_arm");
  request["supply"] = {{"configurations", configurations}};
  return request;
}

// A bottle weighs more than twice what a tank does here: the hint is what a search of the tank
// finds.
TEST(Hints, SayWhatAnotherConfigurationWouldDo) {
  const Json bottle = Answered(Arm(Json::array({"cylinder"})));
  ASSERT_TRUE(bottle.contains("hints"));
  bool tank_named = false;
  for (const Json& hint : bottle["hints"]) {
    const double objective = hint["objective"];
    EXPECT_LE(objective, 0.9 * bottle["designs"][0]["objective"].get<double>());
    const Json other = Answered(Arm(Json::array({hint["configuration"]})));
    EXPECT_NEAR(other["designs"][0]["objective"].get<double>(), objective, 1e-6 * objective);
    tank_named = tank_named || hint["configuration"] == "tank";
  }
  EXPECT_TRUE(tank_named);
  for (const Json& design : bottle["designs"]) EXPECT_EQ(design["configuration"], "cylinder");
}

TEST(Hints, AreNotGivenWhereAllAreNamedOrNoneIs) {
  EXPECT_FALSE(Answered(Arm(Json::array({"tank", "cylinder", "co2", "compressor"})))
                   .value("hints", Json::array())
                   .size() > 1);  // but for the pump without a reservoir
  Json request = Example("tank_arm");
  request.erase("supply");
  EXPECT_FALSE(Answered(request).contains("hints"));
}

// Pumps alone do not fill sixty fingers so fast, but mains that the request has do.
TEST(Hints, NameADesignWhereTheNamedConfigurationsHaveNone) {
  Json request = Example("gripper");
  request["supply"] = {{"configurations", {"direct_pump"}},
                       {"mains", {{"pressure_kpa_gauge", 600}}}};
  request["actuators"][0]["count"] = 60;
  const Json answer = Answered(request);
  ASSERT_EQ(answer["status"], "infeasible");
  bool mains = false;
  for (const Json& hint : answer.at("hints")) mains = mains || hint["configuration"] == "mains";
  EXPECT_TRUE(mains);
}

}  // namespace hints_test
}  // namespace plenum::api
