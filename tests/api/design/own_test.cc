// Parts at hand cost nothing and change nothing else.
#include <gtest/gtest.h>

#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace own_test {

Json ByCost() {
  Json request = Example("gripper");
  request["objective"] = {{"minimize", "cost_eur"}};
  request["ranking"] = {{"count", 1}, {"proof", true}};
  return request;
}

double Cost(const Json& answer) { return answer["designs"][0]["totals"]["cost_eur"].get<double>(); }

TEST(OwnTest, WhatIsAtHandIsFree) {
  const Json before = Answered(ByCost());
  ASSERT_FALSE(before["designs"].empty());
  ASSERT_EQ(before["price_basis"], "known");
  Json request = ByCost();
  request["own"] = Json::array();
  double saved = 0.0;
  for (const Json& row : before["designs"][0]["parts"])
    if (row["family"] == "valve") {
      request["own"].push_back(row["id"]);
      saved += row["cost_eur"].get<double>();
    }
  ASSERT_GT(saved, 0.0);
  const Json after = Answered(request);
  EXPECT_LE(Cost(after), Cost(before) - saved + 1e-9);
  EXPECT_EQ(Refusals(after), "");
  for (const Json& row : after["designs"][0]["parts"]) {
    const bool own = row.value("own", false);
    EXPECT_EQ(own, row["cost_eur"] == 0.0);
    EXPECT_TRUE(!own || row["family"] == "valve");
  }
}

// By mass the list is the same: what is free is no lighter.
TEST(OwnTest, ALightestDesignStaysTheLightest) {
  Json request = Example("gripper");
  request["ranking"] = {{"count", 1}};
  const Json before = Answered(request);
  for (const Json& row : before["designs"][0]["parts"]) request["own"].push_back(row["id"]);
  const Json after = Answered(request);
  EXPECT_EQ(after["designs"][0]["objective"], before["designs"][0]["objective"]);
  EXPECT_EQ(Cost(after), 0.0);
}

TEST(OwnTest, AnUnknownPartIsNamed) {
  Json request = ByCost();
  request["own"] = {"no-such-part"};
  const auto errors = ErrorsOf(ParseRequirements(request, Project().parts));
  EXPECT_NE(DetailAt(errors, "/own/0").find("no part \"no-such-part\""), std::string::npos);
}

}  // namespace own_test
}  // namespace plenum::api
