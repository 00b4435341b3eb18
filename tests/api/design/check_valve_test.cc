// Pumps of each actuator whose rows say that they let air back, from the request to the checked
// answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/catalogue/part_document.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/verification.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace check_valve_test {

// The project's, whose pumps let air back.
const std::vector<catalog::Part>& LettingBack() {
  static const std::vector<catalog::Part> parts = [] {
    std::vector<catalog::Part> all = Project().parts;
    for (catalog::Part& part : all)
      if (part.family == "compressor") part.texts["check_valve"].value = "no";
    return all;
  }();
  return parts;
}

Json AnsweredWith(const Json& request, const std::vector<catalog::Part>& parts) {
  const auto parsed = ParseRequirements(request, parts);
  for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
  Json answer = AnswerRequest(std::get<DesignRequest>(parsed), {}, parts);
  answer["catalogue_revision"] = RenderRevisionName(Project().revision);
  return Parse(answer.dump());
}

std::string RefusalsWith(const Json& answer, const std::vector<catalog::Part>& parts) {
  const auto verified = VerifyAnswer(answer, parts, Project().revision, {}, {});
  for (const Error& error : ErrorsOf(verified)) ADD_FAILURE() << error.pointer << error.detail;
  return RefusalsIn(std::get<Json>(verified));
}

Json Kit() {
  Json request = Example("finger_kit");
  request["ranking"] = {{"count", 2}, {"list", "combinations"}, {"proof", true}};
  return request;
}

const Json* CheckValveOf(const Json& design) {
  for (const Json& row : design["parts"])
    if (row["family"] == "check_valve") return &row;
  return nullptr;
}

TEST(CheckValveTest, EachActuatorHasOne) {
  const Json answer = AnsweredWith(Kit(), LettingBack());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(RefusalsWith(answer, LettingBack()), "");
  const Json keeping = AnsweredWith(Kit(), Project().parts);
  for (const Json& design : answer["designs"]) {
    const Json* row = CheckValveOf(design);
    ASSERT_NE(row, nullptr);
    EXPECT_EQ((*row)["quantity"], 4);
    EXPECT_EQ((*row)["id"], "smc-ak2000-02");  // the lightest that says all
    EXPECT_NEAR((*row)["mass_kg"].get<double>(), 4 * 0.1, 1e-9);
  }
  for (const Json& design : keeping["designs"]) EXPECT_EQ(CheckValveOf(design), nullptr);
  const double more_kg = answer["designs"][0]["totals"]["mass_kg"].get<double>() -
                         keeping["designs"][0]["totals"]["mass_kg"].get<double>();
  EXPECT_GE(more_kg, 4 * 0.1 - 1e-9);
}

TEST(CheckValveTest, ADesignIsEvaluatedAsItWasListed) {
  const Json request = Kit();
  const Json design = AnsweredWith(request, LettingBack())["designs"][0];
  const auto evaluated = [&](const Json& one) {
    return RunEvaluation({{"schema", "evaluation/1"}, {"requirements", request}, {"design", one}},
                         LettingBack(), {});
  };
  const auto as_listed = evaluated(design);
  for (const Error& error : ErrorsOf(as_listed)) ADD_FAILURE() << error.pointer << error.detail;
  const Json& answer = std::get<Json>(as_listed);
  EXPECT_EQ(answer["works"], true);
  for (const char* total : {"mass_kg", "energy_wh"}) {
    const double listed = design["totals"][total];
    EXPECT_NEAR(answer["totals"][total].get<double>(), listed, 1e-6 * listed);
  }
  Json without = design;
  Json& rows = without["parts"];
  rows.erase(std::find_if(rows.begin(), rows.end(),
                          [](const Json& row) { return row["family"] == "check_valve"; }));
  std::string said;
  for (const Error& error : ErrorsOf(evaluated(without))) said += error.detail + "\n";
  EXPECT_NE(said.find("has no check_valve: it needs 4"), std::string::npos) << said;
  Json few = design;
  for (Json& row : few["parts"])
    if (row["family"] == "check_valve") row["quantity"] = 3;
  said.clear();
  for (const Error& error : ErrorsOf(evaluated(few))) said += error.detail + "\n";
  EXPECT_NE(said.find("must be 4, one for each actuator, not 3"), std::string::npos) << said;
  // Another row is as good a check valve, and heavier.
  Json other = design;
  for (Json& row : other["parts"])
    if (row["family"] == "check_valve") row["id"] = "smc-ak4000-02";
  const auto heavier = evaluated(other);
  for (const Error& error : ErrorsOf(heavier)) ADD_FAILURE() << error.pointer << error.detail;
  EXPECT_NEAR(std::get<Json>(heavier)["totals"]["mass_kg"].get<double>(),
              design["totals"]["mass_kg"].get<double>() + 4 * (0.155 - 0.1), 1e-9);
}

TEST(CheckValveTest, WithoutOneThereAreNoSuchPumps) {
  Json request = Kit();
  for (const catalog::Part& part : LettingBack())
    if (part.family == "check_valve") request["exclude"].push_back(part.id);
  const Errors errors = ErrorsOf(ParseRequirements(request, LettingBack()));
  EXPECT_NE(DetailAt(errors, "/supply/pumps").find("no check valve"), std::string::npos);
  EXPECT_TRUE(ErrorsOf(ParseRequirements(request, Project().parts)).empty());
}

TEST(CheckValveTest, VerifyRefusesWhatIsTamperedWith) {
  const Json answer = AnsweredWith(Kit(), LettingBack());
  const auto refused = [&](const std::function<void(Json&)>& tamper) {
    Json tampered = answer;
    for (Json& row : tampered["designs"][0]["parts"])
      if (row["family"] == "check_valve") tamper(row);
    return !RefusalsWith(tampered, LettingBack()).empty();
  };
  EXPECT_TRUE(refused([](Json& row) { row["quantity"] = 1; }));
  EXPECT_TRUE(refused([](Json& row) { row["mass_kg"] = 0.1; }));
  EXPECT_TRUE(refused([](Json& row) { row["id"] = "smc-ak2000-01"; }));
  // Pumps of the catalogue that keep the pressure themselves have none.
  EXPECT_NE(RefusalsWith(answer, Project().parts), "");
}

}  // namespace check_valve_test
}  // namespace plenum::api
