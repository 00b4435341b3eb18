// What a measurement may say of the world around the rig, against closed forms: a rigid chamber
// that a choked element empties falls as exp(−C·P0·t/V), one that a choked element fills rises
// evenly.
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "api/json/reader.h"
#include "api/measure/measurement.h"
#include "calibration/fit/forward.h"
#include "calibration/values/effect_sets.h"
#include "tests/api/measure/read_dataset.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace rig_world_test {

using calibration::Dataset;
using calibration::Declared;
using calibration::ForwardModel;
using calibration::ModelState;

constexpr double kC = 1e-9, kV = 1e-3, kP0 = 1e5;  // 0.1 dm³/(s·bar), 1 L
constexpr double kRate = kC * kP0 / kV;            // 0.1 a second

// A litre at 20 °C behind 0.1 dm³/(s·bar), b 0.2, at 100 kPa ambient, read each 0.25 s for 5 s.
Json Litre(const Json& more) {
  Json document = Json::parse(R"({
    "schema": "measurement/1",
    "rig": { "actuator": { "rest_volume_ml": 1000, "expansion_ratio": 1,
                           "operating_pressure_kpa_gauge": 500 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.1, "critical_ratio": 0.2 } },
    "runs": [ { "id": "r", "valve": [ { "t_s": 0, "state": "inflate" } ] } ] })");
  document.merge_patch(more);
  for (int i = 0; i <= 20; ++i) {
    document["runs"][0]["t_s"].push_back(0.25 * i);
    document["runs"][0]["pressure_kpa_gauge"].push_back(0.01 * i);
  }
  return document;
}

Json RunOf(const char* text) { return {{"runs", Json::array({Json::parse(text)})}}; }

std::vector<double> Course(const Dataset& dataset) {
  const ForwardModel forward(dataset);
  const auto p = forward.Predict(0, forward.Declared(), {}, {.relative_tolerance = 1e-10});
  EXPECT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  return p.reading.pressure_pa;
}

void ExpectFallsFrom(double start_pa, double rate_per_s, const Dataset& dataset) {
  const std::vector<double> pa = Course(dataset);
  for (std::size_t i = 0; i < pa.size(); ++i)
    EXPECT_NEAR(pa[i], start_pa * std::exp(-rate_per_s * dataset.runs[0].t_s[i]), 1.0) << i;
}

constexpr const char* kEvacuated =
    R"({ "id": "r", "source_pressure_kpa_gauge": -99.9, "initial": { "pressure_kpa_gauge": 0 },
         "valve": [ { "t_s": 0, "state": "inflate" } ] })";

TEST(RigWorld, ASourceBelowAmbientEvacuates) {
  Json document = Litre(RunOf(kEvacuated));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  ExpectFallsFrom(1e5, kRate, Read(document));
}

TEST(RigWorld, DeflatedFromVacuumItTakesInWhatSurroundsIt) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "source_pressure_kpa_gauge": -95, "initial": { "pressure_kpa_gauge": -95 },
           "valve": [ { "t_s": 0, "state": "hold" }, { "t_s": 1, "state": "deflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  document["rig"]["line"]["exhaust"] = {{"sonic_conductance_dm3_per_s_bar", 0.02},
                                        {"critical_ratio", 0.4}};
  const Dataset dataset = Read(document);
  const std::vector<double> pa = Course(dataset);
  for (std::size_t i = 0; i < pa.size(); ++i)  // choked up to 40 kPa, which it does not reach
    EXPECT_NEAR(pa[i], 5e3 + std::max(0.0, dataset.runs[0].t_s[i] - 1.0) * 0.2 * kRate * 1e5, 1.0);
}

TEST(RigWorld, HeliumFlowsFaster) {
  Json document = Litre(RunOf(kEvacuated));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  document["rig"]["gas"] = "helium";
  ExpectFallsFrom(1e5, 2.853 * kRate, Read(document));
}

