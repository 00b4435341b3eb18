// How to measure each part of a catalogue, and what its test would tell.
#include "api/protocol/protocol_document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <variant>

#include "api/measure/measurement.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/protocols.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace protocol_document_test {

Json Of(const char* family, const TestSensor& sensor = {}) {
  return RenderProtocol(PartOf(family), sensor);
}

double Uncertainty(const Json& protocol, const std::string& field) {
  for (const Json& row : protocol["tests"][0]["precision"])
    if (row["field"] == field) return row["uncertainty"].get<double>();
  ADD_FAILURE() << field << " is not told";
  return 0.0;
}

TEST(Protocol, EveryTestHasStepsAndAPrecisionForEachOfItsNumbers) {
  for (const catalog::Part& part : SmallCatalogue()) {
    const Json protocol = RenderProtocol(part, {});
    std::size_t tests = 0;
    for (const Protocol& known : Protocols()) tests += known.family == part.family;
    ASSERT_EQ(protocol["tests"].size(), tests) << part.family;
    for (const Json& test : protocol["tests"]) {
      EXPECT_FALSE(test["steps"].empty()) << part.family << test["protocol"];
      std::set<std::string> told;
      for (const Json& row : test["precision"]) {
        told.insert(row["field"].get<std::string>());
        EXPECT_GT(row["uncertainty"].get<double>(), 0.0);
        EXPECT_NEAR(row["uncertainty"].get<double>(),
                    std::hypot(row["from_noise"].get<double>(), row["from_rig"].get<double>()),
                    1e-9);
      }
      told.insert("pressure_min_kpa_gauge");  // of a valve that has none
      for (const Json& number : test["numbers"])
        EXPECT_TRUE(told.contains(number.get<std::string>())) << part.family << number;
    }
  }
}

// What is printed is a measurement but for its readings.
TEST(Protocol, TheTemplateIsReadOnceItHasReadings) {
  for (const char* family : {"valve", "fitting", "regulator", "compressor"}) {
    Json document = Of(family)["tests"][0]["recording"]["template"];
    for (Json& run : document["runs"]) {
      run["t_s"] = {0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7};
      run["pressure_kpa_gauge"] = {0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0};
    }
    Errors errors;
    const Json filled = WithParts(document, SmallCatalogue(), errors);
    ASSERT_TRUE(errors.empty()) << family;
    const auto parsed = ParseMeasurement(filled);
    for (const Error& error : ErrorsOf(parsed))
      ADD_FAILURE() << family << error.pointer << error.detail;
    ASSERT_TRUE(std::holds_alternative<calibration::Dataset>(parsed));
    EXPECT_FALSE(std::get<calibration::Dataset>(parsed).measured.empty());
  }
}

// The diagnosis is told of the steps of the sensor that the test was planned with.
TEST(Protocol, TheTemplateStatesTheSensor) {
  for (const char* family : {"valve", "fitting", "regulator", "compressor"}) {
    const auto rig = [&](double resolution_kpa) {
      return Of(family,
                {.resolution_kpa = resolution_kpa})["tests"][0]["recording"]["template"]["rig"];
    };
    EXPECT_EQ(rig(0.25).at("sensor"), Json({{"resolution_kpa", 0.25}})) << family;
    EXPECT_FALSE(rig(0.0).contains("sensor")) << family;
  }
}

TEST(Protocol, ABetterSensorTellsMore) {
  const Json fine = Of("valve", {.noise_kpa = 0.05, .resolution_kpa = 0.0, .bottle_l = 1.0});
  const Json coarse = Of("valve", {.noise_kpa = 2.0, .resolution_kpa = 0.0, .bottle_l = 1.0});
  for (const char* field :
       {"sonic_conductance_fill_dm3_per_s_bar", "critical_ratio_fill", "critical_ratio_exhaust"})
    EXPECT_LT(Uncertainty(fine, field), Uncertainty(coarse, field)) << field;
}

// C is no better known than the volume of the bottle, 0.2 %, however good the sensor.
TEST(Protocol, AConductanceIsNoBetterThanItsBottle) {
  const Json fine = Of("valve", {.noise_kpa = 0.01, .resolution_kpa = 0.0});
  EXPECT_GE(Uncertainty(fine, "sonic_conductance_fill_dm3_per_s_bar"), 0.002);
}

TEST(Protocol, ASlowAndNoisySensorCannotTellTheKnee) {
  const Json slow = Of("valve", {.noise_kpa = 50.0, .sampling_hz = 1.0, .bottle_l = 0.1});
  bool warned = false;
  for (const Json& row : slow["tests"][0]["precision"]) warned = warned || row["told"] == false;
  EXPECT_TRUE(warned);
  EXPECT_THAT(slow["tests"][0]["warnings"].dump(), testing::HasSubstr("cannot tell"));
}

TEST(Protocol, OtherParameterIsRefusedByName) {
  const auto parsed = ParseTestSensor({{"bottle_l", "0"}, {"sampling_hz", "fast"}});
  EXPECT_THAT(DetailAt(ErrorsOf(parsed), "/bottle_l"), testing::HasSubstr("0.01"));
  EXPECT_THAT(DetailAt(ErrorsOf(parsed), "/sampling_hz"), testing::HasSubstr("fast"));
  const auto good = ParseTestSensor({{"bottle_l", "2"}});
  EXPECT_EQ(std::get<TestSensor>(good).bottle_l, 2.0);
}

}  // namespace protocol_document_test
}  // namespace plenum::api
