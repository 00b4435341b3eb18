#include "api/design/read/requirements_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "optimizer/problem/problem.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace requirements_reader_test {

using optimizer::Configuration;
using testing::HasSubstr;

Parsed<DesignRequest> ParseWith(const Json& request) {
  return ParseRequirements(request, SmallCatalogue());
}
DesignRequest Good(const Json& request) {
  const auto parsed = ParseWith(request);
  for (const Error& error : ErrorsOf(parsed))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::get<DesignRequest>(parsed);
}
Errors Bad(const Json& request) { return ErrorsOf(ParseWith(request)); }
// Exactly one error, at the pointer; its detail.
std::string OnlyError(const Json& request, const std::string& pointer) {
  const Errors errors = Bad(request);
  EXPECT_EQ(errors.size(), 1u) << pointer;
  for (const Error& error : errors) EXPECT_EQ(error.pointer, pointer) << error.detail;
  return errors.empty() ? "" : errors.front().detail;
}

TEST(Requirements, ReadsTheContractsExampleInSi) {
  const DesignRequest request = Good(Requirements());
  EXPECT_EQ(request.name, "exosuit");
  EXPECT_EQ(request.time_limit_s, 30.0);
  EXPECT_EQ(request.request, Requirements());
  const optimizer::Problem& problem = request.problem;
  ASSERT_EQ(problem.groups.size(), 1u);
  const optimizer::ActuatorGroup& group = problem.groups[0];
  EXPECT_EQ(group.name, "spa_pack");
  EXPECT_EQ(group.count, 6);
  EXPECT_DOUBLE_EQ(group.chamber.rest_volume_m3, 50e-6);
  EXPECT_DOUBLE_EQ(group.chamber.expansion_ratio, 2.0);
  EXPECT_DOUBLE_EQ(group.chamber.operating_pressure_pa, 200e3);
  EXPECT_DOUBLE_EQ(group.chamber.ambient_pressure_pa, 100e3);
  EXPECT_EQ(group.chamber.dead_volume_m3, 0.0);
  EXPECT_DOUBLE_EQ(group.tube_length_m, 0.5);
  EXPECT_EQ(group.fittings_per_line, 2);
  EXPECT_DOUBLE_EQ(group.rise_time_max_s, 0.5);
  EXPECT_DOUBLE_EQ(group.fall_time_max_s, 0.6);
  EXPECT_DOUBLE_EQ(group.pressure_max_pa, 205e3);
  EXPECT_DOUBLE_EQ(problem.frequency_hz, 0.1);
  EXPECT_DOUBLE_EQ(problem.actuations, 1000);
  EXPECT_TRUE(problem.simultaneous);
  EXPECT_EQ(problem.configurations.size(), 4u);
  EXPECT_DOUBLE_EQ(problem.mains.pressure_pa, 700e3);
  EXPECT_NEAR(problem.mains.flow_max_m3_per_s, 0.00333333333, 1e-11);  // 200 L/min
  EXPECT_DOUBLE_EQ(problem.source_pressure_max_pa, 700e3);
  EXPECT_EQ(problem.mass_max_kg, optimizer::kUnlimited);
  EXPECT_EQ(problem.objective.mass_kg, 1.0);
  EXPECT_EQ(problem.objective.volume_l, 0.0);
  EXPECT_EQ(problem.count, 20);
  EXPECT_EQ(problem.solver, optimizer::NlpSolver::kIpopt);
  EXPECT_EQ(Good(With(Requirements(), "/ranking/solver", "nlopt")).problem.solver,
            optimizer::NlpSolver::kNlopt);
  EXPECT_EQ(problem.require.at(optimizer::Family::kValve), std::set<std::string>{"valve-1"});
  EXPECT_EQ(problem.exclude, std::set<std::string>{"reservoir-1"});
  EXPECT_EQ(problem.parts.valves.size(), 1u);
}

