// plenum diagnose with a recording in a dialect: it asks, is answered, and repeats what it read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "api/json/json.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace recording_command_test {

using testing::HasSubstr;

class RecordingCommand : public testing::Test {
 protected:
  void SetUp() override {
    bench_.Write("rig.json", R"({
      "actuator": { "rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100 },
      "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
      "supply": { "kind": "regulated", "source_pressure_kpa_gauge": 200 } })");
    std::string csv = "Zeit;Druck [bar];Ventil\n";
    const char* bar[] = {"0",    "0,2",  "0,5",  "0,75", "0,9",  "0,98",
                         "1,01", "0,99", "0,42", "0,12", "0,03", "0,01"};
    for (int i = 0; i < 12; ++i)
      csv += std::to_string(10 * i) + ";" + bar[i] + ";" + (i > 0 && i < 7 ? "auf" : "zu") + "\n";
    bench_.Write("bench.csv", csv);
  }

  Workbench bench_;
};

TEST_F(RecordingCommand, AsksForAUnitAndTakesTheAnswer) {
  const auto asked = bench_.Run("diagnose bench.csv --rig rig.json");
  EXPECT_EQ(asked.status, 2);
  EXPECT_THAT(asked.err, HasSubstr("in which unit is it?"));
  EXPECT_THAT(asked.err, HasSubstr("--column \"Zeit=t_s [s]\""));
  const auto told =
      bench_.Run("diagnose bench.csv --rig rig.json --column 'Zeit=t_s [ms]' --time-limit 0.05");
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_THAT(told.out, HasSubstr("columns by semicolon, decimal comma"));
  EXPECT_THAT(told.out, HasSubstr("on is inflate, off is deflate"));
  const auto json = bench_.Run(
      "diagnose bench.csv --rig rig.json --column 'Zeit=t_s [ms]' --time-limit 0.05 --json");
  const auto understood = api::Json::parse(json.out)["measurement"]["understood"][0];
  EXPECT_EQ(understood["file"], "bench.csv");
  EXPECT_EQ(understood["columns"][0]["factor"], 0.001);
  EXPECT_EQ(understood["runs"][0]["readings"], 12);
}

// The curves of its diagnosis, where the recording stands apart, take the same answers.
TEST_F(RecordingCommand, CurvesTakeTheAnswersThatTheDiagnosisTook) {
  const std::string table = " --rig rig.json --column 'Zeit=t_s [ms]'";
  const auto told = bench_.Run("diagnose bench.csv" + table + " --time-limit 0.05 --json");
  ASSERT_EQ(told.status, 0) << told.err;
  bench_.Write("answer.json", told.out);
  const auto asked =
      bench_.Run("simulate --from answer.json --measurement bench.csv --rig rig.json");
  EXPECT_EQ(asked.status, 2);
  EXPECT_THAT(asked.err, HasSubstr("in which unit is it?"));
  const auto curves = bench_.Run(
      "simulate --from answer.json --model declared --measurement bench.csv" + table + " --json");
  ASSERT_EQ(curves.status, 0) << curves.err;
  EXPECT_EQ(api::Json::parse(curves.out)["runs"][0]["t_s"].size(), 12u);
}

}  // namespace recording_command_test
}  // namespace plenum::server
