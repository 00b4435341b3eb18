// Ejectors, from the request to the checked answer.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "api/design/read/requirements_reader.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace ejector_test {

Json Asked() {
  Json request = Example("ejector_gripper");
  request["supply"]["vacuum"]["configurations"] = {"ejector"};
  request["ranking"] = {{"count", 3}, {"per_source", 20}, {"proof", true}};
  return request;
}

double Number(const std::string& id, const char* field) {
  const auto row = std::find_if(Project().parts.begin(), Project().parts.end(),
                                [&](const catalog::Part& part) { return part.id == id; });
  return row->numbers.at(field).value;
}

const Json& EjectorOf(const Json& design) {
  return *std::find_if(design["parts"].begin(), design["parts"].end(),
                       [](const Json& row) { return row["family"] == "ejector"; });
}

std::string ErrorsIn(const Json& request) {
  std::string all;
  for (const Error& error : ErrorsOf(ParseRequirements(request, Project().parts)))
    all += error.pointer + " " + error.detail + "\n";
  return all;
}

// With a reservoir and without: no battery, no energy but the coils', and the air that the rows
// say.
TEST(EjectorTest, IsDesignedAndVerified) {
  const Json answer = Answered(Asked());
  EXPECT_EQ(answer["status"], "optimal");
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"]) {
    EXPECT_TRUE(design["configuration"] == "ejector" ||
                design["configuration"] == "direct_ejector");
    const Json& ejector = EjectorOf(design);
    const double air =
        ejector["quantity"].get<double>() * Number(ejector["id"], "air_consumption_l_per_min_anr");
    EXPECT_NEAR(design["performance"]["compressed_air_l_per_min_anr"].get<double>(), air,
                1e-9 * air);
    EXPECT_LE(air, 100.0);
    EXPECT_LE(Number(ejector["id"], "supply_pressure_kpa_gauge"), 600.0);
    EXPECT_LE(design["settings"]["vacuum_kpa_gauge"].get<double>(), -70.0);
    const auto& margins = design["margins"];
    EXPECT_TRUE(std::any_of(margins.begin(), margins.end(), [&](const Json& margin) {
      return margin["requirement"] == "/supply/mains/flow_l_per_min_anr_max" &&
             margin["required"] == 100.0 && std::abs(margin["achieved"].get<double>() - air) < 1e-6;
    }));
    const auto& estimated = design["data_quality"]["estimated"];
    EXPECT_NE(std::find(estimated.begin(), estimated.end(), "ejector.suction_curve"),
              estimated.end());
  }
}

// A design without a reservoir as a rig by itself, its ejector by two points of a curve.
TEST(EjectorTest, TheSimulatorSaysTheSame) {
  Json request = Asked();
  request["ranking"]["list"] = "combinations";
  const Json answer = Answered(request);
  const auto& designs = answer["designs"];
  const auto direct = std::find_if(designs.begin(), designs.end(), [](const Json& design) {
    return design["configuration"] == "direct_ejector";
  });
  ASSERT_NE(direct, designs.end());
  const std::string id = EjectorOf(*direct)["id"];
  const auto id_of = [&](const std::string& family) {
    for (const Json& row : (*direct)["parts"])
      if (row["family"] == family) return row["id"].get<std::string>();
    return std::string();
  };
  Json elements = Json::array();
  elements.push_back({{"part", id_of("valve")}});
  elements.push_back({{"part", id_of("fitting")}});
  elements.push_back({{"part", id_of("tubing")}, {"length_m", 1.0}});
  elements.push_back({{"part", id_of("fitting")}});
  Json curve = Json::array();
  curve.push_back(
      {{"pressure_kpa_gauge", Number(id, "vacuum_max_kpa_gauge")}, {"free_air_l_per_min", 0.0}});
  curve.push_back({{"pressure_kpa_gauge", 0.0},
                   {"free_air_l_per_min", Number(id, "suction_flow_l_per_min_anr")}});
  const Json source = {
      {"kind", "direct_vacuum_pump"}, {"curve", curve}, {"count", EjectorOf(*direct)["quantity"]}};
  Json rig = {{"schema", "simulation/1"},
              {"actuators",
               {{{"rest_volume_ml", 110},
                 {"expansion_ratio", 0.9},
                 {"operating_pressure_kpa_gauge", -70},
                 {"close_at_operating_pressure", true},
                 {"line", {{"elements", elements}}}}}},
              {"source", source},
              {"cycle", {{"frequency_hz", 0.1}, {"inflate_fraction", 0.5}, {"cycles", 1}}},
              {"t_end_s", 10.0}};
  const auto result = RunSimulation(rig, Project().parts);
  for (const Error& error : ErrorsOf(result)) ADD_FAILURE() << error.pointer << error.detail;
  const double rise_s = std::get<Json>(result)["performance"]["groups"][0]["rise_time_s"];
  EXPECT_NEAR((*direct)["performance"]["groups"][0]["rise_time_s"].get<double>(), rise_s,
              1e-4 * rise_s);
}