TEST(Requirements, LeavesOutPartsThatAreExcludedOrNotRequired) {
  std::vector<catalog::Part> parts = SmallCatalogue();
  parts.push_back(PartOf("valve"));
  parts.back().id = "valve-2";
  parts.push_back(PartOf("tubing"));
  parts.back().id = "tubing-2";
  const auto ids = [&](const Json& request) {
    const auto parsed = std::get<DesignRequest>(ParseRequirements(request, parts));
    std::set<std::string> left;
    for (const auto& valve : parsed.problem.parts.valves) left.insert(valve.basics.id);
    for (const auto& tube : parsed.problem.parts.tubing) left.insert(tube.per_metre.id);
    return left;
  };
  const Json all = Without(Without(Requirements(), "/require"), "/exclude");
  EXPECT_EQ(ids(all), (std::set<std::string>{"valve-1", "valve-2", "tubing-1", "tubing-2"}));
  EXPECT_EQ(ids(With(all, "/exclude", {"tubing-1", "valve-2"})),
            (std::set<std::string>{"valve-1", "tubing-2"}));
  EXPECT_EQ(ids(With(all, "/require", {{"valve", {"valve-2"}}})),
            (std::set<std::string>{"valve-2", "tubing-1", "tubing-2"}));
}

TEST(Requirements, FillsInDefaults) {
  const DesignRequest request = Good(Parse(R"({ "schema": "requirements/1",
    "actuators": [ { "rest_volume_ml": 50, "expansion_ratio": 2,
                     "operating_pressure_kpa_gauge": 100, "tube_length_m": 0.5,
                     "rise_time_s_max": null } ],
    "duty": { "frequency_hz": 0.1, "actuations": 1e3 } })"));
  const optimizer::Problem& problem = request.problem;
  EXPECT_EQ(problem.groups[0].name, "group 1");
  EXPECT_EQ(problem.groups[0].count, 1);
  EXPECT_EQ(problem.groups[0].rise_time_max_s, optimizer::kUnlimited);
  EXPECT_EQ(problem.groups[0].fall_time_max_s, optimizer::kUnlimited);
  EXPECT_NEAR(problem.groups[0].pressure_max_pa, 205e3, 1e-6);  // 1.05 × 100 kPa gauge
  EXPECT_TRUE(problem.simultaneous);
  EXPECT_EQ(problem.rise_fraction, 0.95);
  EXPECT_EQ(problem.fall_fraction, 0.05);
  EXPECT_EQ(problem.configurations,
            (std::set{Configuration::kCylinder, Configuration::kCo2, Configuration::kCompressor}));
  EXPECT_EQ(problem.source_pressure_max_pa, optimizer::kUnlimited);
  EXPECT_EQ(problem.objective.mass_kg, 1.0);
  EXPECT_EQ(problem.count, 20);
  EXPECT_EQ(problem.limits.cylinders, 4);
  EXPECT_EQ(request.time_limit_s, 30.0);
}

TEST(Requirements, AddsGaugeToTheGivenAmbient) {
  const auto request = Good(With(Requirements(), "/ambient", Parse(R"({"pressure_kpa_abs": 80})")));
  EXPECT_DOUBLE_EQ(request.problem.groups[0].chamber.operating_pressure_pa, 180e3);
  EXPECT_DOUBLE_EQ(request.problem.groups[0].pressure_max_pa, 185e3);
  EXPECT_DOUBLE_EQ(request.problem.mains.pressure_pa, 680e3);
  EXPECT_DOUBLE_EQ(request.problem.ambient.temperature_k, 293.15);
}

