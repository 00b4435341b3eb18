// Given parts at given settings, against the search that listed them and the simulator.
#include "api/design/given/evaluation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace evaluation_test {

class Evaluation : public testing::TestWithParam<const char*> {
 protected:
  Evaluation() {
    const std::filesystem::path root = test::SourceDir();
    parts_ = catalog::Store(root / "catalog.db", catalog::Access::kRead).List();
    std::ifstream file(root / "examples" / (std::string(GetParam()) + ".json"));
    requirements_ = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
    requirements_["ranking"] = {{"count", 1}, {"time_limit_s", 200}};
    const auto request = std::get<DesignRequest>(ParseRequirements(requirements_, parts_));
    const Json answer = AnswerRequest(request, {}, parts_);
    listed_ = answer.at("designs").at(0);
    given_ = {{"configuration", listed_.at("configuration")}, {"parts", Json::array()}};
    for (const Json& part : listed_.at("parts")) {
      Json row = {
          {"family", part.at("family")}, {"id", part.at("id")}, {"quantity", part.at("quantity")}};
      if (!part.at("group").is_null()) row["group"] = part.at("group");
      given_["parts"].push_back(std::move(row));
    }
    given_["settings"] = {
        {"source_pressure_kpa_gauge", listed_.at("settings").at("source_pressure_kpa_gauge")},
        {"reservoir_volume_ml", listed_.at("settings").at("reservoir_volume_ml")}};
  }

  Parsed<Json> Run(const Json& requirements, const Json& design) const {
    return RunEvaluation(
        {{"schema", "evaluation/1"}, {"requirements", requirements}, {"design", design}}, parts_,
        {});
  }
  Json Answer(const Json& requirements, const Json& design) const {
    return std::get<Json>(Run(requirements, design));
  }

  std::vector<catalog::Part> parts_;
  Json requirements_, listed_, given_;
};

double MarginOf(const Json& answer, const std::string& requirement) {
  for (const Json& margin : answer.at("margins"))
    if (margin.at("requirement") == requirement) return margin.at("relative_margin");
  ADD_FAILURE() << requirement;
  return 0.0;
}

TEST_P(Evaluation, GivesAListedDesignItsOwnFigures) {
  const Json answer = Answer(requirements_, given_);
  ASSERT_TRUE(answer.at("works").get<bool>());
  for (const char* total : {"mass_kg", "volume_l", "energy_wh"})
    EXPECT_NEAR(answer["totals"][total].get<double>() / listed_["totals"][total].get<double>(), 1.0,
                1e-9)
        << total;
  ASSERT_EQ(answer["margins"].size(), listed_["margins"].size());
  for (const Json& margin : listed_["margins"])
    EXPECT_NEAR(MarginOf(answer, margin["requirement"]), margin["relative_margin"].get<double>(),
                1e-8)
        << margin["requirement"];
  const Json& range = answer["source_pressure_range_kpa_gauge"];
  EXPECT_LE(range[0], listed_["settings"]["source_pressure_kpa_gauge"]);
  EXPECT_GE(range[1], listed_["settings"]["source_pressure_kpa_gauge"]);
}

TEST_P(Evaluation, SaysByHowMuchRequirementsAreMissed) {
  Json harder = requirements_;
  const double rise_s = listed_["performance"]["groups"][0]["rise_time_s"];
  harder["actuators"][0]["rise_time_s_max"] = rise_s / 2;
  harder["actuators"][0]["fall_time_s_max"] = 1e-3;
  const Json answer = Answer(harder, given_);
  ASSERT_TRUE(answer.at("works").get<bool>());
  EXPECT_NEAR(MarginOf(answer, "/actuators/0/rise_time_s_max"), -1.0, 1e-6);
  EXPECT_LT(MarginOf(answer, "/actuators/0/fall_time_s_max"), -10.0);
}