TEST(EjectorTest, LessAirIsNeverBetterAndTooLittleIsNamed) {
  const double best = Answered(Asked())["designs"][0]["objective"];
  Json less = Asked();
  less["supply"]["mains"]["flow_l_per_min_anr_max"] = 50;
  const Json lighter = Answered(less);
  EXPECT_GE(lighter["designs"][0]["objective"].get<double>(), best * (1.0 - 1e-9));
  less["supply"]["mains"]["flow_l_per_min_anr_max"] = 5;
  const Json none = Answered(less);
  EXPECT_EQ(none["status"], "infeasible");
  ASSERT_EQ(none["conflicts"].size(), 1u);
  EXPECT_EQ(none["conflicts"][0][0]["requirement"], "/supply/mains/flow_l_per_min_anr_max");
  EXPECT_EQ(Refusals(none), "");
}

// A wall of less pressure than a row's supply leaves that ejector out.
TEST(EjectorTest, TheWallMustHaveItsPressure) {
  Json request = Asked();
  request["supply"]["mains"]["pressure_kpa_gauge"] = 300;
  EXPECT_NE(ErrorsIn(request).find("no part of the family ejector"), std::string::npos);
}

TEST(EjectorTest, IsAskedForByNameOrByItsAir) {
  Json request = Asked();
  request["supply"].erase("mains");
  EXPECT_NE(ErrorsIn(request).find("/supply/mains is required by the ejectors"), std::string::npos);
  request["supply"].erase("vacuum");
  using optimizer::Configuration;
  const auto configurations = [&] {
    return std::get<DesignRequest>(ParseRequirements(request, Project().parts))
        .problem.configurations;
  };
  const std::set<Configuration> pumps{Configuration::kVacuumPump, Configuration::kDirectVacuumPump};
  EXPECT_EQ(configurations(), pumps);
  request["supply"]["mains"] = {{"pressure_kpa_gauge", 600.0}};
  std::set<Configuration> all = pumps;
  all.insert({Configuration::kEjector, Configuration::kDirectEjector});
  EXPECT_EQ(configurations(), all);
}

// Neither ejectors nor pumps without a reservoir are guaranteed: alone they are refused.
TEST(EjectorTest, AGuaranteeOfEjectorsAloneIsRefused) {
  Json request = Asked();
  request["guarantee"] = true;
  EXPECT_NE(ErrorsIn(request).find("/guarantee is for vacuum pumps with a reservoir"),
            std::string::npos);
  request["supply"]["vacuum"]["configurations"] = {"pump"};
  EXPECT_EQ(ErrorsIn(request), "");
  request["supply"]["pumps"] = "per_group";
  EXPECT_NE(ErrorsIn(request).find("/guarantee"), std::string::npos);
}

}  // namespace ejector_test
}  // namespace plenum::api
