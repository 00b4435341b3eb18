// Actuators that shrink as they are evacuated, from the document to the answer and back to curves.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "api/measure/measurement.h"
#include "tests/api/measure/diagnosed.h"
#include "tests/api/support.h"
#include "tests/support/chambers/chamber_net.h"

namespace plenum::api {
namespace evacuated_test {

struct Truth {
  double rest_ml = 80.0, leak = 0.0;  // C in m³/(s·Pa)
};

Json RunOf(const std::string& id, double source_kpa, double evacuate_s, const Truth& truth) {
  test::ChamberNet net;
  net.source_pa = 1e5 + 1e3 * source_kpa;
  net.fill = net.exhaust = {{0.05e-8, 0.3}};
  net.schedule = {{0.2, 1}, {0.2 + evacuate_s, 0}, {3.0, -1}};
  net.chambers = {{.rest_m3 = 1e-6 * truth.rest_ml,
                   .ratio = 0.5,
                   .operating_pa = 4e4,
                   .leak = {truth.leak, 0.3}}};
  std::vector<double> t_s;
  for (int i = 0; i <= 200; ++i) t_s.push_back(0.025 * i);
  const std::vector<double> pressure_pa = test::SimulateNet(net, t_s, 5e-4).pressure_pa[0];
  Json run = {{"id", id},
              {"source_pressure_kpa_gauge", source_kpa},
              {"initial", {{"pressure_kpa_gauge", 0.0}}},
              {"valve",
               {{{"t_s", 0.0}, {"state", "hold"}},
                {{"t_s", 0.2}, {"state", "inflate"}},
                {{"t_s", 0.2 + evacuate_s}, {"state", "hold"}},
                {{"t_s", 3.0}, {"state", "deflate"}}}}};
  std::mt19937_64 random(static_cast<std::uint64_t>(id.back()));
  std::normal_distribution<double> noise(0.0, 0.08);
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    run["t_s"].push_back(t_s[i]);
    run["pressure_kpa_gauge"].push_back((pressure_pa[i] - 1e5) / 1e3 + noise(random));
  }
  return run;
}

Json Bench(const Truth& truth) {
  Json document = Parse(R"({
    "schema": "measurement/1", "name": "vacuum gripper",
    "rig": { "actuator": { "rest_volume_ml": 80, "expansion_ratio": 0.5,
                           "operating_pressure_kpa_gauge": -60 },
             "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
             "supply": { "kind": "regulated" },
             "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 } },
    "relative_uncertainty": { "rest_volume": 0.02, "expansion_ratio": 0.02 },
    "holdout": ["r4"] })");
  document["runs"] = Json::array({RunOf("r1", -60, 2.0, truth), RunOf("r2", -80, 0.8, truth),
                                  RunOf("r3", -70, 1.2, truth), RunOf("r4", -75, 0.6, truth)});
  return document;
}

TEST(Evacuated, AsDeclaredIsAdequate) {
  const Json answer = DiagnosedOf(Bench({.rest_ml = 81.0}));
  EXPECT_EQ(answer.at("verdict"), "adequate") << answer.at("sentence");
  EXPECT_LT(answer.at("after").at("rms_kpa").get<double>(), 0.09);
  EXPECT_GT(answer.at("after").at("rms_percent").get<double>(), 0.0);
  const Json& volume = answer.at("fitted").at("rest_volume").at("ci95");
  EXPECT_LE(volume[0], 81.0);
  EXPECT_GE(volume[1], 81.0);
  ExpectCurvesAsStated(answer);
}

TEST(Evacuated, ThatLeaksLetsGasIn) {
  const double leak = 1e-12;  // C, about 0.006 L/min at choked flow
  const Json answer = DiagnosedOf(Bench({.leak = leak}));
  EXPECT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.at("sentence");
  EXPECT_EQ(answer.at("effects")[0].at("id"), "leak");
  const std::string words = answer.at("effects")[0].at("words");
  EXPECT_NE(words.find("it lets in "), std::string::npos) << words;
  EXPECT_NE(words.find("at -60 kPa gauge"), std::string::npos) << words;
  EXPECT_LT(answer.at("after").at("holdout_rms_kpa").get<double>(), 0.095);
  ExpectCurvesAsStated(answer);
}

// Of volume and conductance the pressures tell the quotient alone.
TEST(Evacuated, OfAnotherVolumeIsFoundSo) {
  const Json answer = DiagnosedOf(Bench({.rest_ml = 96.0}));
  EXPECT_EQ(answer.at("verdict"), "tie") << answer.at("sentence");
  const Json& tied = answer.at("tied");
  ASSERT_EQ(tied.size(), 2u) << answer.at("sentence");
  EXPECT_NE(std::find(tied.begin(), tied.end(), Json::array({"number:rest_volume"})), tied.end());
  EXPECT_NE(std::find(tied.begin(), tied.end(), Json::array({"number:sonic_conductance"})),
            tied.end());
  EXPECT_LT(answer.at("after").at("holdout_rms_kpa").get<double>(), 0.095);
  for (std::size_t i = 0; i < 2; ++i) {  // 96 mL for 80, or C of 80 for 96
    const Json& number = answer.at("tied_sets")[i].at("numbers").at(0);
    EXPECT_EQ("number:" + number.at("name").get<std::string>(), tied[i][0]);
    const double factor = tied[i][0] == "number:rest_volume" ? 1.2 : 1.0 / 1.2;
    EXPECT_NEAR(number.at("fitted").get<double>() / number.at("declared").get<double>(), factor,
                0.02);
  }
}

TEST(Evacuated, WhatDoesNotFitIsSaid) {
  const auto error = [](const char* place, const Json& value, const char* at) {
    Json document = Bench({});
    document[Json::json_pointer(place)] = value;
    return DetailAt(ErrorsOf(ParseMeasurement(document)), at);
  };
  const auto holds = [](const std::string& text, const char* part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  holds(error("/rig/actuator/expansion_ratio", 1.5, "/rig/actuator/expansion_ratio"), "0.01");
  holds(error("/rig/actuator/operating_pressure_kpa_gauge", -100,
              "/rig/actuator/operating_pressure_kpa_gauge"),
        "-100");
  holds(error("/runs/1/source_pressure_kpa_gauge", 80, "/runs/1/source_pressure_kpa_gauge"),
        "must be below 0");
  holds(error("/rig/supply", {{"kind", "flow"}, {"flow_l_per_min_anr", 5}}, "/runs/0/valve"),
        "regulated");
  holds(error("/rig/actuator/expansion_ratio", 0.2, "/runs/1/rig"), "at least 0.2575");
  holds(error("/runs/0/volume", "imposed", "/runs/0/volume"), "free");
}

}  // namespace evacuated_test
}  // namespace plenum::api