TEST_P(Evaluation, TwiceTheActuationsTakeTwiceTheEnergyOfTheCycles) {
  const Json once = Answer(requirements_, given_);
  const double n = requirements_["duty"]["actuations"];
  const auto energy = [&](double factor) {
    return Answer(With(requirements_, "/duty/actuations", factor * n),
                  given_)["totals"]["energy_wh"]
        .get<double>();
  };
  EXPECT_NEAR(energy(3) - energy(2), energy(2) - energy(1), 1e-6 * energy(1));
  EXPECT_GT(energy(2), energy(1));
}

TEST_P(Evaluation, RefusesWhatItCannotRead) {
  EXPECT_NE(DetailAt(ErrorsOf(Run(Without(requirements_, "/duty"), given_)), "/requirements/duty"),
            "");
  EXPECT_NE(
      DetailAt(ErrorsOf(Run(requirements_, Without(given_, "/settings"))), "/design/settings"), "");
  EXPECT_NE(DetailAt(ErrorsOf(Run(requirements_, With(given_, "/parts/0/group", "nobody"))),
                     "/design/parts/0/group"),
            "");
}

TEST_P(Evaluation, RefusesAnUnknownPart) {
  const Json gone = With(given_, "/parts/0/id", "no such part");
  EXPECT_NE(DetailAt(ErrorsOf(Run(requirements_, gone)), "/design/parts/0/id"), "");
}

TEST_P(Evaluation, DoesNotWorkBeyondWhatThePartsStand) {
  const Json burst =
      Answer(requirements_, With(given_, "/settings/source_pressure_kpa_gauge", 4e4));
  EXPECT_FALSE(burst.at("works").get<bool>());
  EXPECT_LT(burst.at("source_pressure_range_kpa_gauge").at(1), 4e4);
  const std::string detail = burst.at("detail");
  EXPECT_EQ(detail.find("the source pressure of 40000 kPa gauge is above the range that works, "),
            0u)
      << detail;
  const Json slack = Answer(requirements_, With(given_, "/settings/source_pressure_kpa_gauge", 1));
  EXPECT_NE(slack.at("detail").get<std::string>().find(" is below the range that works, "),
            std::string::npos);
}

// Groups that are not alike and inflate at once out of one reservoir are simulated.
TEST(EvaluationInTime, OutOfTimeItSaysThatNothingIsKnown) {
  std::ifstream file(test::SourceDir() / "tests/fuzz/corpus/evaluation/two_groups");
  Json request = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
  request["requirements"]["duty"]["simultaneous"] = true;
  request["requirements"]["actuators"][1]["rest_volume_ml"] = 40.0;
  const auto run = [&](double seconds_max) {
    return std::get<Json>(RunEvaluation(request, SmallCatalogue(), {}, seconds_max));
  };
  const Json whole = run(600.0), cut = run(0.0);
  EXPECT_EQ(whole.at("works"), true);
  EXPECT_FALSE(whole.contains("detail"));
  EXPECT_TRUE(cut.at("works").is_null());
  EXPECT_NE(cut.at("detail").get<std::string>().find("out of time after 0 s"), std::string::npos);
  EXPECT_EQ(cut.at("source_pressure_range_kpa_gauge"), whole.at("source_pressure_range_kpa_gauge"));
  EXPECT_FALSE(cut.contains("margins"));
}

// What needs no simulation takes no time that could run out.
TEST_P(Evaluation, ASingleGroupNeedsNoTime) {
  if (requirements_["actuators"].size() > 1) GTEST_SKIP();
  const Json request = {
      {"schema", "evaluation/1"}, {"requirements", requirements_}, {"design", given_}};
  EXPECT_EQ(std::get<Json>(RunEvaluation(request, parts_, {}, 0.0)), Answer(requirements_, given_));
}

INSTANTIATE_TEST_SUITE_P(Examples, Evaluation, testing::Values("exosuit", "gripper", "crawler"));

}  // namespace evaluation_test
}  // namespace plenum::api