TEST(Requirements, NamesEveryFieldOutOfRange) {
  const struct {
    const char* pointer;
    const char* value;
    const char* detail;
  } cases[] = {
      {"/schema", "\"requirements/2\"", "requirements/1"},
      {"/name", "7", "text"},
      {"/actuators", "[]", "1 to 16"},
      {"/actuators", "{}", "list"},
      {"/actuators/0", "5", "object"},
      {"/actuators/0/count", "0", "≥ 1 and ≤ 64, not 0"},
      {"/actuators/0/count", "1.5", "whole number"},
      {"/actuators/0/rest_volume_ml", "-1", "≥ 0.01 and ≤ 1e6, not -1"},
      {"/actuators/0/rest_volume_ml", "\"50\"", "number"},
      {"/actuators/0/rest_volume_ml", "null", "number"},
      {"/actuators/0/rest_volume_ml", "1e300", "≤ 1e6"},
      {"/actuators/0/expansion_ratio", "0.5", "≥ 1 and ≤ 1000"},
      {"/actuators/0/tube_length_m", "0", "≥ 0.01 and ≤ 100"},
      {"/actuators/0/fittings_per_line", "6", "≤ 5"},
      {"/actuators/0/rise_time_s_max", "0", "> 0"},
      {"/actuators/0/fall_time_s_max", "-2", "> 0"},
      {"/actuators/0/pressure_kpa_gauge_max", "99", "≥ the operating pressure of 100"},
      {"/ranking/solver", "\"cplex\"", "ipopt or nlopt"},
      {"/duty", "[]", "object"},
      {"/duty/frequency_hz", "0", "≥ 1e-4 and ≤ 100"},
      {"/duty/actuations", "0.5", "≥ 1"},
      {"/duty/simultaneous", "\"yes\"", "true or false"},
      {"/rise/to_fraction", "0", "> 0 and ≤ 1"},
      {"/fall/to_fraction", "1", "≥ 0 and < 1"},
      {"/supply/configurations", "[]", "1 to 7"},
      {"/supply/configurations/1", "\"diesel\"",
       "compressor, mains, tank, tank_and_pump or direct_pump"},
      {"/supply/configurations/3", "\"co2\"", "\"co2\" is listed twice"},
      {"/supply/mains", "null", "required by the configuration mains"},
      {"/supply/mains/pressure_kpa_gauge", "0", "≥ 1"},
      {"/supply/mains/flow_l_per_min_anr_max", "0", "> 0"},
      {"/supply/mass_kg_max", "0", "> 0"},
      {"/ambient/pressure_kpa_abs", "10", "≥ 20 and ≤ 200"},
      {"/ambient/temperature_k", "20", "≥ 200 and ≤ 350"},
      {"/objective/minimize", "\"weight\"", "mass_kg, volume_l, cost_eur or energy_wh"},
      {"/objective/minimize", R"({"mass_kg": 0})", "at least one weight"},
      {"/objective/minimize/mass_kg", "-1", "≥ 0"},
      {"/objective/pareto", R"(["mass_kg"])", "2 to 3"},
      {"/ranking/count", "501", "≤ 500"},
      {"/ranking/probability_min", "1.5", "≥ 0 and ≤ 1"},
      {"/robust", "true", "object"},
      {"/robust/draws", "0", "≥ 1"},
      {"/robust/tolerance/derived", "1", "< 1"},
      {"/robust/tolerance/guessed", "0.1", "unknown field"},
      {"/explain", "[]", "object"},
      {"/explain/prices", "1", "true or false"},
      {"/explain/ranks", "21", "≤ 20"},
      {"/ranking/time_limit_s", "0", "≥ 0.01 and ≤ 3600"},
      {"/limits/co2_max", "17", "≤ 16"},
      {"/require/valve", "[]", "1 to"},
      {"/require/valve/0", "\"valve-2\"", "nearest id: valve-1"},
      {"/require/valve/0", "\"fitting-1\"", "is a fitting, not a valve"},
      {"/require/valve/0", "\"custom\"", "no part \"custom\""},
      {"/exclude/0", "\"reservoir-7\"", "nearest id: reservoir-1"},
      {"/model", "\"revision 3\"", "nominal"},
  };
  for (const auto& [pointer, value, detail] : cases) {
    Json request = Requirements();
    if (std::string(pointer) == "/objective/minimize/mass_kg")
      request["objective"]["minimize"] = {};
    if (std::string(pointer).starts_with("/explain/")) request["explain"] = Json::object();
    if (std::string(pointer).starts_with("/robust/"))
      request["robust"]["tolerance"] = Json::object();
    EXPECT_THAT(OnlyError(With(request, pointer, Parse(value)), pointer), HasSubstr(detail));
  }
}

