// No table of any command is wider than the terminal.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/server/service.h"
#include "tests/support/places.h"

namespace plenum::server {
namespace width_test {

constexpr char kRule[] = "─";

std::size_t Characters(const std::string& text) {
  std::size_t count = 0;
  for (const char c : text) count += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return count;
}

// Characters of a UTF-8 text as texts of their own.
std::vector<std::string> CharactersOf(const std::string& text) {
  std::vector<std::string> found;
  for (const char c : text) {
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) found.emplace_back();
    found.back() += c;
  }
  return found;
}

// Whether a line leaves the gaps between the columns free that a rule shows.
bool IsRow(const std::string& line, const std::string& rule) {
  const auto characters = CharactersOf(line), gaps = CharactersOf(rule);
  for (std::size_t i = 0; i < characters.size(); ++i)
    if (i < gaps.size() && gaps[i] == " " && characters[i] != " ") return false;
  return !line.empty();
}

// The lines of tables: a rule, the title before it and the rows; and how many tables there are.
std::vector<std::string> TableLines(const std::string& text, int& tables) {
  std::vector<std::string> found;
  std::istringstream in(text);
  std::string rule;
  for (std::string line, before; std::getline(in, line); before = line) {
    const auto at = line.find_first_not_of(' ');
    if (at != std::string::npos && line.compare(at, sizeof kRule - 1, kRule) == 0) {
      found.push_back(before);
      rule = line;
      ++tables;
    }
    if (!rule.empty() && !IsRow(line, rule)) rule.clear();
    if (!rule.empty()) found.push_back(line);
  }
  return found;
}

class TablesOfCommands : public testing::TestWithParam<int> {
 protected:
  // Gives what it printed.
  std::string Check(const std::string& arguments) {
    const auto outcome =
        bench_.Run(arguments, "", "env COLUMNS=" + std::to_string(GetParam()) + " ");
    EXPECT_EQ(outcome.status, 0) << arguments << outcome.err;
    int tables = 0;
    for (const std::string& line : TableLines(outcome.out, tables))
      EXPECT_LE(Characters(line), static_cast<std::size_t>(GetParam())) << arguments << "\n"
                                                                        << line;
    EXPECT_GT(tables, 0) << arguments << "\n" << outcome.out;
    return outcome.out;
  }
  std::string Path(const std::string& example) const {
    return test::SourceDir() / "examples" / example;
  }
  std::string Write(const std::string& name, const api::Json& document) const {
    return bench_.Write(name, document.dump());
  }

  const Workbench bench_;
};

TEST_P(TablesOfCommands, OfDesigns) {
  Check("design " + Path("four_fingers.json") + " --top 3");
  Check("design " + Path("tank_arm.json") + " --top 3 --wide");
  Check("design " + Path("gripper_guaranteed.json"));
  api::Json judged = Example("gripper", 10.0);
  judged["robust"] = {{"draws", 20}};
  judged["explain"] = {{"prices", true}, {"ranks", 2}};
  Check("design " + Write("judged.json", judged));
  api::Json weighted = Example("gripper", 10.0);
  weighted["objective"]["minimize"] = {{"cost_eur", 0.01}, {"volume_l", 1.0}, {"energy_wh", 0.1}};
  weighted["prices"] = "lower_bound";
  Check("design " + Write("weighted.json", weighted));
  api::Json front = Example("gripper", 10.0);
  front["objective"] = {{"pareto", {"mass_kg", "volume_l"}}};
  Check("design " + Write("front.json", front));
  bench_.Write("result.json",
               bench_.Run("design " + Path("gripper.json") + " --top 2 --proof --json").out);
  Check("verify result.json");
  Check("evaluate " + Path("gripper_by_hand.json"));
}

TEST_P(TablesOfCommands, OfSimulations) {
  Check("simulate " + Path("simulation_effects.json"));
  Check("map " + Path("map.json"));
  const std::string map =
      R"({ "schema": "map/1", "source_pressure_ratio": [2, 3], "operating_pressure_ratio": [1.5],
           "expansion_ratio": [1, 2], "critical_ratio": [0.3], "compressor_flow_normalised": [0.5],
           "reservoir_volume_normalised": [20], "actuator_count": [1] })";
  bench_.Write("pump_map.json", map);
  Check("map pump_map.json");
}

TEST_P(TablesOfCommands, OfMeasuredData) {
  Check("diagnose " + Path("bottle_test_simulated.csv") + " --rig " + Path("bottle_test_rig.json"));
  Check("protocol smc-vq110u-5m-m5");
}

TEST_P(TablesOfCommands, OfTheCatalogue) {
  Check("catalog list");
  Check("catalog list valve --facets");
  Check("catalog list valve --columns response_time_ms coil_power_w port function channels");
  Check("catalog show smc-vq110u-5m-m5");
  Check("catalog show jsg-bd-03ab-3-12v");
  Check("catalog compare smc-vq110u-5m-m5 asco-rhb3xxx55x festo-mpye-5-1-8-hf-010-b");
  Check("catalog history");
  Check("catalog check");
  bench_.Write(
      "packs.csv",
      "manufacturer,part number,cells,Voltage (V),Capacity (Ah),current max (A),mass (g),"
      "body volume (mL)\nAcme,A very long number of a part that nobody can remember,3,11.1,"
      "2.2,44,185,95\n");
  Check("catalog import battery packs.csv --dry-run");
}

INSTANTIATE_TEST_SUITE_P(Widths, TablesOfCommands, testing::Values(80, 100, 140));

}  // namespace width_test
}  // namespace plenum::server
