#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/design/answer.h"
#include "api/design/sweep/sweep_request.h"
#include "api/design/sweep/sweep_table.h"
#include "catalog/fields/csv_table.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace sweep_test {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// With a patch for each merge, named "0", "1", …
Json SweepOf(const std::vector<Json>& merges) {
  Json patches = Json::array();
  for (const Json& merge : merges)
    patches.push_back({{"name", std::to_string(patches.size())}, {"merge", merge}});
  return {{"schema", "sweep/1"}, {"requirements", Requirements()}, {"patches", patches}};
}
Json Hz(double hz) { return {{"duty", {{"frequency_hz", hz}}}}; }
Parsed<SweepRequest> Read(const Json& sweep) { return ParseSweep(sweep, SmallCatalogue(), {}); }
std::vector<std::string> Pointers(const Parsed<SweepRequest>& parsed) {
  std::vector<std::string> pointers;
  for (const Error& error : ErrorsOf(parsed)) pointers.push_back(error.pointer);
  return pointers;
}

TEST(Sweep, EachPatchIsLaidOverTheRequirementsAlone) {
  const auto parsed = Read(SweepOf({Hz(0.01), {{"duty", {{"actuations", 7}}}}, Json::object()}));
  const auto& sweep = std::get<SweepRequest>(parsed);
  ASSERT_EQ(sweep.requests.size(), 3u);
  EXPECT_EQ(sweep.requests[0].requirements, With(Requirements(), "/duty/frequency_hz", 0.01));
  EXPECT_EQ(sweep.requests[1].requirements, With(Requirements(), "/duty/actuations", 7));
  EXPECT_EQ(sweep.requests[2].requirements.dump(), Requirements().dump());
  EXPECT_EQ(sweep.plan["varied"], Json({"/duty/frequency_hz", "/duty/actuations"}));
  EXPECT_EQ(sweep.plan["patches"][0]["values"][0], 0.01);
  EXPECT_EQ(sweep.plan["patches"][2]["values"][0], Requirements()["duty"]["frequency_hz"]);
}

TEST(Sweep, NullTakesAFieldAway) {
  Json sweep = SweepOf({{{"objective", nullptr}}});
  sweep["requirements"]["objective"] = {{"minimize", "volume_l"}};
  const auto parsed = Read(sweep);
  EXPECT_FALSE(std::get<SweepRequest>(parsed).requests[0].requirements.contains("objective"));
  EXPECT_EQ(std::get<SweepRequest>(parsed).plan["objective"], Json({{"minimize", "mass_kg"}}));
}

TEST(Sweep, RequirementsMayBeCompleteOnlyWithTheirPatches) {
  Json sweep = SweepOf({{{"duty", Requirements()["duty"]}}});
  sweep["requirements"].erase("duty");
  EXPECT_THAT(ErrorsOf(Read(sweep)), IsEmpty());
  sweep["patches"][0]["merge"] = Json::object();
  EXPECT_THAT(Pointers(Read(sweep)), ElementsAre("/requirements/duty"));
}

TEST(Sweep, ErrorsPointToWhatSaysTheValue) {
  EXPECT_THAT(Pointers(Read(SweepOf({Hz(0.01), Hz(1000), {{"fast", true}}}))),
              ElementsAre("/patches/1/merge/duty/frequency_hz", "/patches/2/merge/fast"));
  // Within a list, which a patch replaces as a whole, and of what it takes away.
  Json actuators = Requirements()["actuators"];
  actuators[0]["count"] = 0;
  EXPECT_THAT(Pointers(Read(SweepOf({{{"actuators", actuators}}, {{"duty", nullptr}}}))),
              ElementsAre("/patches/0/merge/actuators/0/count", "/patches/1/merge/duty"));
  // Of the requirements: said once, however many patches there are.
  Json sweep = SweepOf({Hz(0.01), Hz(0.02)});
  sweep["requirements"]["duty"]["actuations"] = -1;
  EXPECT_THAT(Pointers(Read(sweep)), ElementsAre("/requirements/duty/actuations"));
}

