#include "api/measure/measurement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "api/measure/csv/measurement_csv.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace measurement_test {

using calibration::Dataset;
using calibration::Declared;

// The contract's example with samples.
Json Example() {
  Json document = Json::parse(R"({
    "schema": "measurement/1", "name": "pneunet bench", "note": "first try",
    "rig": {
      "actuator": { "rest_volume_ml": 50.0, "expansion_ratio": 2.0,
                    "operating_pressure_kpa_gauge": 100.0 },
      "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3,
                "exhaust": { "sonic_conductance_dm3_per_s_bar": 0.04, "critical_ratio": 0.2 },
                "tube": { "inner_diameter_mm": 2.5, "length_m": 0.5 } },
      "supply": { "kind": "regulated" },
      "ambient": { "pressure_kpa_abs": 98.0, "temperature_k": 295.0 } },
    "relative_uncertainty": { "rest_volume": 0.02, "sonic_conductance": "unknown" },
    "runs": [ {
      "id": "r1", "source_pressure_kpa_gauge": 200.0,
      "initial": { "pressure_kpa_gauge": 0.0, "temperature_k": 293.15 },
      "valve": [ { "t_s": 0.0, "state": "hold" }, { "t_s": 0.3, "state": "inflate" } ],
      "channels": { "temperature_k": [] } },
      { "id": "r2", "blocked": true, "source_pressure_kpa_gauge": 250.0,
        "rig": { "line": { "tube": { "length_m": 2.0 } } },
        "valve": [ { "t_s": 0.3, "state": "inflate" } ] } ],
    "holdout": ["r2"] })");
  for (Json& run : document["runs"]) {
    for (int i = 0; i < 10; ++i) {
      run["t_s"].push_back(0.1 * i);
      run["pressure_kpa_gauge"].push_back(i == 4 ? Json(nullptr) : Json(3.0 * i));
      if (run.contains("channels")) run["channels"]["temperature_k"].push_back(293.0 + i);
    }
  }
  return document;
}

Dataset Good(const Json& document) {
  const auto parsed = ParseMeasurement(document);
  if (const auto* errors = std::get_if<Errors>(&parsed)) {
    for (const Error& error : *errors) ADD_FAILURE() << error.pointer << ": " << error.detail;
    return {};
  }
  return std::get<Dataset>(parsed);
}

Errors Bad(const Json& document) {
  const auto parsed = ParseMeasurement(document);
  if (const auto* errors = std::get_if<Errors>(&parsed)) return *errors;
  ADD_FAILURE() << "accepted";
  return {};
}

// One error at the pointer whose detail holds the text.
void ExpectError(const Json& document, const std::string& pointer, const std::string& text) {
  const Errors errors = Bad(document);
  bool found = false;
  std::string all;
  for (const Error& error : errors) {
    found = found || (error.pointer == pointer && error.detail.find(text) != std::string::npos);
    all += error.pointer + ": " + error.detail + "\n";
  }
  EXPECT_TRUE(found) << "no '" << text << "' at " << pointer << " in\n" << all;
}

TEST(Measurement, BecomesADatasetInSi) {
  const Dataset dataset = Good(Example());
  ASSERT_EQ(dataset.runs.size(), 2u);
  const calibration::Run& run = dataset.runs[0];
  EXPECT_EQ(run.pressure_pa.at(2), 98e3 + 6e3);
  EXPECT_TRUE(std::isnan(run.pressure_pa.at(4)));
  EXPECT_EQ(run.source_pressure_pa, 298e3);
  EXPECT_EQ(*run.initial_pressure_pa, 98e3);
  EXPECT_EQ(run.channels.temperature_k.at(3), 296.0);
  ASSERT_EQ(run.line.size(), 2u);
  EXPECT_NEAR(run.line[0].exhaust.sonic_conductance_m3_per_s_pa, 4e-10, 1e-18);
  EXPECT_NEAR(run.line[1].tube->inner_diameter_m, 2.5e-3, 1e-12);
  EXPECT_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)], 0.02);
  EXPECT_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)],
            calibration::kUnknown);
  EXPECT_EQ(dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kCriticalRatio)], 0.0);
  EXPECT_THAT(dataset.holdout, testing::ElementsAre("r2"));
}

