// A regulator of each group in requests, answers and given designs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace regulation_test {

using testing::HasSubstr;

Json Orthosis(const char* regulation = "any") {
  Json request = Example("orthosis");
  request["supply"]["regulation"] = regulation;
  request["ranking"] = {{"count", 3}, {"proof", true}};
  return request;
}

Json RegulatorsOf(const Json& design) {
  Json groups = Json::array();
  for (const Json& row : design["parts"])
    if (row["family"] == "regulator") groups.push_back(row["group"]);
  return groups;
}

TEST(RegulationTest, TwoPressuresFromOneBottle) {
  const Json answer = Answered(Orthosis("per_group"));
  ASSERT_EQ(answer["status"], "optimal");
  const Json& best = answer["designs"][0];
  EXPECT_EQ(RegulatorsOf(best), (Json{"plantar", "dorsi"}));
  const Json& pressures = best["settings"]["group_pressure_kpa_gauge"];
  ASSERT_EQ(pressures.size(), 2u);
  EXPECT_GT(pressures[0], 620.5);
  EXPECT_GT(pressures[1], 206.8);
  EXPECT_LT(pressures[1], pressures[0]);
  EXPECT_EQ(best["settings"]["source_pressure_kpa_gauge"], pressures[0]);
  // What a late valve lets in keeps the limit of 35 psi.
  EXPECT_LE(best["performance"]["groups"][1]["peak_kpa_gauge"], 241.32);
  bool manifold = false;
  for (const Json& row : best["parts"]) manifold = manifold || row["family"] == "manifold";
  EXPECT_TRUE(manifold);  // two regulators on one bottle
  EXPECT_EQ(best["response"]["groups"].size(), 2u);
  EXPECT_EQ(Refusals(answer), "");
}

TEST(RegulationTest, AnyIsNoWorseThanEither) {
  const auto best = [](const char* regulation) {
    const Json answer = Answered(Orthosis(regulation));
    return answer["designs"].empty() ? 1e9 : answer["designs"][0]["objective"].get<double>();
  };
  const double any = best("any");
  EXPECT_NEAR(any, std::min(best("per_group"), best("shared")), 1e-9 * any);
}

TEST(RegulationTest, ADesignIsEvaluatedAsItWasListed) {
  const Json request = Orthosis("per_group");
  const Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& answer = std::get<Json>(evaluated);
  EXPECT_EQ(answer["works"], true);
  EXPECT_NEAR(answer["totals"]["mass_kg"].get<double>(), design["totals"]["mass_kg"].get<double>(),
              1e-9);
  ASSERT_EQ(answer["margins"].size(), design["margins"].size());
  for (std::size_t i = 0; i < answer["margins"].size(); ++i)
    EXPECT_NEAR(answer["margins"][i]["achieved"].get<double>(),
                design["margins"][i]["achieved"].get<double>(),
                1e-6 * design["margins"][i]["achieved"].get<double>());
}

TEST(RegulationTest, WhatAGivenDesignLacksIsNamed) {
  const Json request = Orthosis("per_group");
  const Json design = Answered(request)["designs"][0];
  const auto pointers = [&](const Json& asked, const auto& change) {
    Json changed = design;
    change(changed);
    std::string all;
    for (const Error& error : ErrorsOf(Evaluated(asked, changed))) all += error.pointer + " ";
    return all;
  };
  EXPECT_EQ(pointers(request, [](Json& d) { d["settings"].erase("group_pressure_kpa_gauge"); }),
            "/design/settings/group_pressure_kpa_gauge ");
  EXPECT_EQ(pointers(request, [](Json& d) { d["settings"]["source_pressure_kpa_gauge"] = 300; }),
            "/design/settings/source_pressure_kpa_gauge ");
  EXPECT_EQ(pointers(request,
                     [](Json& d) {
                       std::erase_if(d["parts"].get_ref<Json::array_t&>(), [](const Json& row) {
                         return row["family"] == "regulator" && row["group"] == "dorsi";
                       });
                     }),
            "/design/parts ");
  Json shared = request;
  shared["supply"]["regulation"] = "shared";
  EXPECT_THAT(pointers(shared, [](Json&) {}), HasSubstr("/group"));
}

TEST(RegulationTest, WhatHasNoneOfItsOwnIsSaid) {
  Json request = Orthosis("per_group");
  request["supply"]["configurations"] = {"cylinder", "compressor"};
  const auto parsed = ParseRequirements(request, Project().parts);
  const auto* asked = std::get_if<DesignRequest>(&parsed);
  ASSERT_TRUE(asked);
  std::string warned;
  for (const Json& warning : asked->remarks.warnings)
    warned += warning["pointer"].get<std::string>() + warning["detail"].get<std::string>();
  EXPECT_THAT(warned, HasSubstr("/supply/regulation"));
  EXPECT_THAT(warned, HasSubstr("compressor"));
  EXPECT_THAT(warned, Not(HasSubstr("of cylinder")));
  request["supply"]["regulation"] = "each";
  const Errors errors = ErrorsOf(ParseRequirements(request, Project().parts));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/supply/regulation");
}

}  // namespace regulation_test
}  // namespace plenum::api
