// Records that drive a run: the valve's opening, a regulator's setpoint, an imposed volume.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "api/measure/csv/measurement_csv.h"
#include "api/measure/curves.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/measurement.h"
#include "tests/api/measure/read_dataset.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace driving_document_test {

using calibration::Dataset;

constexpr double kStepS = 2e-4, kNoiseKpa = 0.1;
constexpr int kEverySteps = 100;

double Opening(double t_s) { return 0.5 - 0.5 * std::cos(3.0 * t_s); }
double SetpointKpa(double t_s) { return 300.0 + 80.0 * std::min(t_s, 2.0); }

// A rigid vessel of 0.4 L behind a pair of 0.05 dm³/(s·bar) that is choked throughout: its pressure
// is the integral of opening times source pressure.
Json Vessel() {
  Json document = Parse(R"({
    "schema": "measurement/1",
    "rig": { "actuator": { "rest_volume_ml": 400, "expansion_ratio": 1,
                           "operating_pressure_kpa_gauge": 60 },
             "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.5 },
             "supply": { "kind": "regulated" } },
    "relative_uncertainty": { "sonic_conductance": 0.03 },
    "runs": [ { "id": "r", "initial": { "pressure_kpa_gauge": 0 },
                "valve": [ { "t_s": 0, "state": "inflate" } ],
                "channels": { "valve_opening": [], "source_setpoint_kpa_gauge": [] } } ] })");
  Json& run = document["runs"][0];
  std::mt19937 random(7);
  std::normal_distribution<double> noise_kpa(0.0, kNoiseKpa);
  double kpa = 0.0;
  for (int i = 0; i <= 60; ++i) {
    const double t = kStepS * kEverySteps * i;
    run["t_s"].push_back(t);
    run["pressure_kpa_gauge"].push_back(kpa + noise_kpa(random));
    run["channels"]["valve_opening"].push_back(Opening(t));
    run["channels"]["source_setpoint_kpa_gauge"].push_back(SetpointKpa(t));
    for (int k = 0; k < kEverySteps; ++k) {  // dp/dt = P0·o·C·p_s/V at the middle of each step
      const double middle = t + kStepS * (k + 0.5);
      const double source_pa = 1e5 + 1e3 * SetpointKpa(middle);
      kpa += kStepS * 1e5 * Opening(middle) * 0.05e-8 * source_pa / 400e-6 / 1e3;
    }
  }
  return document;
}

Json Syringe() {
  Json document = Vessel();
  document["rig"]["supply"] = {{"kind", "none"}};
  document["rig"].erase("line");
  Json& run = document["runs"][0];
  run["valve"] = Json::array({{{"t_s", 0}, {"state", "hold"}}});
  run["volume"] = "imposed";
  run["channels"] = {{"volume_ml", Json::array()}};
  run["pressure_kpa_gauge"].clear();
  std::mt19937 random(8);
  std::normal_distribution<double> noise_kpa(0.0, kNoiseKpa);
  for (int i = 0; i <= 60; ++i) {  // Boyle's law
    const double volume_ml = 400.0 - 100.0 * std::sin(0.05 * i);
    run["channels"]["volume_ml"].push_back(volume_ml);
    run["pressure_kpa_gauge"].push_back(100.0 * 400.0 / volume_ml - 100.0 + noise_kpa(random));
  }
  return document;
}

TEST(DrivingDocument, IsReadInSi) {
  const Dataset vessel = Read(Vessel());
  ASSERT_EQ(vessel.runs.size(), 1u);
  const calibration::Run& run = vessel.runs[0];
  ASSERT_EQ(run.channels.valve_opening.size(), 61u);
  EXPECT_EQ(run.channels.valve_opening[10], Opening(run.t_s[10]));
  EXPECT_NEAR(run.channels.source_setpoint_pa[5], 1e5 + 1e3 * SetpointKpa(run.t_s[5]), 1e-6);
  EXPECT_NEAR(run.source_pressure_pa, 1e5 + 1e3 * SetpointKpa(1.2), 1e-6);  // the largest
  EXPECT_FALSE(run.volume_imposed);
  const Dataset syringe = Read(Syringe());
  ASSERT_EQ(syringe.runs.size(), 1u);
  EXPECT_TRUE(syringe.runs[0].volume_imposed && syringe.runs[0].blocked);
  EXPECT_NEAR(syringe.runs[0].channels.volume_m3[0], 400e-6, 1e-12);
}

TEST(DrivingDocument, WhatCannotBeIsNamedWithItsPlace) {
  const auto expect = [](Json document, const char* pointer, const Json& value,
                         const std::string& at, const std::string& text) {
    document[Json::json_pointer(pointer)] = value;
    const std::string detail = DetailAt(ErrorsOf(ParseMeasurement(document)), at);
    EXPECT_NE(detail.find(text), std::string::npos) << pointer << " " << value << ": " << detail;
  };
  const std::string opening = "/runs/0/channels/valve_opening";
  expect(Vessel(), "/runs/0/channels/valve_opening/3", 1.2, opening + "/3", "not 1.2");
  expect(Vessel(), "/runs/0/channels/valve_opening/3", -0.1, opening + "/3", "not -0.1");
  expect(Vessel(), "/runs/0/channels/valve_opening", {0.5, 0.5}, opening, "61 sample times");
  const std::string setpoint = "/runs/0/channels/source_setpoint_kpa_gauge";
  expect(Vessel(), (setpoint + "/0").c_str(), -5, setpoint + "/0", "not -5");
  expect(Vessel(), "/runs/0/source_pressure_kpa_gauge", -50, "/runs/0/channels",
         "source_setpoint_kpa_gauge");
  Json constant = Vessel();
  constant["runs"][0]["channels"].erase("source_setpoint_kpa_gauge");
  expect(constant, "/name", "no source", "/runs/0/source_pressure_kpa_gauge", "setpoint");
  expect(Syringe(), "/runs/0/channels", Json::object(), "/runs/0/channels", "volume_ml");
  expect(Syringe(), "/runs/0/blocked", true, "/runs/0/blocked", "left out");
  expect(Syringe(), "/runs/0/volume", "told", "/runs/0/volume", "told");
  expect(Syringe(), "/runs/0/channels/volume_ml/4", 0, "/runs/0/channels/volume_ml/4", "not 0");
}