TEST(RigWorld, ALineMayExhaustIntoAnotherPressure) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "initial": { "pressure_kpa_gauge": 500 }, "exhaust_pressure_kpa_gauge": -80,
           "valve": [ { "t_s": 0, "state": "deflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "none"}};
  ExpectFallsFrom(6e5, kRate, Read(document));
  // Into a vessel at 400 kPa it comes to 400 kPa, at rest when time is long.
  document["runs"][0].erase("exhaust_pressure_kpa_gauge");
  document["rig"]["exhaust_pressure_kpa_gauge"] = 400;
  for (Json& t_s : document["runs"][0]["t_s"]) t_s = 100.0 * t_s.get<double>();
  EXPECT_NEAR(Course(Read(document)).back(), 5e5, 100.0);
}

TEST(RigWorld, AFlowControllerFillsEvenly) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "initial": { "pressure_kpa_gauge": 0 },
           "valve": [ { "t_s": 0, "state": "hold" }, { "t_s": 1, "state": "inflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "flow"}, {"flow_l_per_min_anr", 6.0}};
  const Dataset dataset = Read(document);
  const std::vector<double> pa = Course(dataset);
  for (std::size_t i = 0; i < pa.size(); ++i)
    EXPECT_NEAR(pa[i], 1e5 + std::max(0.0, dataset.runs[0].t_s[i] - 1.0) * 1e-4 * kP0 / kV, 1.0);
  for (const model::EffectSpec* spec : calibration::NamedEffects(dataset.runs))
    EXPECT_NE(spec->place, model::EffectPlace::kSupply) << spec->id;
}

// What the line conducts shows only where gas leaves through it again, or where its head is read.
TEST(RigWorld, BehindAFlowControllerTheLineTellsNothingUntilItEmpties) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "initial": { "pressure_kpa_gauge": 0 },
           "valve": [ { "t_s": 0, "state": "hold" }, { "t_s": 1, "state": "inflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "flow"}, {"flow_l_per_min_anr", 6.0}};
  const auto of_the_line = [](const Json& measured) {
    std::set<std::string> ids;
    for (const model::EffectSpec* spec : calibration::Nameable(Read(measured)))
      for (const std::string_view id :
           {"cracking_pressure", "directional_conductance", "valve_ramp",
            "number:sonic_conductance", "number:critical_ratio"})
        if (spec->id == id) ids.emplace(id);
    return ids;
  };
  EXPECT_TRUE(of_the_line(document).empty());
  document["runs"][0]["valve"].push_back({{"t_s", 1.5}, {"state", "deflate"}});
  EXPECT_EQ(of_the_line(document).size(), 5u);
}

// Of the readings by each number, Pa, against central differences.
void ExpectDerivatives(const Dataset& dataset, const std::vector<Declared>& numbers,
                       double off_pa) {
  const ForwardModel forward(dataset);
  const calibration::PredictOptions tight{.relative_tolerance = 1e-11};
  for (const Declared number : numbers) {
    const calibration::Parameter parameter{.declared = number};
    const auto slope = forward.Predict(0, forward.Declared(), {&parameter, 1}, tight);
    ASSERT_EQ(slope.status, model::SimulateStatus::kDone) << slope.detail;
    const auto at = [&](double step) {
      ModelState state = forward.Declared();
      state.factor[static_cast<std::size_t>(number)] += step;
      return forward.Predict(0, state, {}, tight).reading.pressure_pa;
    };
    const std::vector<double> above = at(1e-5), below = at(-1e-5);
    for (std::size_t i = 0; i < above.size(); ++i)
      EXPECT_NEAR(slope.derivatives[0].pressure_pa[i], (above[i] - below[i]) / 2e-5, off_pa)
          << Name(number) << " " << i;
  }
}

// A source at 60 kPa below ambient, into which the flow is not choked to the end.
TEST(RigWorld, DerivativesOfAnEvacuatingRunAgreeWithDifferences) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "source_pressure_kpa_gauge": -60, "initial": { "pressure_kpa_gauge": 0 },
           "valve": [ { "t_s": 0, "state": "inflate" }, { "t_s": 3, "state": "deflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  document["rig"]["line"]["exhaust"] = {{"sonic_conductance_dm3_per_s_bar", 0.05},
                                        {"critical_ratio", 0.4}};
  ExpectDerivatives(Read(document),
                    {Declared::kSourcePressure, Declared::kAmbientPressure,
                     Declared::kSonicConductance, Declared::kCriticalRatio},
                    5.0);
}

// Hydrogen from 60 MPa, where an ideal gas would have 1.4 times the density.
TEST(RigWorld, DenseGasIsNotIdeal) {
  Json document = Litre(RunOf(
      R"({ "id": "r", "source_pressure_kpa_gauge": 60000,
           "initial": { "pressure_kpa_gauge": 1000 },
           "valve": [ { "t_s": 0, "state": "inflate" }, { "t_s": 4, "state": "deflate" } ] })"));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  document["rig"]["gas"] = "hydrogen";
  document["rig"]["actuator"]["operating_pressure_kpa_gauge"] = 60000;
  const Dataset dataset = Read(document);
  // Choked for the first second: the content rises by C·p·f/√Z, and 1.39 is Z at 60 MPa.
  const std::vector<double> pa = Course(dataset);
  const double per_s = 3.7953 * kC * 60.1e6 / std::sqrt(1.39);  // m³ ANR/s
  const double content_m3 = 1.1e6 * kV / kP0 + per_s * 0.5;
  const double ideal_pa = content_m3 * kP0 / kV;
  EXPECT_NEAR(pa[2] / ideal_pa, 1.0 + 0.0062 * ideal_pa / 1e6, 0.03);  // Z is 1.062 at 10 MPa
  ExpectDerivatives(
      dataset, {Declared::kSourcePressure, Declared::kSonicConductance, Declared::kCriticalRatio},
      2e-5 * 60e6);
}

TEST(RigWorld, WhatCannotBeIsNamed) {
  const auto first_error = [](const Json& document) {
    const auto parsed = ParseMeasurement(document);
    const auto* errors = std::get_if<Errors>(&parsed);
    return errors != nullptr && !errors->empty() ? errors->front().pointer : std::string("none");
  };
  Json document = Litre(RunOf(kEvacuated));
  document["rig"]["supply"] = {{"kind", "regulated"}};
  document["runs"][0]["source_pressure_kpa_gauge"] = -100.1;  // below an absolute 0
  EXPECT_EQ(first_error(document), "/runs/0/source_pressure_kpa_gauge");
  document["runs"][0]["source_pressure_kpa_gauge"] = -100.0;
  EXPECT_EQ(first_error(document), "none");
  document["runs"][0]["source_pressure_kpa_gauge"] = -90.0;
  document["rig"]["gas"] = "neon";
  EXPECT_EQ(first_error(document), "/rig/gas");
  document["rig"]["gas"] = "argon";
  document["runs"][0]["channels"]["flow_l_per_min_anr"] = Json::array();
  for (int i = 0; i <= 20; ++i)
    document["runs"][0]["channels"]["flow_l_per_min_anr"].push_back(0.1 * i);
  EXPECT_EQ(first_error(document), "/runs/0/channels");
  document["runs"][0].erase("channels");
  document["rig"]["supply"] = {{"kind", "flow"}};
  EXPECT_EQ(first_error(document), "/rig/supply/flow_l_per_min_anr");
}

}  // namespace rig_world_test
}  // namespace plenum::api
