// A vacuum from the wall, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace wall_vacuum_test {

Json FromWall() {
  Json request = Example("jamming_gripper");
  request["ranking"] = {{"count", 3}, {"per_source", 20}, {"proof", true}};
  const Json mains = {{"pressure_kpa_gauge", -85.0}};
  request["supply"]["vacuum"] = {{"configurations", {"mains"}}, {"mains", mains}};
  return request;
}

const catalog::Part& RowWithId(const std::string& id) {
  return *std::find_if(Project().parts.begin(), Project().parts.end(),
                       [&](const catalog::Part& part) { return part.id == id; });
}

// A design on the wall as a rig by itself: its valve, fittings and tube between bag and -85 kPa.
Json SimulatedOnWall(const Json& design) {
  Json elements = Json::array();
  const auto id_of = [&](const std::string& family) {
    for (const Json& row : design["parts"])
      if (row["family"] == family) return row["id"].get<std::string>();
    return std::string();
  };
  elements.push_back({{"part", id_of("valve")}});
  elements.push_back({{"part", id_of("fitting")}});
  elements.push_back({{"part", id_of("tubing")}, {"length_m", 1.0}});
  elements.push_back({{"part", id_of("fitting")}});
  const Json source = {{"kind", "regulated"}, {"source_pressure_kpa_gauge", -85.0}};
  Json request = {{"schema", "simulation/1"},
                  {"actuators",
                   {{{"rest_volume_ml", 200},
                     {"expansion_ratio", 0.8},
                     {"operating_pressure_kpa_gauge", -60},
                     {"close_at_operating_pressure",
                      RowWithId(id_of("valve")).texts.at("function").value != "3/2"},
                     {"line", {{"elements", elements}}}}}},
                  {"source", source},
                  {"cycle", {{"frequency_hz", 0.1}, {"inflate_fraction", 0.5}, {"cycles", 1}}},
                  {"t_end_s", 10.0}};
  const auto result = RunSimulation(request, Project().parts);
  for (const Error& error : ErrorsOf(result)) ADD_FAILURE() << error.pointer << error.detail;
  return std::get<Json>(result);
}

TEST(WallVacuum, FromTheWallNeedsNoPump) {
  const Json answer = Answered(FromWall());
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Refusals(answer), "");
  ASSERT_FALSE(answer["designs"].empty());
  for (const Json& design : answer["designs"]) {
    EXPECT_EQ(design["configuration"], "mains");
    EXPECT_NEAR(design["settings"]["vacuum_kpa_gauge"].get<double>(), -85.0, 1e-9);
    for (const Json& row : design["parts"])
      EXPECT_TRUE(row["family"] == "valve" || row["family"] == "tubing" ||
                  row["family"] == "fitting")
          << row;
    EXPECT_TRUE(design["kind"]["regulators"].empty());
    const Json simulated = SimulatedOnWall(design);
    const double rise_s = simulated["performance"]["groups"][0]["rise_time_s"];
    EXPECT_NEAR(design["performance"]["groups"][0]["rise_time_s"].get<double>(), rise_s,
                1e-4 * rise_s);
  }
}

TEST(WallVacuum, ALessDeepWallIsNeverBetter) {
  const double best = Answered(FromWall())["designs"][0]["objective"];
  Json shallow = FromWall();
  shallow["supply"]["vacuum"]["mains"]["pressure_kpa_gauge"] = -70.0;
  EXPECT_GE(Answered(shallow)["designs"][0]["objective"].get<double>(), best * (1.0 - 1e-9));
}

// Two bags at once have nothing to do with each other but what joins their lines.
TEST(WallVacuum, GroupsAtOnceAreAsFastAsAlone) {
  Json request = FromWall();
  Json bag = request["actuators"][0];
  bag["name"] = "other";
  bag["rest_volume_ml"] = 120;
  request["actuators"].push_back(bag);
  request["duty"]["simultaneous"] = true;
  request["ranking"] = {{"count", 1}, {"list", "combinations"}, {"proof", true}};
  const Json answer = Answered(request);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(Refusals(answer), "");
  const Json simulated = SimulatedOnWall(answer["designs"][0]);  // the first bag by itself
  const double rise_s = simulated["performance"]["groups"][0]["rise_time_s"];
  EXPECT_NEAR(answer["designs"][0]["performance"]["groups"][0]["rise_time_s"].get<double>(), rise_s,
              1e-4 * rise_s);
}

// The wall has vacuum enough for all: of least energy are the same designs at once and in turns,
// and evaluated they are as listed.
TEST(WallVacuum, GroupsAtOnceAreSizedAsByThemselves) {
  Json request = FromWall();
  const Json group = {{"name", "a"},
                      {"rest_volume_ml", 65},
                      {"expansion_ratio", 0.4},
                      {"operating_pressure_kpa_gauge", -80},
                      {"tube_length_m", 0.2},
                      {"rise_time_s_max", 0.5}};
  Json other = group;
  other.update({{"name", "b"},
                {"count", 4},
                {"rest_volume_ml", 120},
                {"expansion_ratio", 0.9},
                {"operating_pressure_kpa_gauge", -73},
                {"rise_time_s_max", 2}});
  request["actuators"] = {group, other};
  request["duty"] = {{"frequency_hz", 0.05}, {"actuations", 20}};
  request["supply"] = {
      {"vacuum", {{"configurations", {"mains"}}, {"mains", {{"pressure_kpa_gauge", -90}}}}}};
  request["objective"] = {{"minimize", "energy_wh"}};
  request["ranking"] = {{"count", 3}, {"proof", true}};
  const Json at_once = Answered(request);
  EXPECT_EQ(at_once["status"], "optimal");
  EXPECT_EQ(Refusals(at_once), "");
  request["duty"]["simultaneous"] = false;
  const Json in_turns = Answered(request);
  ASSERT_EQ(at_once["designs"].size(), 3u);
  ASSERT_EQ(in_turns["designs"].size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& design = at_once["designs"][i];
    EXPECT_EQ(design["parts"], in_turns["designs"][i]["parts"]);
    EXPECT_NEAR(design["objective"], in_turns["designs"][i]["objective"], 1e-6);
    const auto evaluated = Evaluated(at_once["requirements"], design);
    ASSERT_TRUE(ErrorsOf(evaluated).empty());
    const Json& again = std::get<Json>(evaluated)["performance"]["groups"];
    for (int g : {0, 1}) {
      const double rise_s = design["performance"]["groups"][g]["rise_time_s"];
      EXPECT_NEAR(rise_s, in_turns["designs"][i]["performance"]["groups"][g]["rise_time_s"],
                  1e-4 * rise_s);
      EXPECT_NEAR(rise_s, again[g]["rise_time_s"], 1e-4 * rise_s);
    }
  }
}

TEST(WallVacuum, ADesignFromTheWallIsEvaluatedAsItWasListed) {
  const Json request = FromWall();
  const Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  EXPECT_EQ(std::get<Json>(evaluated)["works"], true);
}

}  // namespace wall_vacuum_test
}  // namespace plenum::api