TEST(Sweep, NamesAreUniqueAndPatchesAreObjects) {
  Json sweep = SweepOf({Hz(0.01), Hz(0.02), Json::array()});
  sweep["patches"][1]["name"] = "0";
  EXPECT_THAT(Pointers(Read(sweep)), ElementsAre("/patches/1/name", "/patches/2/merge"));
  EXPECT_THAT(Pointers(Read(SweepOf({}))), ElementsAre("/patches"));
  EXPECT_THAT(Pointers(Read(SweepOf(std::vector<Json>(257, Json::object())))),
              ElementsAre("/patches"));
  EXPECT_THAT(Pointers(Read({{"schema", "sweep/1"}, {"requirements", 3}, {"patches", 4}})),
              ElementsAre("/requirements", "/patches"));
  sweep = SweepOf({Hz(0.01)});
  sweep["patches"][0]["what"] = 1;
  EXPECT_THAT(Pointers(Read(sweep)), ElementsAre("/patches/0/what"));
}

// A row says of an answer what the answer says itself.
TEST(Sweep, ATableHoldsWhatTheAnswersSay) {
  const auto parsed = Read(SweepOf({Hz(0.01), {{"supply", {{"mass_kg_max", 0.01}}}}}));
  const auto& sweep = std::get<SweepRequest>(parsed);
  std::vector<SweptAnswer> answers;
  std::vector<Json> documents;
  for (const SweptRequest& swept : sweep.requests) {
    const auto request = ParseRequirements(swept.requirements, SmallCatalogue());
    documents.push_back(AnswerRequest(std::get<DesignRequest>(request), {}, SmallCatalogue()));
    answers.push_back({"done", SweepRow(documents.back()), "", "/v1/designs/x"});
  }
  const Json table = RenderSweepTable(sweep.plan, answers);
  EXPECT_EQ(table["schema"], "sweep_table/1");
  ASSERT_EQ(table["rows"].size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Json& row = table["rows"][i];
    const Json& designs = documents[i]["designs"];
    EXPECT_EQ(row["name"], std::to_string(i));
    EXPECT_EQ(row["outcome"], documents[i]["status"]);
    EXPECT_EQ(row["gap"], documents[i]["proof"]["gap"]);
    EXPECT_EQ(row["lower_bound"], documents[i]["proof"]["lower_bound"]);
    EXPECT_EQ(row["mass_kg"], designs.empty() ? Json() : designs[0]["totals"]["mass_kg"]);
    EXPECT_EQ(row["parts"].size(), designs.empty() ? 0 : designs[0]["parts"].size());
  }
  EXPECT_EQ(table["rows"][1]["outcome"], "infeasible");
  // In the user's words, with units: no pointer of JSON.
  const auto conflict = table["rows"][1]["conflict"].get<std::string>();
  EXPECT_THAT(conflict, HasSubstr("mass: 0.01 kg asked"));
  EXPECT_THAT(conflict, Not(HasSubstr("/")));
}

TEST(Sweep, CsvKeepsTextsFromBeingFormulas) {
  Json sweep = SweepOf({{{"name", "=1+1"}}, {{"name", "a, \"b\""}}});
  sweep["patches"][0]["name"] = "@SUM(A1)";
  sweep["patches"][1]["name"] = "-2\n+3";
  const auto parsed = Read(sweep);
  const Json table =
      RenderSweepTable(std::get<SweepRequest>(parsed).plan, {{"failed", nullptr, "+why", ""}, {}});
  const auto rows = catalog::ParseTable(SweepCsv(table)).rows;
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0][2], "/name");
  EXPECT_EQ(rows[1][0], "'@SUM(A1)");
  EXPECT_EQ(rows[1][2], "'=1+1");
  EXPECT_EQ(rows[1][rows[1].size() - 2], "'+why");
  EXPECT_EQ(rows[2][0], "'-2\n+3");
  EXPECT_EQ(rows[2][1], "");
  EXPECT_EQ(rows[2][2], "a, \"b\"");
}

}  // namespace sweep_test
}  // namespace plenum::api
