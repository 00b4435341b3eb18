// Manifolds and tees in answers, in given designs and in what requests allow.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace joints_test {

using testing::HasSubstr;

Json Gripper() {
  Json request = Example("gripper");
  request["ranking"] = {{"count", 2}, {"proof", true}};
  return request;
}

Json JointsOf(const Json& design) {
  Json joints = Json::array();
  for (const Json& row : design["parts"])
    if (row["family"] == "manifold") joints.push_back(row);
  return joints;
}

Json Given(const Json& requirements, const Json& design) {
  return {{"schema", "evaluation/1"}, {"requirements", requirements}, {"design", design}};
}

Json WithoutJoints(Json design) {
  Json rows = Json::array();
  for (const Json& row : design["parts"])
    if (row["family"] != "manifold") rows.push_back(row);
  design["parts"] = rows;
  return design;
}

Json WithJoint(const Json& design, const std::string& id, int quantity) {
  Json joined = WithoutJoints(design);
  joined["parts"].push_back({{"family", "manifold"}, {"id", id}, {"quantity", quantity}});
  return joined;
}

TEST(JointsTest, ProductsAloneAreNeverBetterThanAllParts) {
  for (const char* name : {"crawler", "exosuit"})
    for (const char* minimize : {"mass_kg", "cost_eur"}) {
      Json request = Example(name);
      request["objective"] = {{"minimize", minimize}};
      request["ranking"] = {{"count", 1}, {"proof", true}};
      const Json any = Answered(request);
      request["supply"]["parts"] = "orderable";
      const Json products = Answered(request);
      ASSERT_FALSE(products["designs"].empty()) << name << minimize;
      EXPECT_GE(products["designs"][0]["objective"].get<double>(),
                any["designs"][0]["objective"].get<double>() - 1e-9)
          << name << minimize;
      EXPECT_EQ(Refusals(products), "") << name << minimize;
    }
}

TEST(JointsTest, FourLinesMeetInThreeTeesWhichCount) {
  const Json answer = Answered(Gripper());
  const Json& best = answer["designs"][0];
  const Json joints = JointsOf(best);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0]["id"], "ft-pro-2019-8396");
  EXPECT_EQ(joints[0]["quantity"], 3);
  EXPECT_TRUE(joints[0]["group"].is_null());
  double sum = 0.0;
  for (const Json& row : best["parts"]) sum += row["mass_kg"].get<double>();
  EXPECT_NEAR(best["totals"]["mass_kg"].get<double>(), sum, 1e-9);
  EXPECT_FALSE(answer.contains("warnings"));
  EXPECT_EQ(Refusals(answer), "");
}

TEST(JointsTest, VerifyWantsThemAll) {
  const Json answer = Answered(Gripper());
  const Tampering tamperings[] = {
      {"no joint", "parts", [](Json& a) { a["designs"][0] = WithoutJoints(a["designs"][0]); }},
      {"a tee too few", "parts",
       [](Json& a) {
         for (Json& row : a["designs"][0]["parts"])
           if (row["family"] == "manifold") row["quantity"] = 2;
       }},
      {"a lighter joint", "amounts", [](Json& a) {
         for (Json& row : a["designs"][0]["parts"])
           if (row["family"] == "manifold") row["mass_kg"] = 0.001;
       }}};
  ExpectRefused(answer, tamperings);
}

TEST(JointsTest, OneLineHasNone) {
  Json request = Gripper();
  request["actuators"][0]["count"] = 1;
  const Json answer = Answered(request);
  ASSERT_FALSE(answer["designs"].empty());
  for (const Json& design : answer["designs"]) EXPECT_EQ(JointsOf(design).size(), 0U);
}

TEST(JointsTest, AGivenDesignHasThoseThatItNames) {
  const Json requirements = Gripper();
  const Json design = Answered(requirements)["designs"][0];
  const auto evaluate = [&](const Json& given) {
    return RunEvaluation(Given(requirements, given), Project().parts, {});
  };
  const auto mass_kg = [](const Parsed<Json>& answer) {
    return std::get<Json>(answer)["totals"]["mass_kg"].get<double>();
  };
  const auto as_listed = evaluate(design), bare = evaluate(WithoutJoints(design));
  EXPECT_NEAR(mass_kg(as_listed), design["totals"]["mass_kg"].get<double>(), 1e-9);
  EXPECT_FALSE(std::get<Json>(as_listed).contains("warnings"));
  EXPECT_NEAR(mass_kg(as_listed) - mass_kg(bare), 0.015, 1e-9);
  const Json warning = std::get<Json>(bare)["warnings"][0];
  EXPECT_EQ(warning["pointer"], "/design/parts");
  EXPECT_THAT(warning["detail"].get<std::string>(), HasSubstr("4 lines meet"));
  EXPECT_NEAR(
      mass_kg(evaluate(WithJoint(design, "generic-manifold-4mm-4-stations", 1))) - mass_kg(bare),
      0.020, 1e-9);
}

TEST(JointsTest, WhatJoinsNothingIsNamed) {
  const Json requirements = Gripper();
  const Json design = Answered(requirements)["designs"][0];
  const std::string last = "/design/parts/" + std::to_string(WithoutJoints(design)["parts"].size());
  const auto refused = [&](const Json& given, const std::string& field, const std::string& why) {
    const Errors errors = ErrorsOf(RunEvaluation(Given(requirements, given), Project().parts, {}));
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].pointer, last + field);
    EXPECT_THAT(errors[0].detail, HasSubstr(why));
  };
  refused(WithJoint(design, "generic-tee-4mm", 2), "/quantity", "must be 3");
  refused(WithJoint(design, "smc-ss5y3-41-4-stations", 1), "/id", "base for valves of one series");
  refused(WithJoint(design, "no-such-tee", 1), "/id", "no part");
  Json in_a_line = WithJoint(design, "generic-tee-4mm", 3);
  in_a_line["parts"].back()["group"] = requirements["actuators"][0]["name"];
  refused(in_a_line, "/group", "must be left out");
}

TEST(JointsTest, ARequestMayNarrowTheRows) {
  Json request = Gripper();
  request["require"]["manifold"] = {"generic-manifold-4mm-4-stations"};
  const Json joints = JointsOf(Answered(request)["designs"][0]);
  ASSERT_EQ(joints.size(), 1U);
  EXPECT_EQ(joints[0]["id"], "generic-manifold-4mm-4-stations");
  request["require"]["manifold"] = {"smc-ss5y3-41-4-stations"};  // joins none but its valves
  const auto parsed = ParseRequirements(request, Project().parts);
  const Json& warnings = std::get<DesignRequest>(parsed).remarks.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_THAT(warnings[0]["detail"].get<std::string>(), HasSubstr("not counted"));
}

TEST(JointsTest, SeveralBottlesHaveAManifoldForTheirPressure) {
  Json request = Example("exosuit");
  request["supply"]["configurations"] = {"cylinder"};
  request["ranking"] = {{"count", 1}};
  const Json design = Answered(request)["designs"][0];
  std::set<std::string> ids;
  for (const Json& joint : JointsOf(design)) ids.insert(joint["id"].get<std::string>());
  EXPECT_EQ(ids.count("generic-bottle-manifold-2"), 1U);
  EXPECT_EQ(ids.size(), 2U);
}

}  // namespace joints_test
}  // namespace plenum::api
