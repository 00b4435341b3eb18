// A part measured with several bottles.
#include "api/measure/fitted/bottles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "api/measure/measurement.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace bottles_test {

using testing::HasSubstr;

Json RunOf(const char* id, const char* bottle, double volume_ml) {
  return {{"id", id},
          {"specimen", bottle},
          {"rig", {{"actuator", {{"rest_volume_ml", volume_ml}}}}},
          {"source_pressure_kpa_gauge", 200.0},
          {"valve", Json::array({{{"t_s", 0.0}, {"state", "inflate"}}})},
          {"t_s", {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}},
          {"pressure_kpa_gauge", {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0}}};
}

Json Document() {
  Json pair = {{"part", "valve-1"},
               {"measure", Json::array({"sonic_conductance"})},
               {"sonic_conductance_dm3_per_s_bar", 0.2},
               {"critical_ratio", 0.3}};
  return {{"schema", "measurement/1"},
          {"rig",
           {{"actuator",
             {{"rest_volume_ml", 1000.0},
              {"expansion_ratio", 1.0},
              {"operating_pressure_kpa_gauge", 200.0}}},
            {"line", {{"elements", Json::array({pair})}}},
            {"supply", {{"kind", "regulated"}}}}},
          {"holdout", Json::array({"r3"})},
          {"runs", Json::array({RunOf("r1", "small", 500.0), RunOf("r2", "large", 1000.0),
                                RunOf("r3", "large", 1000.0)})}};
}

calibration::Dataset Data(Remarks* remarks = nullptr) {
  const auto parsed = ParseMeasurement(Document(), remarks);
  for (const Error& error : ErrorsOf(parsed)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<calibration::Dataset>(parsed);
}

Json AnswerOf(double fitted, double uncertainty, const char* refused = nullptr) {
  return {{"verdict", "explained"},
          {"measured_refused", refused ? Json::array({refused}) : Json::array()},
          {"measured", Json::array({{{"part", "valve-1"},
                                     {"number", "sonic_conductance"},
                                     {"fitted", fitted},
                                     {"uncertainty", uncertainty},
                                     {"refused", nullptr}}})}};
}

TEST(Bottles, TheOneWithTheMostRunsComesFirst) {
  const auto bottles = RunsByBottle(Data());
  ASSERT_EQ(bottles.size(), 2u);
  EXPECT_EQ(bottles[0].bottle, "large");
  EXPECT_EQ(bottles[0].runs, (std::vector<std::size_t>{1, 2}));
  const calibration::Dataset large = OnlyRuns(Data(), bottles[0].runs);
  ASSERT_EQ(large.runs.size(), 2u);
  EXPECT_EQ(large.runs[0].id, "r2");
  EXPECT_TRUE(large.specimens.empty());
  EXPECT_EQ(large.holdout, std::vector<std::string>{"r3"});
  EXPECT_EQ(OnlyRuns(Document(), bottles[0].runs)["runs"].size(), 2u);
  EXPECT_TRUE(OnlyRuns(Document(), bottles[1].runs)["holdout"].empty());
  calibration::Dataset nothing = Data();
  nothing.measured.clear();
  EXPECT_TRUE(RunsByBottle(nothing).empty());
}

// C goes with the declared volume: 20 % of volume is 20 % of C.
TEST(Bottles, ThatDisagreeRefuseTheRevisionByName) {
  const auto bottles = RunsByBottle(Data());
  Json refused = Json::array();
  const Json off = CompareBottles(AnswerOf(0.442, 0.0044), bottles[0], AnswerOf(0.531, 0.005),
                                  bottles[1], Data(), refused);
  EXPECT_EQ(off["numbers"][0]["agrees"], false);
  ASSERT_EQ(refused.size(), 1u);
  EXPECT_EQ(refused[0],
            "sonic_conductance is 0.442 and 0.531 by large (1000 ml) and small (500 ml), more "
            "apart than the uncertainties of both: one of these volumes is wrong");
  refused = Json::array();
  const Json alike = CompareBottles(AnswerOf(0.53, 0.0044), bottles[0], AnswerOf(0.533, 0.005),
                                    bottles[1], Data(), refused);
  EXPECT_EQ(alike["numbers"][0]["agrees"], true);
  EXPECT_EQ(alike["runs"], Json::array({"r1"}));
  EXPECT_TRUE(refused.empty());
  CompareBottles(AnswerOf(0.53, 0.0044), bottles[0], AnswerOf(0.53, 0.005, "it leaks"), bottles[1],
                 Data(), refused);
  EXPECT_THAT(refused.dump(), HasSubstr("confirm nothing: it leaks"));
}

TEST(Bottles, AVolumeOfWhichNothingIsSaidIsAssumed) {
  Remarks remarks;
  const calibration::Dataset data = Data(&remarks);
  EXPECT_EQ(data.relative_uncertainty[static_cast<std::size_t>(calibration::Declared::kRestVolume)],
            0.02);
  EXPECT_THAT(remarks.warnings.dump(), HasSubstr("2 % is assumed"));
  Json stated = Document();
  stated["relative_uncertainty"] = {{"rest_volume", 0.0}};
  EXPECT_EQ(std::get<calibration::Dataset>(ParseMeasurement(stated))
                .relative_uncertainty[static_cast<std::size_t>(calibration::Declared::kRestVolume)],
            0.0);
}

}  // namespace bottles_test
}  // namespace plenum::api
