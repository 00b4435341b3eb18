// Rigs with several chambers, from the document to the answer and back to curves.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "api/measure/measurement.h"
#include "tests/api/measure/diagnosed.h"
#include "tests/api/support.h"
#include "tests/support/chambers/chamber_net.h"

namespace plenum::api {
namespace chambers_test {

using test::ChamberNet;

// A base of 40 mL, a middle of 25 mL, and a tip of 12 mL that is not measured, in a row.
ChamberNet Row() {
  ChamberNet net;
  net.fill = net.exhaust = {{0.05e-8, 0.3}};
  net.chambers = {
      {.rest_m3 = 40e-6, .ratio = 1.8},
      {.rest_m3 = 25e-6,
       .ratio = 1.5,
       .from = 0,
       .way = {{0.012e-8, 0.25}},
       .back = {{0.012e-8, 0.25}}},
      {.rest_m3 = 12e-6, .from = 1, .way = {{0.006e-8, 0.25}}, .back = {{0.006e-8, 0.25}}}};
  return net;
}

Json RowRig() {
  return Parse(R"({
    "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 },
    "chambers": [
      { "name": "base", "rest_volume_ml": 40, "expansion_ratio": 1.8,
        "operating_pressure_kpa_gauge": 100 },
      { "name": "middle", "rest_volume_ml": 25, "expansion_ratio": 1.5,
        "operating_pressure_kpa_gauge": 100,
        "line": { "sonic_conductance_dm3_per_s_bar": 0.012, "critical_ratio": 0.25 } },
      { "name": "tip", "rest_volume_ml": 12, "expansion_ratio": 1,
        "operating_pressure_kpa_gauge": 100,
        "line": { "sonic_conductance_dm3_per_s_bar": 0.006, "critical_ratio": 0.25 } } ],
    "supply": { "kind": "regulated" },
    "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 } })");
}

// Two fingers of 30 mL, each through its own branch behind one valve; the right one swells more.
ChamberNet SideBySide() {
  ChamberNet net;
  net.fill = net.exhaust = {{0.08e-8, 0.3}};
  const std::vector<test::MassElement> branch = {{0.03e-8, 0.2}};
  net.chambers = {{.rest_m3 = 2e-6},
                  {.rest_m3 = 30e-6, .ratio = 1.4, .from = 0, .way = branch, .back = branch},
                  {.rest_m3 = 30e-6, .ratio = 2.2, .from = 0, .way = branch, .back = branch}};
  return net;
}

Json SideBySideRig() {
  return Parse(R"({
    "arrangement": "side_by_side", "junction_volume_ml": 2,
    "line": { "sonic_conductance_dm3_per_s_bar": 0.08, "critical_ratio": 0.3 },
    "chambers": [
      { "name": "left", "rest_volume_ml": 30, "expansion_ratio": 1.4,
        "operating_pressure_kpa_gauge": 100,
        "line": { "sonic_conductance_dm3_per_s_bar": 0.03, "critical_ratio": 0.2 } },
      { "name": "right", "rest_volume_ml": 30, "expansion_ratio": 2.2,
        "operating_pressure_kpa_gauge": 100,
        "line": { "sonic_conductance_dm3_per_s_bar": 0.03, "critical_ratio": 0.2 } } ],
    "supply": { "kind": "regulated" },
    "ambient": { "pressure_kpa_abs": 100, "temperature_k": 293.15 } })");
}

Json Readings(const std::vector<double>& pressure_pa, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, 0.1);
  Json list = Json::array();
  for (const double pa : pressure_pa) list.push_back((pa - 1e5) / 1e3 + noise(random));
  return list;
}

// `gauges`: by chamber of the net the name under which it is measured, the run's own pressure the
// first that has one; empty: not measured.
Json RunOf(const std::string& id, double source_kpa, double rise_s, ChamberNet net,
           const std::vector<std::string>& gauges) {
  net.source_pa = 1e5 + 1e3 * source_kpa;
  net.schedule = {{0.2, 1}, {0.2 + rise_s, 0}, {3.0, -1}};
  std::vector<double> t_s;
  for (int i = 0; i <= 180; ++i) t_s.push_back(0.025 * i);
  const test::NetResult result = test::SimulateNet(net, t_s, 2.5e-4);
  Json run = {{"id", id},
              {"source_pressure_kpa_gauge", source_kpa},
              {"initial", {{"pressure_kpa_gauge", 0.0}}},
              {"valve",
               {{{"t_s", 0.0}, {"state", "hold"}},
                {{"t_s", 0.2}, {"state", "inflate"}},
                {{"t_s", 0.2 + rise_s}, {"state", "hold"}},
                {{"t_s", 3.0}, {"state", "deflate"}}}},
              {"t_s", t_s}};
  for (std::size_t i = 0; i < gauges.size(); ++i) {
    if (gauges[i].empty()) continue;
    const Json readings =
        Readings(result.pressure_pa[i], 8 * static_cast<std::uint64_t>(id.back()) + i);
    if (run.contains("pressure_kpa_gauge"))
      run["channels"]["chambers"][gauges[i]] = readings;
    else
      run["pressure_kpa_gauge"] = readings;
  }
  return run;
}