TEST(Measurement, ARunsOwnRigIsLaidOverTheSharedOne) {
  const Dataset dataset = Good(Example());
  EXPECT_EQ(dataset.runs[0].line[1].tube->length_m, 0.5);
  EXPECT_EQ(dataset.runs[1].line[1].tube->length_m, 2.0);
  EXPECT_NEAR(dataset.runs[1].line[1].tube->inner_diameter_m, 2.5e-3, 1e-12);
  EXPECT_FALSE(dataset.runs[1].initial_pressure_pa);
}

TEST(Measurement, WhatIsAssumedOfTheRecordIsUndone) {
  Json document = Example();
  document["assume"] = "mbar";
  EXPECT_NEAR(Good(document).runs[0].pressure_pa.at(2), 98e3 + 600.0, 1e-9);
  document["assume"] = {"mbar:r2", "exchanged:r1,r2", "as written"};
  const Dataset dataset = Good(document);
  EXPECT_NEAR(dataset.runs[0].pressure_pa.at(2), 98e3 + 600.0, 1e-9);
  EXPECT_NEAR(dataset.runs[1].pressure_pa.at(2), 98e3 + 6e3, 1e-9);
  EXPECT_TRUE(dataset.as_written);
  Remarks remarks;
  ASSERT_TRUE(std::holds_alternative<Dataset>(ParseMeasurement(document, &remarks)));
  EXPECT_EQ(remarks.warnings.size(), 3u) << remarks.warnings.dump();
  document["assume"] = "psi:r9";
  ExpectError(document, "/assume", "names the run r9");
  document["assume"] = "torr";
  ExpectError(document, "/assume", "must be one of");
  document["assume"] = 3;
  ExpectError(document, "/assume", "must be a name");
}

TEST(Measurement, EveryErrorIsNamedAtOnceWithItsPlace) {
  Json document = Example();
  document["rig"]["actuator"]["rest_volume_ml"] = -1;
  document["runs"][0]["t_s"][3] = "x";
  document["runs"][1]["rig"]["line"]["tube"]["length_m"] = 0;
  document["relative_uncertainty"]["rest_volume"] = -0.1;
  ExpectError(document, "/rig/actuator/rest_volume_ml", "not -1");
  ExpectError(document, "/runs/0/t_s/3", "must be a number");
  ExpectError(document, "/runs/1/rig/line/tube/length_m", "not 0");
  ExpectError(document, "/relative_uncertainty/rest_volume", "not -0.1");
  EXPECT_EQ(Bad(document).size(), 4u);
}

TEST(Measurement, AnAmbientPressureOfTheWrongUnitIsTheOnlyErrorItMakes) {
  Json document = Example();
  document["rig"]["ambient"]["pressure_kpa_abs"] = 0.98;
  const Errors errors = Bad(document);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/rig/ambient/pressure_kpa_abs");
}

TEST(Measurement, FilesThatTellNothingAreRefused) {
  Json unsorted = Example();
  unsorted["runs"][0]["t_s"][5] = 0.1;
  ExpectError(unsorted, "/runs/0/t_s/5", "0.1 follows 0.4");

  Json constant = Example();
  for (Json& p : constant["runs"][0]["pressure_kpa_gauge"]) p = 2.5;
  ExpectError(constant, "/runs/0/pressure_kpa_gauge", "all 10 readings are 2.5");

  Json truncated = Example();
  truncated["runs"][0]["pressure_kpa_gauge"].erase(9);
  ExpectError(truncated, "/runs/0/pressure_kpa_gauge", "10 sample times, not 9");

  Json empty = Example();
  empty["runs"][0]["t_s"] = Json::array();
  ExpectError(empty, "/runs/0/t_s", "must be a list of 8");

  Json missing = Example();
  for (Json& p : missing["runs"][0]["pressure_kpa_gauge"]) p = nullptr;
  ExpectError(missing, "/runs/0/pressure_kpa_gauge", "at least 8 readings, not 0");

  Json in_pa = Example();
  for (Json& p : in_pa["runs"][0]["pressure_kpa_gauge"])
    if (p.is_number()) p = 1000.0 * p.get<double>();
  ExpectError(in_pa, "/runs/0/pressure_kpa_gauge", "are the units kPa?");
}