TEST(Requirements, ReadsAFront) {
  const auto objective = [](const char* text) {
    return With(Requirements(), "/objective", Parse(text));
  };
  using optimizer::Amount;
  const DesignRequest first = Good(objective(R"({"pareto": ["volume_l", "mass_kg"]})"));
  EXPECT_EQ(first.pareto, (std::vector{Amount::kVolume, Amount::kMass}));
  EXPECT_EQ(first.problem.objective, optimizer::Objective{.volume_l = 1.0});
  const DesignRequest ordered =
      Good(objective(R"({"pareto": ["volume_l", "energy_wh"], "minimize": {"energy_wh": 2}})"));
  EXPECT_EQ(ordered.problem.objective, optimizer::Objective{.energy_wh = 2.0});
  EXPECT_THAT(OnlyError(objective(R"({"pareto": ["volume_l", "mass_kg"], "minimize": "cost_eur"})"),
                        "/objective/minimize"),
              HasSubstr("cost_eur is not an amount of the front"));
  EXPECT_THAT(OnlyError(objective(R"({"pareto": ["mass_kg", "weight"]})"), "/objective/pareto/1"),
              HasSubstr("mass_kg, volume_l, cost_eur or energy_wh"));
  EXPECT_THAT(OnlyError(objective(R"({"pareto": ["mass_kg", "mass_kg"]})"), "/objective/pareto/1"),
              HasSubstr("listed twice"));
  EXPECT_TRUE(Good(Requirements()).pareto.empty());
  Json front = Requirements();
  front["objective"] = Parse(R"({"pareto": ["mass_kg", "volume_l"]})");
  EXPECT_THAT(OnlyError(With(front, "/ranking/proof", true), "/ranking/proof"),
              HasSubstr("is for a list by one objective"));
  EXPECT_THAT(OnlyError(With(front, "/ranking/probability_min", 0.5), "/ranking/probability_min"),
              HasSubstr("is for a list by one objective"));
}

TEST(Requirements, ExplanationsNeedAPlainList) {
  Json request = Requirements();
  EXPECT_FALSE(Good(request).explain.has_value());
  request["explain"] = Parse(R"({"prices": true, "ranks": 3, "time_limit_s": 5})");
  const DesignRequest parsed = Good(request);
  EXPECT_TRUE(parsed.explain->prices);
  EXPECT_EQ(parsed.explain->ranks, 3);
  EXPECT_EQ(parsed.explain->time_limit_s, 5.0);
  EXPECT_THAT(OnlyError(With(request, "/ranking/probability_min", 0.9), "/explain/ranks"),
              HasSubstr("must be 0"));
  EXPECT_THAT(
      OnlyError(With(request, "/objective", Parse(R"({"pareto": ["mass_kg", "volume_l"]})")),
                "/explain"),
      HasSubstr("not a front"));
}

TEST(Requirements, RequiresTheFieldsWithoutDefault) {
  for (const char* pointer :
       {"/schema", "/actuators", "/duty", "/duty/frequency_hz", "/duty/actuations",
        "/actuators/0/rest_volume_ml", "/actuators/0/expansion_ratio",
        "/actuators/0/operating_pressure_kpa_gauge", "/actuators/0/tube_length_m",
        "/supply/mains/pressure_kpa_gauge", "/objective/minimize"})
    EXPECT_THAT(OnlyError(Without(Requirements(), pointer), pointer), HasSubstr("is required"));
}