TEST(DrivingDocument, ASetpointOfAnotherSupplyIsToldAndNotUsed) {
  Json document = Vessel();
  document["rig"]["supply"] = {{"kind", "flow"}, {"flow_l_per_min_anr", 5}};
  Remarks remarks;
  const auto parsed = ParseMeasurement(document, &remarks);
  ASSERT_TRUE(std::holds_alternative<Dataset>(parsed));
  EXPECT_TRUE(std::get<Dataset>(parsed).runs[0].channels.source_setpoint_pa.empty());
  ASSERT_EQ(remarks.warnings.size(), 1u);
  EXPECT_EQ(remarks.warnings[0]["pointer"], "/runs/0/channels/source_setpoint_kpa_gauge");
}

Json Diagnosed(const Json& measurement) {
  DiagnosisRequest request;
  request.dataset = Read(measurement);
  request.measurement = measurement;
  return Parse(RunDiagnosis(request, {}).answer.dump());
}

void ExpectStatedErrors(const Json& answer) {
  for (const char* model : {"declared", "before", "after"}) {
    const Parsed<Json> curves =
        RunCurves({{"schema", "simulation/1"}, {"from", answer}, {"model", model}});
    ASSERT_TRUE(std::holds_alternative<Json>(curves)) << DetailAt(ErrorsOf(curves), "/from");
    EXPECT_NEAR(std::get<Json>(curves).at("rms_kpa").get<double>(),
                answer.at(model).at("rms_kpa").get<double>(), 1e-6)
        << model;
  }
}

TEST(DrivingDocument, TheAnswerCarriesTheRecordsAndIsItsModel) {
  const Json measurement = Vessel();
  const Json answer = Diagnosed(measurement);
  EXPECT_EQ(answer.at("verdict"), "adequate") << answer.at("sentence");
  EXPECT_LT(answer.at("after").at("rms_kpa").get<double>(), 1.3 * kNoiseKpa);
  EXPECT_EQ(answer.at("measurement").at("runs")[0].at("channels"),
            measurement["runs"][0]["channels"]);
  ExpectStatedErrors(answer);
}

TEST(DrivingDocument, AnImposedVolumeGoesThroughToTheCurve) {
  const Json measurement = Syringe();
  const Json answer = Diagnosed(measurement);
  EXPECT_EQ(answer.at("verdict"), "adequate") << answer.at("sentence");
  EXPECT_EQ(answer.at("measurement").at("runs")[0].at("volume"), "imposed");
  ExpectStatedErrors(answer);
  const Parsed<Json> curves =
      RunCurves({{"schema", "simulation/1"}, {"from", answer}, {"model", "after"}});
  const Json& run = std::get<Json>(curves).at("runs")[0];
  for (std::size_t i = 0; i < run.at("t_s").size(); ++i)
    EXPECT_NEAR(run.at("channels").at("volume_ml")[i].get<double>(),
                measurement["runs"][0]["channels"]["volume_ml"][i].get<double>(), 0.4);
}

TEST(DrivingDocument, ColumnsOfATableAreItsChannels) {
  std::string csv = "t [s];p [kPa];valve;Valve opening [%];Supply setpoint [bar]\n";
  std::string bare = "t_s,pressure_kpa_gauge,valve,valve_opening,Set pressure (kPa)\n";
  for (int i = 0; i < 20; ++i) {
    const std::string t = std::to_string(0.1 * i), p = std::to_string(3.0 * i);
    csv += t + ";" + p + ";inflate;" + std::to_string(5 * i) + ";" + std::to_string(1.5) + "\n";
    bare += t + "," + p + ",inflate," + std::to_string(0.05 * i) + ",150\n";
  }
  const Json rig = Vessel()["rig"];
  const CsvReading reading = ReadMeasurementCsv(csv, rig, {});
  ASSERT_TRUE(reading.errors.empty() && reading.questions.empty());
  const Json& channels = reading.document["runs"][0]["channels"];
  EXPECT_NEAR(channels.at("valve_opening")[7].get<double>(), 0.35, 1e-12);
  EXPECT_NEAR(channels.at("source_setpoint_kpa_gauge")[7].get<double>(), 150.0, 1e-9);
  Read(reading.document);
  // A set point of nothing that a word names is left out, as ever.
  const CsvReading plain = ReadMeasurementCsv(bare, rig, {});
  ASSERT_TRUE(plain.errors.empty() && plain.questions.empty());
  EXPECT_NEAR(plain.document["runs"][0]["channels"].at("valve_opening")[7].get<double>(), 0.35,
              1e-12);
  EXPECT_FALSE(plain.document["runs"][0]["channels"].contains("source_setpoint_kpa_gauge"));
}

}  // namespace driving_document_test
}  // namespace plenum::api