TEST(Measurement, ContradictionsAreRefused) {
  Json no_supply = Example();
  no_supply["rig"]["supply"]["kind"] = "none";
  ExpectError(no_supply, "/runs/0/valve", "supply is none");

  Json no_line = Example();
  no_line["rig"].erase("line");
  no_line["runs"][1].erase("rig");
  ExpectError(no_line, "/runs/0/valve", "no line");

  Json measured = Example();
  measured["rig"]["supply"]["kind"] = "measured";
  ExpectError(measured, "/runs/1/channels", "source_pressure_kpa_gauge is required");

  Json no_source = Example();
  no_source["runs"][0].erase("source_pressure_kpa_gauge");
  ExpectError(no_source, "/runs/0/source_pressure_kpa_gauge", "is required");

  Json twice = Example();
  twice["runs"][1]["id"] = "r1";
  ExpectError(twice, "/runs/1/id", "taken by an earlier run");

  Json holdout = Example();
  holdout["holdout"] = {"r3"};
  ExpectError(holdout, "/holdout/0", "nearest id: r1");
  holdout["holdout"] = {"r1", "r2"};
  ExpectError(holdout, "/holdout", "at least one run");
}

TEST(Measurement, LongCsvIsTheSameDocument) {
  std::string csv = "run,t_s,valve,pressure_kpa_gauge,temperature_k\n";
  for (int i = 0; i < 10; ++i)
    csv += "r1," + std::to_string(0.1 * i) + (i < 3 ? ",hold," : ",inflate,") +
           (i == 4 ? "" : std::to_string(3.0 * i)) + "," + std::to_string(293.0 + i) + "\r\n";
  Json rig = Example();
  rig["holdout"] = Json::array();
  const auto parsed = MeasurementFromCsv(csv, rig);
  ASSERT_TRUE(std::holds_alternative<Json>(parsed));
  const Dataset from_csv = Good(std::get<Json>(parsed));
  const Dataset from_json = Good(Example());
  ASSERT_EQ(from_csv.runs.size(), 1u);
  EXPECT_EQ(from_csv.runs[0].valve, from_json.runs[0].valve);
  EXPECT_EQ(from_csv.runs[0].channels.temperature_k, from_json.runs[0].channels.temperature_k);
  EXPECT_EQ(from_csv.runs[0].source_pressure_pa, from_json.runs[0].source_pressure_pa);
  EXPECT_TRUE(std::isnan(from_csv.runs[0].pressure_pa.at(4)));
  EXPECT_NEAR(from_csv.runs[0].pressure_pa.at(9), from_json.runs[0].pressure_pa.at(9), 1e-9);
}

TEST(Measurement, ErrorsOfCsvNameTheLine) {
  const auto errors_of = [](const std::string& csv) {
    const auto parsed = MeasurementFromCsv(csv, Example()["rig"]);
    return std::holds_alternative<Errors>(parsed) ? std::get<Errors>(parsed) : Errors{};
  };
  const Errors header = errors_of("run,t_s,presure_kpa_gauge,valve\nr1,0,0,hold\n");
  ASSERT_FALSE(header.empty());
  EXPECT_EQ(header[0].pointer, "line 1, presure_kpa_gauge");
  EXPECT_THAT(header[0].detail, testing::HasSubstr("pressure_kpa_gauge"));
  const Errors rows = errors_of(
      "run,t_s,valve,pressure_kpa_gauge\nr1,0,hold,1\nr1,x,hold,1\nr1,0.2,hold,y\nr1,0.3,hold\n");
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[0].pointer, "line 3, t_s");
  EXPECT_EQ(rows[1].pointer, "line 4, pressure_kpa_gauge");
  EXPECT_EQ(rows[2].pointer, "line 5, row");
}

TEST(Measurement, SeveralFilesAreOneSession) {
  Json second = Example();
  second["runs"].erase(1);
  second["runs"][0]["id"] = "other";
  second["rig"]["actuator"]["rest_volume_ml"] = 80.0;
  second["holdout"] = Json::array();
  const auto merged = MergeMeasurements({Example(), second});
  ASSERT_TRUE(std::holds_alternative<Json>(merged));
  const Dataset dataset = Good(std::get<Json>(merged));
  ASSERT_EQ(dataset.runs.size(), 3u);
  EXPECT_NEAR(dataset.runs[2].chamber.rest_volume_m3, 80e-6, 1e-15);
  EXPECT_NEAR(dataset.runs[0].chamber.rest_volume_m3, 50e-6, 1e-15);
}

}  // namespace measurement_test
}  // namespace plenum::api
