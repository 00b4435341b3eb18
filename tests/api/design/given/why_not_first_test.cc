// Why a given design is not first, against searches that are forced to its parts.
#include "api/design/given/why_not_first.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace why_not_first_test {

class WhyNotFirst : public testing::TestWithParam<const char*> {
 protected:
  WhyNotFirst() {
    const std::filesystem::path root = test::SourceDir();
    parts_ = catalog::Store(root / "catalog.db", catalog::Access::kRead).List();
    std::ifstream file(root / "examples" / (std::string(GetParam()) + ".json"));
    requirements_ = Parse(std::string(std::istreambuf_iterator<char>(file), {}));
    requirements_["ranking"] = {{"count", 8}, {"time_limit_s", 200}};
    designs_ = Search(requirements_).at("designs");
  }

  Json Search(const Json& requirements) const {
    const auto parsed = ParseRequirements(requirements, parts_);
    for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
    return AnswerRequest(std::get<DesignRequest>(parsed), {}, parts_);
  }

  Json Evaluated(const Json& requirements, const Json& design) const {
    return std::get<Json>(RunEvaluation({{"schema", "evaluation/1"},
                                         {"requirements", requirements},
                                         {"design", design},
                                         {"beside", designs_.at(0)}},
                                        parts_, {}));
  }
  Json Why(const Json& design) const {
    return Evaluated(requirements_, design).at("why_not_first");
  }

  // The best design of these parts and no others; none: null.
  Json BestOf(const Json& design) const {
    Json requirements = requirements_;
    requirements["ranking"] = {{"count", 1}, {"time_limit_s", 200}, {"list", "combinations"}};
    requirements["supply"]["configurations"] = Json::array({design.at("configuration")});
    std::map<std::string, std::set<std::string>> ids;
    for (const Json& part : design.at("parts"))
      if (part.at("family") != "manifold")  // it follows from the others
        ids[part.at("family")].insert(part.at("id"));
    for (const auto& [family, of_family] : ids) requirements["require"][family] = of_family;
    const Json found = Search(requirements).at("designs");
    return found.empty() ? Json(nullptr) : found.at(0);
  }

  std::vector<catalog::Part> parts_;
  Json requirements_, designs_;
};

std::string Joined(const Json& words) {
  std::string text;
  for (const Json& sentence : words) text += sentence.get<std::string>() + "\n";
  return text;
}

TEST_P(WhyNotFirst, SharesOfThePartsMakeUpTheDifference) {
  ASSERT_GE(designs_.size(), 3U);
  for (const Json& design : designs_) {
    SCOPED_TRACE(design.at("rank"));
    const Json why = Why(design);
    const double difference =
        design.at("objective").get<double>() - designs_.at(0).at("objective").get<double>();
    EXPECT_NEAR(why.at("difference"), difference, 1e-6);
    double sum = why.at("energy_difference");
    for (const Json& part : why.at("parts")) sum += part.at("difference").get<double>();
    EXPECT_NEAR(sum, why.at("difference"), 1e-9);
    EXPECT_TRUE(why.at("missed").empty());
    EXPECT_EQ(why.at("best_settings").at("status"), "feasible");
  }
}

TEST_P(WhyNotFirst, TheFirstIsNoneButItself) {
  const Json why = Why(designs_.at(0));
  EXPECT_NEAR(why.at("difference"), 0.0, 1e-9);
  EXPECT_TRUE(why.at("exchanges").empty());
  EXPECT_NE(Joined(why.at("words")).find("comes to the same"), std::string::npos);
}

// An exchange is a search's best of those parts, but for pieces in parallel and for groups that may
// have each other's lines, which a search is free to change for the better.
TEST_P(WhyNotFirst, NoSearchFindsLessOfTheExchangedParts) {
  int compared = 0;
  for (const Json& design : designs_) {
    if (design.at("configuration") != designs_.at(0).at("configuration")) continue;
    SCOPED_TRACE(design.at("rank"));
    const Json why = Why(design);
    for (const Json& exchange : why.at("exchanges")) {
      Json exchanged = design;
      for (const Json& part : exchange.at("parts"))
        for (Json& row : exchanged["parts"])
          if (row.at("family") == part.at("family") && row.at("group") == part.at("group"))
            row["id"] = part.at("first").at("id");
      const Json best = BestOf(exchanged);
      if (exchange.at("status") != "feasible") continue;
      ASSERT_FALSE(best.is_null());
      EXPECT_GE(exchange.at("objective").get<double>(),
                best.at("objective").get<double>() * (1.0 - 1e-6));
      // Nor does any of them beat the first of all.
      EXPECT_GE(exchange.at("objective").get<double>(),
                designs_.at(0).at("objective").get<double>() * (1.0 - 1e-6));
      ++compared;
      if (compared >= 6) return;
    }
  }
}

TEST_P(WhyNotFirst, WhatIsMissedIsSaidAndWhetherOtherSettingsHelp) {
  Json slower = designs_.at(1);
  const double range_low =
      Evaluated(requirements_, slower).at("source_pressure_range_kpa_gauge")[0];
  double& source = slower["settings"]["source_pressure_kpa_gauge"].get_ref<double&>();
  source = range_low + 0.5 * (source - range_low);
  const Json answer = Evaluated(requirements_, slower);
  const Json& why = answer.at("why_not_first");
  EXPECT_EQ(why.at("best_settings").at("status"), "feasible");
  EXPECT_NEAR(why.at("best_settings").at("totals").at("mass_kg"),
              designs_.at(1).at("totals").at("mass_kg").get<double>(), 1e-6);
  const std::string words = Joined(why.at("words"));
  if (answer.at("works") == false) {
    EXPECT_NE(words.find("it does not work"), std::string::npos) << words;
    EXPECT_NE(words.find("Its parts meet all requirements at"), std::string::npos) << words;
  } else if (!why.at("missed").empty()) {
    EXPECT_NE(words.find("It misses a requirement: the "), std::string::npos) << words;
  }
}

TEST_P(WhyNotFirst, PartsThatCanNotMeetItAreToldSo) {
  Json hard = requirements_;
  const double fall_s = designs_.at(1).at("performance").at("groups")[0].at("fall_time_s");
  hard["actuators"][0]["fall_time_s_max"] = 0.9 * fall_s;
  const Json why = Evaluated(hard, designs_.at(1)).at("why_not_first");
  ASSERT_EQ(why.at("missed").size(), 1U);
  EXPECT_EQ(why.at("missed")[0].at("requirement"), "/actuators/0/fall_time_s_max");
  EXPECT_EQ(why.at("best_settings").at("status"), "infeasible");
  EXPECT_NE(Joined(why.at("words")).find("No settings of its parts"), std::string::npos);
}

TEST_P(WhyNotFirst, AWrongDesignBesideIsRefused) {
  const auto run = [&](const Json& beside) {
    return RunEvaluation({{"schema", "evaluation/1"},
                          {"requirements", requirements_},
                          {"design", designs_.at(0)},
                          {"beside", beside}},
                         parts_, {});
  };
  EXPECT_NE(DetailAt(ErrorsOf(run(With(designs_.at(0), "/parts/0/id", "no such part"))),
                     "/beside/parts/0/id"),
            "");
  EXPECT_NE(
      DetailAt(ErrorsOf(run(With(designs_.at(0), "/settings/source_pressure_kpa_gauge", 4e4))),
               "/beside"),
      "");
}

INSTANTIATE_TEST_SUITE_P(Examples, WhyNotFirst, testing::Values("exosuit", "gripper", "crawler"));

}  // namespace why_not_first_test
}  // namespace plenum::api