TEST(Requirements, SuggestsTheNearestKnownFieldEverywhere) {
  for (const auto& [pointer, nearest] : std::map<std::string, std::string>{
           {"/actuator", "actuators"},
           {"/actuators/0/rest_volume", "rest_volume_ml"},
           {"/actuators/0/rise_time_max_s", "rise_time_s_max"},
           {"/duty/frequency", "frequency_hz"},
           {"/rise/fraction", "to_fraction"},
           {"/supply/source_pressure_max", "source_pressure_kpa_gauge_max"},
           {"/supply/mains/pressure_kpa", "pressure_kpa_gauge"},
           {"/ambient/temperature_c", "temperature_k"},
           {"/objective/minimise", "minimize"},
           {"/ranking/counts", "count"},
           {"/limits/battery_max", "batteries_max"},
           {"/require/valves", "valve"}})
    EXPECT_EQ(OnlyError(With(Requirements(), pointer, 1), pointer),
              "unknown field; nearest known: " + nearest);
}

TEST(Requirements, ReportsAllErrorsAtOnce) {
  Json request = Requirements();
  request["actuators"][0]["rest_volume_ml"] = -1;
  request["actuators"][0]["color"] = "red";
  request["duty"].erase("actuations");
  request["ranking"]["count"] = "ten";
  request["exclude"][0] = "nothing";
  request["modle"] = "nominal";
  std::set<std::string> pointers;
  for (const Error& error : Bad(request)) pointers.insert(error.pointer);
  EXPECT_EQ(pointers,
            (std::set<std::string>{"/actuators/0/rest_volume_ml", "/actuators/0/color",
                                   "/duty/actuations", "/ranking/count", "/exclude/0", "/modle"}));
}

TEST(Requirements, RefusesWhatIsNotAnObject) {
  for (const char* text : {"null", "[]", "3", "\"requirements/1\"", "true"})
    EXPECT_EQ(Bad(Parse(text)).front().pointer, "") << text;
}

TEST(Requirements, GroupNamesAreUnique) {
  Json request = Requirements();
  request["actuators"].push_back(request["actuators"][0]);
  EXPECT_THAT(OnlyError(request, "/actuators/1/name"), HasSubstr("\"spa_pack\""));
}

TEST(Requirements, ReadsAMeasuredPressureVolumeTable) {
  Json request = Requirements();
  Json& group = request["actuators"][0];
  group.erase("expansion_ratio");
  group["pressure_volume"] = Parse(R"([ {"pressure_kpa_gauge": 0, "volume_ml": 50},
    {"pressure_kpa_gauge": 60, "volume_ml": 70}, {"pressure_kpa_gauge": 120, "volume_ml": 100} ])");
  const model::Chamber chamber = Good(request).problem.groups[0].chamber;
  EXPECT_THAT(chamber.volume_curve.x(), testing::ElementsAre(100e3, 160e3, 220e3));
  EXPECT_DOUBLE_EQ(chamber.volume_curve(160e3), 70e-6);
  EXPECT_EQ(model::WhyInvalid(chamber), "");

  EXPECT_THAT(
      OnlyError(With(request, "/actuators/0/expansion_ratio", 2), "/actuators/0/expansion_ratio"),
      HasSubstr("not both"));
  EXPECT_THAT(
      OnlyError(With(request, "/actuators/0/rest_volume_ml", 60), "/actuators/0/rest_volume_ml"),
      HasSubstr("gives 50"));
  const std::string table = "/actuators/0/pressure_volume";
  EXPECT_THAT(OnlyError(With(request, table + "/2/pressure_kpa_gauge", 99), table),
              HasSubstr("from 0 to the operating pressure of 100 kPa gauge, not from 0 to 99"));
  EXPECT_THAT(OnlyError(With(request, table + "/0/pressure_kpa_gauge", 5), table),
              HasSubstr("not from 5 to 120"));
  EXPECT_THAT(
      OnlyError(With(request, table + "/1/pressure_kpa_gauge", 0), table + "/1/pressure_kpa_gauge"),
      HasSubstr("must rise"));
  EXPECT_THAT(OnlyError(With(request, table + "/1/volume_ml", 49), table + "/1/volume_ml"),
              HasSubstr("must not fall"));
  EXPECT_THAT(OnlyError(With(request, table + "/1/volume", 49), table + "/1/volume"),
              HasSubstr("volume_ml"));
  group.erase("rest_volume_ml");
  EXPECT_DOUBLE_EQ(Good(request).problem.groups[0].chamber.rest_volume_m3, 50e-6);
}

