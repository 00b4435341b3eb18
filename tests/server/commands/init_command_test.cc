// plenum init: answers become requirements that plenum design takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "api/catalogue/stores.h"
#include "api/design/read/requirements_reader.h"
#include "server/commands/exit_status.h"
#include "server/commands/init/interview.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace init_command_test {

using api::Json;
using testing::HasSubstr;

Json Document(const std::string& text) { return std::get<Json>(api::ParseJson(text)); }

TEST(Init, AnswersStandInTheDocumentAndDesignTakesIt) {
  const Workbench bench;
  const std::string answers =
      "gripper\nfinger\n4\n8\n1.5\n60\n1\n150 ms\n0,25\nno\n1\n10000\nmains\n6 bar\n200\nmass_kg\n";
  const auto outcome = bench.Run("init my.json", answers);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("plenum design my.json"));
  const Json document = Document(ReadAll(bench.Path("my.json")));
  const Json& group = document["actuators"][0];
  EXPECT_EQ(group["name"], "finger");
  EXPECT_EQ(group["count"], 4);
  EXPECT_EQ(group["rise_time_s_max"], "150 ms");
  EXPECT_EQ(group["fall_time_s_max"], "0,25 s");
  EXPECT_EQ(document["supply"]["configurations"], Json::array({"mains"}));
  EXPECT_EQ(document["supply"]["mains"]["pressure_kpa_gauge"], "6 bar");
  for (const Json* object : {&document, &group, &document["duty"], &document["supply"],
                             &document["supply"]["mains"], &document["objective"]})
    EXPECT_TRUE(object->contains("note")) << object->dump();

  // The same numbers as examples/gripper.json, so the same best design.
  const auto designed = bench.Run("design my.json --top 1 --json");
  ASSERT_EQ(designed.status, 0) << designed.err;
  const auto example = bench.Run("design - --top 1 --json", Example("gripper", 30.0).dump());
  EXPECT_EQ(Document(designed.out)["designs"][0]["parts"],
            Document(example.out)["designs"][0]["parts"]);
}

TEST(Init, ActuatorsBelowAmbientGetASupplyOfVacuum) {
  const Workbench bench;
  // Two groups; the volume that was to grow is asked for again.
  const auto outcome = bench.Run("init my.json",
                                 "picker\ncup\n4\n12\n\n-0.6 bar\n0.9\n1\n300 ms\n300 ms\nyes\n"
                                 "jam\n1\n250\n0.85\n-10 psi\n1\n0.8\n0.8\nno\nno\nevery 5 s\n2 h\n"
                                 "ejector\n6 bar\n200\nmass_kg\n");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json document = Document(ReadAll(bench.Path("my.json")));
  EXPECT_EQ(document["actuators"][0]["expansion_ratio"], 0.9);
  EXPECT_EQ(document["actuators"][1]["expansion_ratio"], 0.85);
  EXPECT_EQ(document["actuators"][1]["operating_pressure_kpa_gauge"], "-10 psi");
  EXPECT_FALSE(document["supply"].contains("configurations"));
  EXPECT_EQ(document["supply"]["vacuum"]["configurations"], Json::array({"ejector"}));
  EXPECT_EQ(document["supply"]["mains"]["pressure_kpa_gauge"], "6 bar");
  const auto designed = bench.Run("design my.json --top 1");
  ASSERT_EQ(designed.status, 0) << designed.err;
  EXPECT_THAT(designed.out, HasSubstr("\"2 h\" = 1440 actuations"));
  const auto mixed =
      bench.Run("init other.json", "picker\ncup\n4\n12\n1\n-60\n1\n1\n1\nyes\njam\n1\n9\n1\n80\n");
  EXPECT_EQ(mixed.status, 2);  // pressures of either kind are no one request
}

TEST(Init, WithoutAnswersTheDefaultsAreADocument) {
  const Workbench bench;
  const auto outcome = bench.Run("init -");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto parts = catalog::Store(bench.catalog(), catalog::Access::kRead).List();
  const auto parsed = api::ParseRequirements(Document(outcome.out), parts);
  EXPECT_TRUE(std::holds_alternative<api::DesignRequest>(parsed));
}

TEST(Init, WhatIsNeitherYesNorNoIsNotTakenForNo) {
  const Workbench bench;
  const auto outcome =
      bench.Run("init my.json", "gripper\nfinger\n4\n8\n1.5\n60\n1\n150 ms\n0,25\n0.5\n2000\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("0.5: yes or no is asked here"));
}

TEST(Init, ABadAnswerIsNamedAndNothingIsWritten) {
  const Workbench bench;
  const auto outcome = bench.Run("init my.json", "gripper\nfinger\nmany\n");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.err, HasSubstr("answer many to \"How many of them\""));
  EXPECT_FALSE(std::filesystem::exists(bench.Path("my.json")));
}

TEST(Init, AFileThatIsThereIsKept) {
  const Workbench bench;
  bench.Write("my.json", "mine");
  const auto outcome = bench.Run("init my.json");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(ReadAll(bench.Path("my.json")), "mine");
  EXPECT_EQ(bench.Run("init my.json --replace").status, 0);
  EXPECT_NE(ReadAll(bench.Path("my.json")), "mine");
}

TEST(Init, APersonIsAskedAgain) {
  std::istringstream answers("robot\nfinger\nmany\n3\n");
  std::string said;
  const auto judge = [](const Json& document) -> Opinion {
    if (document.at("actuators").at(0).at("count").is_number()) return {{}, ""};
    return {{{"/actuators/0/count", "must be a number"}}, ""};
  };
  Interview interview{.answers = answers,
                      .say = [&](const std::string& text) { said += text; },
                      .person = true,
                      .judge = judge};
  const Json document = AskRequirements(interview);
  EXPECT_EQ(document["actuators"][0]["count"], 3);
  EXPECT_THAT(said, HasSubstr("must be a number"));
}

TEST(Init, AWarningIsNotRepeated) {
  std::istringstream answers("robot\nfinger\n3\n20\n1\n");
  std::string said;
  const auto judge = [](const Json& document) -> Opinion {
    return {{}, document.at("actuators").at(0).at("count") == 3 ? "three is few\n" : ""};
  };
  Interview interview{.answers = answers,
                      .say = [&](const std::string& text) { said += text; },
                      .person = true,
                      .judge = judge};
  AskRequirements(interview);
  EXPECT_EQ(said.find("three is few"), said.rfind("three is few"));
  EXPECT_THAT(said, HasSubstr("three is few"));
}

TEST(Init, AFurtherGroupHasANameOfItsOwn) {
  const Workbench bench;
  // Of the first group only the name, which the second one would have had.
  const auto outcome = bench.Run("init -", "robot\nactuator_2\n\n\n\n\n\n\n\nyes\n");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json document = Document(outcome.out);
  ASSERT_EQ(document["actuators"].size(), 2u);
  EXPECT_NE(document["actuators"][0]["name"], document["actuators"][1]["name"]);
}

}  // namespace init_command_test
}  // namespace plenum::server
