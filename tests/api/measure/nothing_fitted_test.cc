// Measurements in which every number is exact: the base model has nothing to fit.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "api/measure/diagnose_request.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace nothing_fitted_test {

constexpr double kAmbientKpa = 101.3, kStartKpa = 700.0, kNoiseKpa = 0.1;
constexpr double kStartBar = (kStartKpa + kAmbientKpa) / 100.0;
constexpr double kLeak = 4e-5;  // dm³/(s·bar)

// A blocked vessel of 100 mL, full at the start and shut. Its leak is choked, q = C·p at 20 °C, so
// that p falls as exp(−C·P0·t/V).
Json Hold(std::size_t readings) {
  Json document = Parse(R"({
    "schema": "measurement/1",
    "rig": {
      "actuator": { "rest_volume_ml": 100, "expansion_ratio": 1,
                    "operating_pressure_kpa_gauge": 700 },
      "supply": { "kind": "none" },
      "ambient": { "pressure_kpa_abs": 101.3, "temperature_k": 293.15 } },
    "runs": [ { "id": "a", "blocked": true, "initial": { "pressure_kpa_gauge": 700 },
                "valve": [ { "t_s": 0, "state": "hold" } ],
                "t_s": [], "pressure_kpa_gauge": [] } ] })");
  std::mt19937_64 random(7);
  std::normal_distribution<double> noise(0.0, kNoiseKpa);
  Json& run = document["runs"][0];
  for (std::size_t i = 0; i < readings; ++i) {
    const double t_s = 0.5 * static_cast<double>(i);
    const double rate_per_s = kLeak * 1e-8 * 1e5 / 100e-6;
    run["t_s"].push_back(t_s);
    run["pressure_kpa_gauge"].push_back((kStartKpa + kAmbientKpa) * std::exp(-rate_per_s * t_s) -
                                        kAmbientKpa + noise(random));
  }
  return document;
}

Json Diagnosed(const Json& document) {
  DiagnosisRequest request;
  request.dataset = std::get<calibration::Dataset>(ParseMeasurement(document));
  return RunDiagnosis(request, {}).answer;
}

// L/min (ANR) that a leak lets out of the full vessel. So few readings do not tell its laws apart.
double LeakAtStart(const Json& leak) {
  if (leak.at("law") == "orifice")
    return leak.at("sonic_conductance_dm3_per_s_bar").at("value").get<double>() * 60.0 * kStartBar;
  const double squares = std::pow(kStartBar, 2) - std::pow(kAmbientKpa / 100.0, 2);
  return leak.at("conductance_l_per_min_bar").at("value").get<double>() * squares / 2.0;
}

TEST(NothingFitted, AFewReadingsOfAClosedVesselShowItsLeak) {
  for (const std::size_t readings : {12u, 40u}) {
    const Json answer = Diagnosed(Hold(readings));
    EXPECT_TRUE(answer.at("fitted").empty());
    ASSERT_EQ(answer.at("verdict"), "explained") << readings;
    ASSERT_EQ(answer.at("effects").size(), 1u);
    EXPECT_EQ(answer.at("effects")[0].at("id"), "leak");
    EXPECT_NEAR(LeakAtStart(answer.at("effects")[0].at("parameters")), kLeak * 60.0 * kStartBar,
                0.15 * kLeak * 60.0 * kStartBar);
    EXPECT_LT(answer.at("after").at("rms_kpa").get<double>(), 2.0 * kNoiseKpa);
  }
}

// 5,000 times the volume and readings 80 times as far apart: what is searched of each law would
// begin beyond the law's own range.
TEST(NothingFitted, AVesselOfHundredsOfLitresShowsItsLeak) {
  Json document = Hold(40);
  document["rig"]["actuator"]["rest_volume_ml"] = 500e3;
  for (Json& t_s : document["runs"][0]["t_s"]) t_s = 80.0 * t_s.get<double>();
  const Json answer = Diagnosed(document);
  ASSERT_EQ(answer.at("verdict"), "explained");
  ASSERT_EQ(answer.at("effects").size(), 1u);
  EXPECT_EQ(answer.at("effects")[0].at("id"), "leak");
  const double leak = kLeak * 5000.0 / 80.0 * 60.0 * kStartBar;
  EXPECT_NEAR(LeakAtStart(answer.at("effects")[0].at("parameters")), leak, 0.15 * leak);
}

TEST(NothingFitted, NoiseAloneIsAdequate) {
  Json document = Hold(12);
  Json& run = document["runs"][0];
  std::mt19937_64 random(8);
  std::normal_distribution<double> noise(kStartKpa, kNoiseKpa);
  for (Json& reading : run["pressure_kpa_gauge"]) reading = noise(random);
  const Json answer = Diagnosed(document);
  EXPECT_EQ(answer.at("verdict"), "adequate");
  EXPECT_TRUE(answer.at("fitted").empty());
}

}  // namespace nothing_fitted_test
}  // namespace plenum::api
