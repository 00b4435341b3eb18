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
    for (const char* mass : {"mass_kg", "mass_kg_per_m"}) tests += part.numbers.contains(mass);
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

// Unless it was weighed 2 % are assumed, and marked.
TEST(Protocol, TheVolumesUncertaintyIsAssumedUnlessItIsStated) {
  const auto template_of = [](const TestSensor& sensor) {
    return Of("valve", sensor)["tests"][0]["recording"]["template"]["relative_uncertainty"];
  };
  EXPECT_EQ(template_of({})["rest_volume"], 0.02);
  EXPECT_THAT(template_of({})["note"].get<std::string>(), testing::HasSubstr("assumed"));
  EXPECT_EQ(template_of({.bottle_uncertainty = 0.002})["rest_volume"], 0.002);
  EXPECT_FALSE(template_of({.bottle_uncertainty = 0.002}).contains("note"));
  const char* field = "sonic_conductance_fill_dm3_per_s_bar";
  EXPECT_GE(Uncertainty(Of("valve"), field), 0.02);
  EXPECT_LT(Uncertainty(Of("valve", {.bottle_uncertainty = 0.002}), field), 0.01);
}

// One run with another bottle, and the time that the diagnosis of a pump takes.
TEST(Protocol, TheTemplateHasARunOfASecondBottle) {
  for (const char* family : {"valve", "fitting", "regulator", "compressor"}) {
    const Json test = Of(family)["tests"][0];
    const Json& file = test["recording"]["template"];
    ASSERT_EQ(file["runs"].size(), 4u);
    EXPECT_EQ(file["runs"][0]["specimen"], "first bottle");
    EXPECT_EQ(file["runs"][3]["specimen"], "second bottle");
    EXPECT_EQ(file["runs"][3]["rig"]["actuator"]["rest_volume_ml"],
              1e3 * test["equipment"]["check_bottle_l"].get<double>());
    EXPECT_NE(test["equipment"]["check_bottle_l"], test["equipment"]["bottle_l"]);
    EXPECT_EQ(file["time_limit_s"], 300.0);
  }
}

TEST(Protocol, AScaleFitsTheMass) {
  catalog::Part part = PartOf("valve");
  part.numbers["mass_kg"].value = 0.0253;
  const Json protocol = RenderProtocol(part, {});
  const Json& weighing = protocol["tests"].back();
  EXPECT_EQ(weighing["protocol"], "weighing");
  EXPECT_THAT(weighing["steps"].dump(), testing::HasSubstr("step is 0.1 g or less"));
  EXPECT_THAT(weighing["steps"].dump(), testing::HasSubstr("coil"));
  EXPECT_THAT(weighing["steps"].dump(), testing::HasSubstr("catalog measured " + part.id));
  // By hand: 0.1 g/√36 of 25.3 g, and 0.1 %.
  EXPECT_NEAR(weighing["precision"][0]["uncertainty"].get<double>(),
              std::hypot(0.1 / 6.0 / 25.3, 0.001), 1e-6);
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
