// What a recording leaves open is asked, and each answer settles it; what is wrong names its line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/measurement.h"

namespace plenum::api {
namespace open_test {

using testing::HasSubstr;

const Json& Rig() {
  static const Json kRig = Json::parse(R"({
    "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100 },
    "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
    "supply": { "kind": "regulated" } })");
  return kRig;
}

catalog::TableOptions Answer(const std::string& heading, const std::string& answer) {
  catalog::TableOptions options;
  options.columns[heading] = answer;
  return options;
}

// The only question, with no error beside it.
catalog::Question QuestionOf(const std::string& csv, const Json& rig = Rig(),
                             const catalog::TableOptions& options = {}) {
  const CsvReading reading = ReadMeasurementCsv(csv, rig, options);
  EXPECT_TRUE(reading.errors.empty()) << reading.errors.front().detail;
  EXPECT_EQ(reading.questions.size(), 1U) << csv;
  return reading.questions.empty() ? catalog::Question{} : reading.questions.front();
}

std::string ErrorOf(const std::string& csv) {
  const CsvReading reading = ReadMeasurementCsv(csv, Rig());
  return reading.errors.empty()
             ? "none"
             : reading.errors.front().pointer + ": " + reading.errors.front().detail;
}

Json RunOf(const std::string& csv, const Json& rig = Rig(),
           const catalog::TableOptions& options = {}) {
  const CsvReading reading = ReadMeasurementCsv(csv, rig, options);
  EXPECT_TRUE(reading.errors.empty() && reading.questions.empty());
  return reading.document.is_null() ? Json() : reading.document["runs"][0];
}

std::string StateAt(const Json& run, std::size_t command) {
  return run["valve"].size() > command ? run["valve"][command]["state"].get<std::string>() : "none";
}

TEST(RecordingQuestions, UnitOfTime) {
  const std::string csv = "Time,p [kPa],valve\n0,0,hold\n10,1,inflate\n";
  const auto question = QuestionOf(csv);
  EXPECT_EQ(question.heading, "Time");
  EXPECT_THAT(question.text, HasSubstr("in which unit"));
  EXPECT_THAT(question.answers, testing::Contains("t_s [ms]"));
  EXPECT_EQ(RunOf(csv, Rig(), Answer("Time", "t_s [ms]"))["t_s"][1], 0.01);
}

TEST(RecordingQuestions, UnitOfPressure) {
  const std::string csv = "t [s],pressure,valve\n0,0,hold\n1,1,inflate\n";
  EXPECT_EQ(QuestionOf(csv).heading, "pressure");
  const Json run = RunOf(csv, Rig(), Answer("pressure", "pressure_kpa_gauge [psi]"));
  EXPECT_NEAR(run["pressure_kpa_gauge"][1].get<double>(), 6.894757293168361, 1e-12);
}

TEST(RecordingQuestions, GaugeOrAbsoluteNearAmbient) {
  const std::string csv = "t [s],p [bar],valve\n0,1.01,hold\n1,1.02,inflate\n2,2.0,inflate\n";
  const auto question = QuestionOf(csv);
  EXPECT_THAT(question.text, HasSubstr("absolute or gauge"));
  ASSERT_EQ(question.answers.size(), 2U);
  EXPECT_NEAR(RunOf(csv, Rig(), Answer("p [bar]", question.answers[0]))["pressure_kpa_gauge"][2]
                  .get<double>(),
              100.0, 1e-9);
  EXPECT_NEAR(RunOf(csv, Rig(), Answer("p [bar]", question.answers[1]))["pressure_kpa_gauge"][2]
                  .get<double>(),
              200.0, 1e-9);
  // An assumption of the measurement settles it, too; then the diagnosis converts.
  const Json assumed = {{"rig", Rig()}, {"assume", {"as_written"}}};
  EXPECT_NEAR(RunOf(csv, assumed)["pressure_kpa_gauge"][2].get<double>(), 200.0, 1e-9);
}

TEST(RecordingQuestions, OneOfTwoPressuresSaysAbsolute) {
  const auto question =
      QuestionOf("t [s],p_abs [bar],supply pressure [bar],valve\n0,1,3,hold\n1,1.5,3,inflate\n");
  EXPECT_EQ(question.heading, "supply pressure [bar]");
}

TEST(RecordingQuestions, VoltsNeedAScale) {
  const std::string csv = "Time,Channel A,valve\n(ms),(V),\n0,0.5,hold\n1,2.5,inflate\n";
  const auto question = QuestionOf(csv);
  EXPECT_THAT(question.text, HasSubstr("Channel A"));
  EXPECT_THAT(QuestionOf(csv, Rig(), Answer("Channel A", question.answers.at(0))).text,
              HasSubstr("is in V"));
  const std::string volts = "t [s],p [V],valve\n0,0.5,hold\n1,2.5,inflate\n";
  EXPECT_THAT(QuestionOf(volts).text, HasSubstr("scale of the sensor"));
  const Json run =
      RunOf(volts, Rig(), Answer("p [V]", "pressure_kpa_gauge [0.5 V = 0 psi; 4.5 V = 30 psi]"));
  EXPECT_NEAR(run["pressure_kpa_gauge"][1].get<double>(), 15.0 * 6.894757293168361, 1e-9);
}

TEST(RecordingQuestions, WhatOffMeansIsSeenOrAsked) {
  const std::string head = "t [s],p [kPa],valve\n0,0,0\n1,0,1\n2,80,1\n";
  // Falls to ambient after the valve is off.
  EXPECT_EQ(StateAt(RunOf(head + "3,100,0\n4,20,0\n5,2,0\n"), 2), "deflate");
  EXPECT_EQ(StateAt(RunOf(head + "3,100,0\n4,99,0\n5,97,0\n"), 2), "hold");
  // Neither; never; and much more slowly than it was filled.
  for (const char* rest :
       {"3,100,0\n4,70,0\n5,50,0\n", "3,100,1\n", "3,100,0\n40,60,0\n60,40,0\n1000,1,0\n"}) {
    const auto question = QuestionOf(head + rest);
    EXPECT_EQ(question.heading, "valve");
    EXPECT_THAT(question.text, HasSubstr("hold or deflate"));
    ASSERT_EQ(question.answers.size(), 2U);
    EXPECT_EQ(StateAt(RunOf(head + rest, Rig(), Answer("valve", question.answers[0])), 0),
              "deflate");
    EXPECT_EQ(StateAt(RunOf(head + rest, Rig(), Answer("valve", question.answers[1])), 0), "hold");
  }
  EXPECT_THAT(QuestionOf("t [s],p [kPa],vent valve\n0,0,off\n1,10,on\n").text,
              HasSubstr("hold or inflate"));
}

TEST(RecordingQuestions, ValveOfARunWithoutItsColumn) {
  const std::string csv = "t [s],p [kPa]\n0,0\n1,0\n2,60\n3,95\n4,96\n5,95\n6,20\n7,1\n";
  const auto question = QuestionOf(csv);
  EXPECT_EQ(question.option, "valve");
  ASSERT_EQ(question.answers.size(), 1U);
  const Json suggested = Json::parse(question.answers[0]);
  EXPECT_EQ(suggested[0]["t_s"], 1.0);
  EXPECT_EQ(suggested[1]["t_s"], 5.0);
  Json document = {{"rig", Rig()}};
  document["runs"].push_back({{"id", "bench 7"}, {"valve", suggested}});
  const Json run = RunOf(csv, document);
  EXPECT_EQ(run["id"], "bench 7");
  EXPECT_EQ(run["valve"], suggested);
  // The measurement is there for a page to draw, though not yet complete.
  EXPECT_FALSE(ReadMeasurementCsv(csv, Rig()).document.is_null());
}

TEST(RecordingQuestions, DecimalsOrThousands) {
  const std::string csv = "t [ms];p [Pa];valve\n0;0;hold\n10;1,234;inflate\n20;2,345;inflate\n";
  EXPECT_EQ(QuestionOf(csv).option, "decimal");
  catalog::TableOptions options;
  options.decimal = "comma";
  EXPECT_EQ(RunOf(csv, Rig(), options)["pressure_kpa_gauge"][1], 0.001234);
  // With a decimal comma elsewhere, none stands between thousands.
  EXPECT_EQ(RunOf("t [s];p [kPa];valve\n0,5;0;hold\n1;1,234;inflate\n")["pressure_kpa_gauge"][1],
            1.234);
}

TEST(RecordingQuestions, ColumnsThatClashOrAreMisspelt) {
  EXPECT_THAT(QuestionOf("t [s],P1 [bar],P2 [bar],valve\n0,0,0,hold\n").text,
              HasSubstr("both give"));
  EXPECT_THAT(QuestionOf("t_s,pressure_kpa_gauge,valve,temprature_k\n0,0,hold,1\n").text,
              HasSubstr("temperature_k"));
  EXPECT_THAT(QuestionOf("a,b\n1,2\n", Rig(), Answer("b", "pressure_kpa_gauge [bar gauge]")).text,
              HasSubstr("time"));
  EXPECT_THAT(QuestionOf("t [s],p [apples],valve\n0,0,hold\n").text, HasSubstr("apples"));
}

TEST(RecordingQuestions, SourcePressureIsThatOfItsColumn) {
  const Json run = RunOf(
      "t_s,pressure_kpa_gauge,valve,source_pressure_kpa_gauge\n0,0,hold,201\n1,1,inflate,190\n"
      "2,1,inflate,200\n");
  EXPECT_EQ(run["source_pressure_kpa_gauge"], 200.0);
}

TEST(RecordingErrors, NameLineColumnAndCell) {
  const std::string head = "t [s];p [bar];valve\n";
  EXPECT_THAT(ErrorOf(head + "0;0;hold\n1;O.5;hold\n"), HasSubstr("line 3, p [bar]"));
  EXPECT_THAT(ErrorOf(head + "0;0;hold\n1;O.5;hold\n"), HasSubstr("\"O.5\""));
  EXPECT_THAT(ErrorOf(head + "0;0;hold\n1;0.5;opne\n"), HasSubstr("nearest: open"));
  EXPECT_THAT(ErrorOf(head + "0;0;hold\n1;0.5\n"), HasSubstr("line 3, row: has 2 cells"));
  EXPECT_THAT(ErrorOf(head + "5;0;hold\n1;0.5;hold\n"), HasSubstr("must not fall"));
  EXPECT_THAT(ErrorOf(head + "0;0;hold\n1;0.5;\n"), HasSubstr("must not be empty"));
  EXPECT_THAT(ErrorOf("t [s],p [bar],valve\n0,0,0,5,hold\n"), HasSubstr("decimal mark"));
  EXPECT_THAT(ErrorOf("t [s],p [kPa],fill valve,vent valve\n0,0,1,1\n"), HasSubstr("both valves"));
  EXPECT_THAT(ErrorOf("t [s],p [kPa],command\n0,0,1\n1,0,2\n2,0,3\n3,0,4\n4,0,5\n"),
              HasSubstr("say what the numbers mean"));
  EXPECT_THAT(ErrorOf(head), HasSubstr("must hold a reading"));
  EXPECT_THAT(ErrorOf(""), HasSubstr("empty"));
  EXPECT_THAT(ErrorOf("Zeit;p [bar];valve\n12:03:04;0;hold\n7;0;hold\n"), HasSubstr("clock time"));
}

TEST(RecordingErrors, MissingReadingsAreNone) {
  const Json run =
      RunOf("t [s],p [kPa],valve\n0,,hold\n1,NaN,hold\n2,∞,hold\n3,-,hold\n4,1,hold\n");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_TRUE(run["pressure_kpa_gauge"][i].is_null());
  EXPECT_EQ(run["pressure_kpa_gauge"][4], 1.0);
}

TEST(RecordingErrors, OptionsAndRigAreChecked) {
  EXPECT_THAT(ReadMeasurementCsv("t_s,p [bar]\n", Json::array()).errors.front().detail,
              HasSubstr("object"));
  Json rig = {{"rig", Rig()}, {"csv", {{"delimiter", "colon"}}}};
  EXPECT_EQ(ReadMeasurementCsv("t_s,p [bar]\n", rig).errors.front().pointer, "/csv/delimiter");
  const auto wrong = ReadMeasurementCsv("t_s,p [bar]\n0,0\n", Rig(), Answer("p [bar]", "presure"));
  EXPECT_THAT(wrong.errors.front().detail, HasSubstr("no field"));
  const auto absent = ReadMeasurementCsv("t_s,p [bar]\n0,0\n", Rig(), Answer("q", ""));
  EXPECT_THAT(absent.errors.front().detail, HasSubstr("no column"));
}

}  // namespace open_test
}  // namespace plenum::api
