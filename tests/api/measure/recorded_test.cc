// What a document may say of its record: the gauge's data sheet, instants that are not exact.
#include <gtest/gtest.h>

#include <cmath>

#include "api/describe/descriptions.h"
#include "api/measure/curves.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/measurement.h"
#include "tests/api/measure/read_dataset.h"
#include "tests/api/support.h"
#include "tests/support/bench/bench_json.h"

namespace plenum::api {
namespace recorded_test {

using calibration::Dataset;
using calibration::Declared;

// A vessel of 200 mL that is filled at 0.5 s and emptied at 3 s.
Json Vessel() {
  Json document = Parse(R"({
    "schema": "measurement/1",
    "rig": { "actuator": { "rest_volume_ml": 200, "expansion_ratio": 1,
                           "operating_pressure_kpa_gauge": 400 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.2, "critical_ratio": 0.3 },
             "supply": { "kind": "regulated" },
             "sensor": { "range_kpa_gauge": [-100, 1000], "resolution_kpa": 0.5,
                         "accuracy_kpa": 2 } },
    "runs": [ { "id": "r", "source_pressure_kpa_gauge": 500, "initial": { "pressure_kpa_gauge": 0 },
                "valve": [ { "t_s": 0.5, "state": "inflate" },
                           { "t_s": "unknown", "state": "hold" },
                           { "t_s": 3.0, "state": "deflate", "uncertainty_s": 0.02 } ] } ] })");
  Json& run = document["runs"][0];
  for (int i = 0; i <= 250; ++i) {
    const double t = 0.02 * i;
    double kpa = 400.0 * std::min(1.0, std::max(0.0, t - 0.5));
    if (t > 3.0) kpa *= std::exp(-(t - 3.0));
    run["t_s"].push_back(t);
    run["pressure_kpa_gauge"].push_back(0.5 * std::round(2.0 * kpa));
  }
  return document;
}

TEST(RecordedDocument, IsReadInSi) {
  const Dataset dataset = Read(Vessel());
  ASSERT_EQ(dataset.runs.size(), 1u);
  const calibration::Run& run = dataset.runs[0];
  EXPECT_EQ(run.sensor.low_pa, run.ambient.pressure_pa - 1e5);
  EXPECT_EQ(run.sensor.high_pa, run.ambient.pressure_pa + 1e6);
  EXPECT_EQ(run.sensor.resolution_pa, 500.0);
  EXPECT_EQ(run.sensor.accuracy_pa, 2000.0);
  EXPECT_DOUBLE_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSensorZero)],
                   2000.0 / calibration::kSensorZeroPa);
  EXPECT_DOUBLE_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSensorGain)],
                   0.002);
  ASSERT_EQ(run.valve_uncertainty_s.size(), 3u);
  EXPECT_EQ(run.valve_uncertainty_s[0], 0.0);
  EXPECT_EQ(run.valve_uncertainty_s[1], calibration::kUnknown);
  EXPECT_EQ(run.valve_uncertainty_s[2], 0.02);
  EXPECT_NEAR(run.valve[1].time_s, 1.5, 0.1);  // where the rise ends
}

TEST(RecordedDocument, ExactCommandsAndNoSensorAreAsBefore) {
  Json document = Vessel();
  document["rig"].erase("sensor");
  document["runs"][0]["valve"][1]["t_s"] = 1.5;
  document["runs"][0]["valve"][2]["uncertainty_s"] = 0;
  const Dataset dataset = Read(document);
  EXPECT_TRUE(dataset.runs[0].valve_uncertainty_s.empty());
  EXPECT_FALSE(dataset.runs[0].sensor.HasRange());
  EXPECT_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSensorZero)], 0.0);
}

TEST(RecordedDocument, ARunMayHaveAnotherGauge) {
  Json document = Vessel();
  document["runs"].push_back(document["runs"][0]);
  document["runs"][1]["id"] = "s";
  document["runs"][1]["rig"] = {{"sensor", {{"range_kpa_gauge", {0, 600}}}}};
  const Dataset dataset = Read(document);
  EXPECT_EQ(dataset.runs[1].sensor.high_pa, dataset.runs[1].ambient.pressure_pa + 6e5);
  EXPECT_EQ(dataset.runs[1].sensor.resolution_pa, 500.0);
}