Json Bench(const Json& rig, const ChamberNet& net, const std::vector<std::string>& gauges) {
  Json document = {{"schema", "measurement/1"},
                   {"name", "soft finger"},
                   {"rig", rig},
                   {"relative_uncertainty", {{"rest_volume", 0.02}, {"sonic_conductance", 0.02}}},
                   {"holdout", {"r3"}}};
  document["runs"] =
      Json::array({RunOf("r1", 150, 0.8, net, gauges), RunOf("r2", 220, 0.5, net, gauges),
                   RunOf("r3", 180, 0.6, net, gauges)});
  return document;
}

const std::vector<std::string> kInARow = {"base", "middle", ""};

TEST(Chambers, InARowAsDeclaredAreAdequate) {
  ChamberNet net = Row();
  net.chambers[1].rest_m3 *= 1.02;
  const Json answer = DiagnosedOf(Bench(RowRig(), net, kInARow));
  EXPECT_EQ(answer.at("verdict"), "adequate") << answer.at("sentence");
  EXPECT_LT(answer.at("after").at("rms_kpa").get<double>(), 0.11);
  EXPECT_LT(answer.at("after").at("runs").at("r2[middle]").get<double>(), 0.12);
  const Json& volume = answer.at("fitted").at("rest_volume[middle]");
  EXPECT_EQ(volume.at("chamber"), "middle");
  EXPECT_LE(volume.at("ci95")[0], 25.5);
  EXPECT_GE(volume.at("ci95")[1], 25.5);
  ASSERT_EQ(answer.at("chambers").size(), 3u);
  EXPECT_EQ(answer.at("chambers")[1].at("runs"), Json({"r1[middle]", "r2[middle]", "r3[middle]"}));
  EXPECT_TRUE(answer.at("chambers")[2].at("runs").empty());
  EXPECT_TRUE(answer.at("runs")[5].at("held_out"));
  EXPECT_TRUE(answer.at("revision").is_null());
  ExpectCurvesAsStated(answer);
}

TEST(Chambers, AWrongVolumeOfOneIsFoundThere) {
  ChamberNet net = Row();
  net.chambers[1].rest_m3 *= 1.3;
  const Json answer = DiagnosedOf(Bench(RowRig(), net, kInARow));
  EXPECT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  ASSERT_EQ(answer.at("numbers").size(), 1u) << answer.at("sentence");
  EXPECT_EQ(answer.at("numbers")[0].at("name"), "rest_volume");
  EXPECT_EQ(answer.at("numbers")[0].at("chamber"), "middle");
  EXPECT_NEAR(answer.at("numbers")[0].at("fitted").get<double>(), 32.5, 0.7);
  ExpectCurvesAsStated(answer);
}

// Tight passages and gauges on both sides tell the chambers apart.
TEST(Chambers, ALeakIsNamedWithItsChamber) {
  ChamberNet net = Row();
  net.chambers[1].way = net.chambers[1].back = {{0.003e-8, 0.25}};
  net.chambers[1].leak = {2e-12, 0.3};
  Json rig = RowRig();
  rig["chambers"][1]["line"]["sonic_conductance_dm3_per_s_bar"] = 0.003;
  const Json answer = DiagnosedOf(Bench(rig, net, {"base", "middle", "tip"}));
  EXPECT_EQ(answer.at("verdict"), "explained") << answer.at("sentence");
  ASSERT_EQ(answer.at("effects").size(), 1u) << answer.at("sentence");
  EXPECT_EQ(answer.at("effects")[0].at("id"), "leak");
  EXPECT_EQ(answer.at("effects")[0].at("chamber"), "middle");
  EXPECT_EQ(answer.at("effects")[0].at("words").get<std::string>().find("middle: it leaks "), 0u);
  EXPECT_NE(answer.at("sentence").get<std::string>().find("leak[middle]"), std::string::npos);
  ExpectCurvesAsStated(answer);
}