TEST(Requirements, RefusesAnOperatingPressureAboveEverySource) {
  Json request = Without(Requirements(), "/actuators/0/pressure_kpa_gauge_max");
  const std::string pointer = "/actuators/0/operating_pressure_kpa_gauge";
  request["actuators"][0]["operating_pressure_kpa_gauge"] = 650;
  EXPECT_THAT(OnlyError(request, pointer), testing::AllOf(HasSubstr("650"), HasSubstr("600")));
  // Above the wall supply alone is an error only where nothing else is allowed.
  request["supply"]["source_pressure_kpa_gauge_max"] = nullptr;
  Good(request);
  request["supply"]["configurations"] = {"mains"};
  EXPECT_THAT(OnlyError(request, pointer),
              testing::AllOf(HasSubstr("650"), HasSubstr("/supply/mains"), HasSubstr("600")));
  OnlyError(Without(request, "/supply/mains"), "/supply/mains");
  Good(With(request, pointer, 600));
}

TEST(Requirements, RefusesAnEmptyFamilyThatEveryConfigurationNeeds) {
  Json request = Requirements();
  request["exclude"] = {"tubing-1"};
  EXPECT_THAT(OnlyError(request, "/exclude"), HasSubstr("tubing"));
  request["exclude"] = {"valve-1"};
  EXPECT_THAT(OnlyError(request, "/require/valve"), HasSubstr("valve"));
  request = Without(request, "/require");
  // Without cylinders the other configurations remain.
  request["exclude"] = {"cylinder-1"};
  Good(request);
  request["supply"]["configurations"] = {"cylinder"};
  EXPECT_THAT(OnlyError(request, "/exclude"), HasSubstr("cylinder"));
  // Lines without fittings need none.
  request["exclude"] = {"fitting-1"};
  EXPECT_THAT(OnlyError(request, "/exclude"), HasSubstr("fitting"));
  request["actuators"][0]["fittings_per_line"] = 0;
  Good(request);
  // Mains needs no battery.
  request["exclude"] = {"battery-1"};
  EXPECT_THAT(OnlyError(request, "/exclude"), HasSubstr("battery"));
  request["supply"]["configurations"] = {"mains"};
  Good(request);

  const auto parsed =
      ParseRequirements(Without(Without(Requirements(), "/require"), "/exclude"), {});
  ASSERT_FALSE(ErrorsOf(parsed).empty());
  for (const Error& error : ErrorsOf(parsed)) EXPECT_EQ(error.pointer, "");
}

TEST(Requirements, MadeToMeasureReservoirIsAPartByName) {
  Json request = Requirements();
  request["supply"]["configurations"] = {"compressor"};
  request["require"] = Parse(R"({"reservoir": ["custom"]})");
  Good(request);
  request["exclude"] = {"custom"};
  EXPECT_THAT(OnlyError(request, "/require/reservoir"), HasSubstr("reservoir"));
  request.erase("require");
  Good(request);
  request["exclude"] = {"custom", "reservoir-1"};
  EXPECT_THAT(OnlyError(request, "/exclude"), HasSubstr("reservoir"));
}

TEST(Requirements, WeightsMakeTheObjective) {
  const auto request = Good(
      With(Requirements(), "/objective/minimize", Parse(R"({"mass_kg": 1.0, "volume_l": 0.3})")));
  EXPECT_EQ(request.problem.objective.mass_kg, 1.0);
  EXPECT_EQ(request.problem.objective.volume_l, 0.3);
  EXPECT_EQ(request.problem.objective.cost_eur, 0.0);
  const auto energy = Good(With(Requirements(), "/objective/minimize", "energy_wh"));
  EXPECT_EQ(energy.problem.objective.energy_wh, 1.0);
}

}  // namespace requirements_reader_test
}  // namespace plenum::api