TEST(RecordedDocument, WhatCannotBeIsNamedWithItsPlace) {
  const auto refused = [](const char* pointer, const Json& value) {
    Json document = Vessel();
    document[Json::json_pointer(pointer)] = value;
    return ErrorsOf(ParseMeasurement(document));
  };
  const auto expect = [&](const char* pointer, const Json& value, const std::string& at,
                          const std::string& text) {
    EXPECT_NE(DetailAt(refused(pointer, value), at).find(text), std::string::npos)
        << pointer << " " << value << ": " << DetailAt(refused(pointer, value), at);
  };
  const std::string range = "/rig/sensor/range_kpa_gauge";
  expect(range.c_str(), {1000, 0}, range, "the lower one first");
  expect(range.c_str(), {0, 1, 2}, range, "");
  expect(range.c_str(), {0, 300}, "/runs/0/pressure_kpa_gauge/63", "beyond the sensor's range");
  expect("/rig/sensor/resolution_kpa", -1, "/rig/sensor/resolution_kpa", "not -1");
  expect("/rig/sensor/resolution_kpa", 900, "/rig/sensor/resolution_kpa", "less than half");
  expect("/rig/sensor/accuracy_kpa", "x", "/rig/sensor/accuracy_kpa", "number");
  expect("/rig/sensor/bits", 12, "/rig/sensor/bits", "");
  expect("/runs/0/valve/1/t_s", "soon", "/runs/0/valve/1/t_s", "number");
  expect("/runs/0/valve/1/uncertainty_s", 0.1, "/runs/0/valve/1/uncertainty_s", "left out");
  expect("/runs/0/valve/2/uncertainty_s", -0.1, "/runs/0/valve/2/uncertainty_s", "not -0.1");
  expect("/runs/0/valve/2/t_s", 0.2, "/runs/0/valve/2/t_s", "0.2 follows 0.5");
  Json crowded = Vessel();
  for (int i = 0; i < 120; ++i)
    crowded["runs"][0]["valve"].push_back({{"t_s", "unknown"}, {"state", "hold"}});
  EXPECT_NE(DetailAt(ErrorsOf(ParseMeasurement(crowded)), "/runs/0/valve").find("at most 100"),
            std::string::npos);
}

// Rounding to 2 kPa of a bench's readings, instants that nobody wrote down, a gauge that is off.
Json Laboratory() {
  Json document = test::MeasurementJson(test::DrawCase(4, test::CaseKind::kFull, "leak"));
  document["rig"]["sensor"] = {{"range_kpa_gauge", {-100, 1000}}, {"accuracy_kpa", 0.3}};
  for (Json& run : document["runs"]) {
    for (Json& command : run["valve"])
      if (command["state"] != "hold") command["t_s"] = "unknown";
    for (Json& kpa : run["pressure_kpa_gauge"])
      if (kpa.is_number()) kpa = kpa.get<double>() + 0.3;
  }
  return document;
}

TEST(RecordedDocument, TheAnswerIsItsModelWithInstantsAndGauge) {
  const Json measurement = Laboratory();
  DiagnosisRequest request;
  request.dataset = Read(measurement);
  request.measurement = measurement;
  request.time_limit_s = 600.0;  // on a loaded machine, too
  const Json answer = Parse(RunDiagnosis(request, {}).answer.dump());
  ASSERT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  EXPECT_EQ(answer.at("effects")[0].at("id"), "leak");
  const Json& zero = answer.at("fitted").at("sensor_zero");
  EXPECT_EQ(zero.at("unit"), "kpa");
  EXPECT_EQ(zero.at("declared"), 0.0);
  EXPECT_LT(std::abs(zero.at("value").get<double>()), 1.0);
  const Json& valve_s = answer.at("runs")[0].at("after").at("valve_s");
  ASSERT_EQ(valve_s.size(), measurement["runs"][0]["valve"].size());
  for (const char* model : {"declared", "before", "after"}) {
    const Parsed<Json> curves =
        RunCurves({{"schema", "simulation/1"}, {"from", answer}, {"model", model}});
    ASSERT_TRUE(std::holds_alternative<Json>(curves)) << DetailAt(ErrorsOf(curves), "/from");
    EXPECT_NEAR(std::get<Json>(curves).at("rms_kpa").get<double>(),
                answer.at(model).at("rms_kpa").get<double>(), 1e-6)
        << model;
  }
}

}  // namespace recorded_test
}  // namespace plenum::api
