// Savings of tests are what searches say that know the numbers.
#include <gtest/gtest.h>

#include <cmath>

#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace savings_test {

using Rows = std::vector<catalog::Part>;

Json Answered(const Json& request, const Rows& rows) {
  return AnswerRequest(std::get<DesignRequest>(ParseRequirements(request, rows)), {}, rows);
}

double Objective(const Json& answer) {
  return answer["designs"].empty() ? INFINITY : answer["designs"][0]["objective"].get<double>();
}

// The catalogue after a test that found every number as printed, without an error.
void Know(const Json& test, Rows& rows) {
  for (catalog::Part& row : rows) {
    if (row.id != test["part"]) continue;
    for (const Json& number : test["numbers"]) {
      const auto field = number.get<std::string>();
      if (field == "free_air") row.curve->free_air_uncertainty = 0.0;
      if (field == "current") row.curve->current_uncertainty = 0.0;
      if (row.numbers.contains(field)) row.numbers[field].uncertainty = 0.0;
    }
  }
}

Json Guaranteed(const char* example, int count) {
  Json request = Example(example);
  request["guarantee"] = true;
  request["ranking"] = {{"count", count}, {"time_limit_s", 60}};
  return request;
}

// An exosuit whose few parts are searched in no time.
Json FewParts() {
  Json request = Guaranteed("exosuit", 3);
  request["supply"]["configurations"] = {"compressor"};
  request["require"] = {{"compressor", {"parker-btc-iis-14.8v"}},
                        {"valve", {"asco-rhf20xx80x-pair", "asco-rhb20xx80x-pair"}},
                        {"fitting", {"generic-push-on-4mm-barb-3-mm", "generic-pc4-m5"}},
                        {"tubing", {"smc-t0403"}}};
  return request;
}

TEST(Savings, OfTwoTestsOfAPumpIsThatOfASearchThatKnows) {
  const Json request = FewParts();
  const Json answer = Answered(request, Project().parts);
  ASSERT_EQ(answer["status"], "optimal");
  ASSERT_TRUE(answer["measure_first_complete"]);
  int pairs = 0;
  for (const Json& test : answer["measure_first"]) {
    Rows rows = Project().parts;
    Know(test, rows);
    if (test.contains("with")) {
      EXPECT_EQ(test["with"]["part"], test["part"]);
      Know(test["with"], rows);
      ++pairs;
    }
    EXPECT_NEAR(Objective(answer) - Objective(Answered(request, rows)),
                test["saving"].get<double>(), 1e-9)
        << test.dump(1);
  }
  EXPECT_EQ(pairs, 1) << answer["measure_first"].dump(1);
}

// The parts of a design alone.
Json Requiring(Json request, const Json& design) {
  request["require"] = Json::object();
  for (const Json& row : design["parts"])
    if (row["family"] != "manifold")
      request["require"][row["family"].get<std::string>()] = {row["id"]};
  request["supply"]["configurations"] = {design["configuration"]};
  return request;
}

void ExpectNeeded(const Json& request, const Json& answer) {
  ASSERT_FALSE(answer["measure_together"].empty());
  for (const Json& item : answer["measure_together"]) {
    Rows known = Project().parts;
    for (const Json& test : item["tests"]) Know(test, known);
    const double reached = item["objective"].get<double>();
    EXPECT_NEAR(Objective(answer) - reached, item["saving"].get<double>(), 1e-9);
    EXPECT_LE(Objective(Answered(request, known)), reached * (1.0 + 1e-6));
    const Json& design = answer["on_paper"]["designs"][item["rank"].get<std::size_t>() - 1];
    const Json alone = Requiring(request, design);
    EXPECT_NEAR(Objective(Answered(alone, known)), reached, 1e-6 * reached);
    for (const Json& left_out : item["tests"]) {
      Rows fewer = Project().parts;
      for (const Json& test : item["tests"])
        if (test != left_out) Know(test, fewer);
      EXPECT_GT(Objective(Answered(alone, fewer)), reached * (1.0 + 1e-6)) << left_out.dump();
    }
  }
}

TEST(Savings, TogetherTestsMakeADesignOnPaperAGuaranteedOne) {
  const Json request = Guaranteed("gripper", 5);
  ExpectNeeded(request, Answered(request, Project().parts));
}

TEST(Savings, TogetherTestsOfAPumpMakeADesignOnPaperAGuaranteedOne) {
  const Json request = FewParts();
  ExpectNeeded(request, Answered(request, Project().parts));
}

}  // namespace savings_test
}  // namespace plenum::api
