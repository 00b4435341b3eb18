// Power from the wall or the robot: no battery, and the same designs as a catalogue finds whose
// batteries weigh nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "tests/api/support.h"
#include "tests/api/verified.h"

namespace plenum::api {
namespace power_test {

Json Powered(const std::string& example, Json power) {
  Json request = Example(example);
  request["supply"]["power"] = std::move(power);
  request["ranking"] = {{"count", 4}, {"proof", true}};
  return request;
}

std::set<std::string> Families(const Json& design) {
  std::set<std::string> families;
  for (const Json& row : design["parts"]) families.insert(row["family"].get<std::string>());
  return families;
}

bool NamesActuations(const Json& design) {
  const Json& margins = design["margins"];
  return std::any_of(margins.begin(), margins.end(), [](const Json& margin) {
    return margin["requirement"] == "/duty/actuations";
  });
}

double First(const Json& answer) { return answer["designs"][0]["objective"].get<double>(); }

// The catalogue with one battery for each of these voltages in place of its own.
std::vector<catalog::Part> WithIdealBatteries(const std::set<double>& voltages,
                                              double capacity_ah) {
  std::vector<catalog::Part> parts;
  catalog::Part battery;
  for (const catalog::Part& part : Project().parts)
    (part.family == "battery" ? battery : parts.emplace_back()) = part;
  for (const double voltage : voltages) {
    battery.id = "ideal-" + std::to_string(voltage);
    battery.orderable = true;
    battery.numbers["mass_kg"].value = battery.numbers["body_volume_ml"].value = 0.0;
    battery.numbers["nominal_voltage_v"].value = voltage;
    battery.numbers["capacity_ah"].value = capacity_ah;
    battery.numbers["current_max_a"].value = 1e5;
    parts.push_back(battery);
  }
  return parts;
}

std::set<double> VoltagesOfPumps() {
  std::set<double> voltages;
  for (const catalog::Part& part : Project().parts)
    if (part.family == "compressor") voltages.insert(part.numbers.at("voltage_v").value);
  return voltages;
}

Json AnswerOf(const Json& request, const std::vector<catalog::Part>& parts) {
  return AnswerRequest(std::get<DesignRequest>(ParseRequirements(request, parts)), {}, parts);
}

TEST(PowerTest, FromTheWallIsABatteryThatWeighsNothing) {
  const Json answer = Answered(Powered("exosuit", {{"kind", "wall"}}));
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_EQ(answer["status"], "optimal");
  for (const Json& design : answer["designs"]) {
    EXPECT_FALSE(Families(design).contains("battery"));
    EXPECT_EQ(design["settings"]["power"]["kind"], "wall");
    EXPECT_GT(design["settings"]["power"]["voltage_v"].get<double>(), 1.0);
    EXPECT_FALSE(NamesActuations(design));  // air and energy never end
  }
  EXPECT_EQ(Refusals(answer), "");
  Json request = Example("exosuit");
  request["ranking"] = {{"count", 1}};
  request["limits"]["batteries_max"] = 1;
  const Json ideal = AnswerOf(request, WithIdealBatteries(VoltagesOfPumps(), 1e5));
  EXPECT_NEAR(First(answer), First(ideal), 1e-7 * First(ideal));
  EXPECT_LT(First(answer), First(Answered(Example("exosuit"))));
}

TEST(PowerTest, OfARobotHasItsVoltageEnergyAndCurrent) {
  const Json robot = {{"kind", "robot"}, {"voltage_v", 12.0}};
  const Json answer = Answered(Powered("exosuit", robot));
  EXPECT_EQ(Refusals(answer), "");
  for (const Json& design : answer["designs"])
    EXPECT_EQ(design["settings"]["power"], (Json{{"kind", "robot"}, {"voltage_v", 12.0}}));
  for (const Json& design : answer["designs"]) EXPECT_FALSE(NamesActuations(design));
  Json request = Example("exosuit");
  request["ranking"] = {{"count", 1}};
  request["limits"]["batteries_max"] = 1;
  EXPECT_NEAR(First(answer), First(AnswerOf(request, WithIdealBatteries({12.0}, 1e5))),
              1e-7 * First(answer));
  // 80 % of a battery's energy may be used; all of the robot's may be.
  Json least = robot;
  least["energy_wh_max"] = answer["designs"][0]["totals"]["energy_wh"].get<double>() * 1.001;
  const Json just_enough = Answered(Powered("exosuit", least));
  EXPECT_NEAR(First(just_enough), First(answer), 1e-6 * First(answer));
  EXPECT_TRUE(NamesActuations(just_enough["designs"][0]));
  least["energy_wh_max"] = answer["designs"][0]["totals"]["energy_wh"].get<double>() * 0.5;
  const Json with_less = Answered(Powered("exosuit", least));
  EXPECT_TRUE(with_less["designs"].empty() || First(with_less) > First(answer) * (1.0 + 1e-6));
  Json weak = robot;
  weak["current_a_max"] = 1e-3;
  Json request_weak = Powered("exosuit", weak);
  request_weak["supply"]["configurations"] = {"compressor"};
  EXPECT_EQ(Answered(request_weak)["status"], "infeasible");
}

// Their rise time binds, too, and what the simulator's error moves the balance by, it must not
// leave undecided.
TEST(PowerTest, DesignsWhosePumpsRunAllTheTimeAreDecided) {
  Json request = Example("exosuit");
  request["supply"]["power"] = {{"kind", "wall"}};
  request["supply"]["configurations"] = {"compressor"};
  const Json answer = Answered(request);
  EXPECT_EQ(answer["proof"]["undecided"], 0);
  EXPECT_EQ(answer["status"], "optimal");
  int always_on = 0;
  for (const Json& design : answer["designs"])
    always_on += design["settings"]["compressor_duty"].get<double>() > 0.9999;
  EXPECT_GT(always_on, 0);
}

TEST(PowerTest, OfBottlesTakesTheBatteryAway) {
  Json request = Powered("gripper", {{"kind", "wall"}});
  request["supply"]["configurations"] = {"cylinder", "co2"};
  const Json answer = Answered(request);
  ASSERT_FALSE(answer["designs"].empty());
  EXPECT_FALSE(Families(answer["designs"][0]).contains("battery"));
  EXPECT_EQ(Refusals(answer), "");
}

// The wall gives each pump its voltage; where there is none that makes no designs of their own.
TEST(PowerTest, OfBottlesIsNoChoice) {
  Json request = Powered("gripper", {{"kind", "wall"}});
  request["supply"]["configurations"] = {"cylinder", "compressor"};
  request["ranking"] = {{"count", 6}, {"list", "combinations"}, {"proof", true}};
  const Json answer = Answered(request);
  ASSERT_EQ(answer["designs"].size(), 6u);
  std::set<std::string> different;
  for (const Json& design : answer["designs"]) different.insert(design["parts"].dump());
  EXPECT_EQ(different.size(), 6u);
  EXPECT_EQ(Refusals(answer), "");
}

TEST(PowerTest, ADesignWithItIsEvaluatedWithoutABattery) {
  const Json request = Powered("exosuit", {{"kind", "wall"}});
  const Json design = Answered(request)["designs"][0];
  const auto evaluated = Evaluated(request, design);
  for (const Error& error : ErrorsOf(evaluated)) ADD_FAILURE() << error.pointer << error.detail;
  EXPECT_EQ(std::get<Json>(evaluated)["works"], true);
  EXPECT_NEAR(std::get<Json>(evaluated)["totals"]["mass_kg"].get<double>(),
              design["totals"]["mass_kg"].get<double>(), 1e-9);
}

TEST(PowerTest, ABatteryBesideItIsNamed) {
  const Json battery = Answered(Powered("exosuit", {{"kind", "battery"}}))["designs"][0];
  EXPECT_TRUE(Families(battery).contains("battery"));
  EXPECT_TRUE(battery["settings"]["power"].is_null());
  const auto errors =
      ErrorsOf(RunEvaluation({{"schema", "evaluation/1"},
                              {"requirements", Powered("exosuit", {{"kind", "wall"}})},
                              {"design", battery}},
                             Project().parts, {}));
  std::string details;
  for (const Error& error : errors) details += error.detail;
  EXPECT_NE(details.find("power comes from the wall"), std::string::npos) << details;
}

TEST(PowerTest, IsDrawnWithThePartsBesideIt) {
  Json request = Powered("exosuit", {{"kind", "wall"}});
  request["robust"] = {{"draws", 20}};
  const Json answer = Answered(request);
  EXPECT_EQ(Refusals(answer), "");
  double most = 0.0;
  for (const Json& design : answer["designs"])
    most = std::max(most, design["robustness"]["probability"].get<double>());
  EXPECT_GT(most, 0.0);
}

TEST(PowerTest, WhatDoesNotFitIsNamed) {
  const auto errors = [](Json power) {
    return ErrorsOf(ParseRequirements(Powered("exosuit", std::move(power)), Project().parts));
  };
  EXPECT_NE(DetailAt(errors({{"kind", "robot"}}), "/supply/power/voltage_v"), "");
  EXPECT_NE(DetailAt(errors({{"kind", "sun"}}), "/supply/power/kind"), "");
  EXPECT_NE(DetailAt(errors({{"kind", "wall"}, {"voltage_v", 12}}), "/supply/power/voltage_v"), "");
  EXPECT_NE(DetailAt(errors({{"kind", "robot"}, {"voltage_v", -5}}), "/supply/power/voltage_v"),
            "");
  Json request = Powered("exosuit", {{"kind", "wall"}});
  for (const catalog::Part& part : Project().parts)
    if (part.family == "battery") request["require"]["battery"] = {part.id};
  EXPECT_NE(DetailAt(ErrorsOf(ParseRequirements(request, Project().parts)), "/require/battery"),
            "");
}

}  // namespace power_test
}  // namespace plenum::api