// Through a wide passage all chambers are one: whose leak it is stays open, or is at least no other
// effect.
TEST(Chambers, WhoseLeakItIsStaysOpenWhereNothingTells) {
  ChamberNet net = Row();
  net.chambers[1].way = net.chambers[1].back = {{0.5e-8, 0.25}};
  net.chambers[1].leak = {1.5e-12, 0.3};
  Json rig = RowRig();
  rig["chambers"][1]["line"]["sonic_conductance_dm3_per_s_bar"] = 0.5;
  const Json answer = DiagnosedOf(Bench(rig, net, kInARow));
  ASSERT_EQ(answer.at("verdict"), "tie") << answer.at("sentence");
  bool true_one = false;
  for (const Json& set : answer.at("tied")) {
    ASSERT_EQ(set.size(), 1u);
    EXPECT_EQ(set[0].get<std::string>().find("leak["), 0u) << set[0];
    true_one = true_one || set[0] == "leak[middle]";
  }
  EXPECT_TRUE(true_one) << answer.at("sentence");
}

TEST(Chambers, SideBySideBehindOneValveAreTold) {
  ChamberNet net = SideBySide();
  const Json clean = DiagnosedOf(Bench(SideBySideRig(), net, {"", "left", "right"}));
  EXPECT_EQ(clean.at("verdict"), "adequate") << clean.at("sentence");
  ExpectCurvesAsStated(clean);
  net.chambers[2].rest_m3 *= 0.75;
  const Json wrong = DiagnosedOf(Bench(SideBySideRig(), net, {"", "left", "right"}));
  EXPECT_EQ(wrong.at("verdict"), "explained") << wrong.at("sentence");
  ASSERT_EQ(wrong.at("numbers").size(), 1u) << wrong.at("sentence");
  EXPECT_EQ(wrong.at("numbers")[0].at("chamber"), "right");
}

TEST(Chambers, WhatDoesNotFitIsSaid) {
  const Json good = Bench(RowRig(), Row(), kInARow);
  const auto error = [&](const char* place, const Json& value, const char* at) {
    Json document = good;
    document[Json::json_pointer(place)] = value;
    return DetailAt(ErrorsOf(ParseMeasurement(document)), at);
  };
  const auto holds = [](const std::string& text, const char* part) {
    EXPECT_FALSE(text.empty());
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << text << "\" has no " << part;
  };
  const Json actuator = {{"rest_volume_ml", 1}};
  holds(error("/rig/actuator", actuator, "/rig/actuator"), "left out");
  holds(error("/rig/chambers/1/name", "base", "/rig/chambers/1/name"), "unique");
  holds(error("/rig/chambers/1/name", "a[b", "/rig/chambers/1/name"), "[");
  holds(error("/rig/chambers/2/from", "top", "/rig/chambers/2/from"), "base or middle");
  holds(error("/rig/chambers/0/line", good["rig"]["line"], "/rig/chambers/0/line"), "left out");
  holds(error("/rig/junction_volume_ml", 2, "/rig/junction_volume_ml"), "side by side");
  holds(error("/rig/pressure_of", "top", "/rig/pressure_of"), "name of a chamber");
  for (const char* arrangement : {"row", "side_by_side"})
    for (const Json& unread : {Json("base"), Json(0.5), Json::array(), Json::object()}) {
      Json document = good;
      document["rig"]["arrangement"] = arrangement;
      document["rig"]["chambers"] = unread;
      holds(DetailAt(ErrorsOf(ParseMeasurement(document)), "/rig/chambers"), "");
    }
  holds(error("/runs/0/channels/chambers/base", Json::array(), "/runs/0/channels/chambers/base"),
        "pressure_kpa_gauge");
  holds(error("/runs/0/channels/chambers/top", Json::array(), "/runs/0/channels/chambers/top"), "");
  holds(error("/runs/0/specimen", "one", "/runs"), "specimens");
  holds(error("/runs/0/volume", "imposed", "/runs/0/volume"), "free");
  holds(error("/runs/0/channels/chambers/middle/3", "x", "/runs/0/channels/chambers/middle/3"), "");
  Json short_one = good;
  short_one["runs"][0]["channels"]["chambers"]["middle"] = {1.0, 2.0};
  holds(DetailAt(ErrorsOf(ParseMeasurement(short_one)), "/runs/0/channels/chambers/middle"),
        "one value for each");
}

}  // namespace chambers_test
}  // namespace plenum::api
