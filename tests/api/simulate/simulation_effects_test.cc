// Effects of a simulation request: units, what the answer shows, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "api/json/json.h"
#include "api/simulate/effects.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"
#include "tests/support/places.h"

namespace plenum::api {
namespace simulation_effects_test {

using testing::HasSubstr;

constexpr double kCloseS = 1.066905;

// The bench of the published residuals, up to `end_s`.
Json Bench(const std::string& effects, double end_s = kCloseS + 2e-3) {
  Json request = Parse(R"({ "schema": "simulation/1",
    "actuators": [ { "name": "a", "rest_volume_ml": 50, "expansion_ratio": 2,
                     "operating_pressure_kpa_gauge": 100,
                     "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 } } ],
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200 },
    "valve": [ { "t_s": 0, "state": "inflate" }, { "t_s": 1.066905, "state": "hold" },
               { "t_s": 6.066905, "state": "deflate" } ], "sample_hz": 1 })");
  request["effects"] = Parse(effects);
  request["t_end_s"] = end_s;
  return request;
}

Json Answer(const Json& request) {
  const auto result = RunSimulation(request, SmallCatalogue());
  for (const Error& error : ErrorsOf(result))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::holds_alternative<Json>(result) ? std::get<Json>(result) : Json();
}
Errors Refused(const Json& request) { return ErrorsOf(RunSimulation(request, SmallCatalogue())); }

double LastKpa(const Json& request) {
  return Answer(request)["groups"][0]["pressure_kpa_gauge"].back().get<double>();
}

// Published residuals, kPa, right after closing and at the end of a hold of 5 s.
TEST(SimulationEffects, ShowThePublishedResiduals) {
  const auto check = [](const std::string& effect, double closed_kpa, double held_kpa) {
    SCOPED_TRACE(effect);
    for (const auto& [end_s, residual_kpa] :
         {std::pair{kCloseS + 2e-3, closed_kpa}, std::pair{kCloseS + 4.99, held_kpa}}) {
      EXPECT_NEAR(LastKpa(Bench("[" + effect + "]", end_s)) - LastKpa(Bench("[]", end_s)),
                  residual_kpa, 0.006);
    }
  };
  check(R"({"id": "dead_volume", "parameters": {"volume_ml": 10}})", -4.37, -4.37);
  check(R"({"id": "heat_transfer", "parameters": {"time_constant_s": 2}})", 8.05, 0.22);
  check(R"({"id": "hysteresis", "parameters": {"half_width_kpa": 4}})", 1.76, 1.76);
  check(R"({"id": "leak", "parameters": {"sonic_conductance_dm3_per_s_bar": 0.0005,
                                         "critical_ratio": 0.3}})",
        -0.33, -2.71);
  check(R"({"id": "supply_droop", "parameters": {"volume_ml": 500, "critical_ratio": 0.3,
                                                 "sonic_conductance_dm3_per_s_bar": 0.01}})",
        -4.58, -4.58);
  check(R"({"id": "sensor_offset", "parameters": {"offset_kpa": 1}})", 1.0, 1.0);
  check(R"({"id": "cracking_pressure", "parameters": {"pressure_kpa": 5}})", -1.50, -1.50);
}

// Rigid 50 mL at 200 kPa absolute: q = G·(2² − 1²)/2 bar = 1.5 L/min ANR at 1 L/(min·bar).
TEST(SimulationEffects, ALaminarLeakIsInLitresPerMinuteAndBar) {
  Json request = Bench(R"([{"id": "leak",
      "parameters": {"law": "laminar", "conductance_l_per_min_bar": 1}}])",
                       1e-3);
  request["actuators"][0]["blocked"] = true;
  request["valve"] = Json::array();
  request["initial"] = {{"pressure_kpa_gauge", 100.0}};
  request["sample_hz"] = 1000;
  const double fallen_kpa = 100.0 - LastKpa(request);
  EXPECT_NEAR(fallen_kpa, 1.5 / 60.0 / 0.05 * 100.0 * 1e-3, 2e-4);
}

TEST(SimulationEffects, TheSensorIsShownBesideTheActuator) {
  Json request = Bench(R"([{"id": "sensor_gain", "parameters": {"gain": 1.02}},
                           {"id": "heat_transfer", "parameters": {"time_constant_s": 1}}])");
  request["initial"] = {{"temperature_k", 310.0}};
  const Json group = Answer(request)["groups"][0];
  const double truth = group["actuator_pressure_kpa_gauge"].back().get<double>();
  EXPECT_NEAR(group["pressure_kpa_gauge"].back().get<double>(), 1.02 * truth, 1e-9);
  EXPECT_NEAR(group["temperature_k"][0].get<double>(), 310.0, 1e-9);
  const Json plain = Answer(Bench("[]"))["groups"][0];
  EXPECT_FALSE(plain.contains("actuator_pressure_kpa_gauge"));
  EXPECT_FALSE(plain.contains("temperature_k"));
}

TEST(SimulationEffects, AGroupMayHaveItsOwnAndMayBeBlocked) {
  Json request = Bench(R"([{"id": "dead_volume", "parameters": {"volume_ml": 10}}])");
  Json twin = request["actuators"][0];
  twin["name"] = "b";
  twin["effects"] = Parse(R"([{"id": "sensor_offset", "parameters": {"offset_kpa": 1}}])");
  request["actuators"].push_back(twin);
  request["actuators"].push_back(With(With(twin, "/name", "c"), "/blocked", true));
  const Json groups = Answer(request)["groups"];
  EXPECT_FALSE(groups[0].contains("actuator_pressure_kpa_gauge"));
  EXPECT_NEAR(groups[1]["pressure_kpa_gauge"].back().get<double>() -
                  groups[0]["pressure_kpa_gauge"].back().get<double>(),
              1.0, 1e-6);
  EXPECT_EQ(groups[2]["volume_ml"].back(), 50.0);
}

TEST(SimulationEffects, AreRefusedByNameWithTheUsersRange) {
  const auto detail = [](const std::string& effects, const std::string& pointer) {
    return DetailAt(Refused(Bench(effects)), pointer);
  };
  EXPECT_THAT(detail(R"([{"id": "leek", "parameters": {}}])", "/effects/0/id"),
              HasSubstr("nearest id: leak"));
  EXPECT_THAT(detail(R"([{"id": "dead_volume", "parameters": {"volume_m3": 1}}])",
                     "/effects/0/parameters/volume_m3"),
              HasSubstr("nearest known: volume_ml"));
  EXPECT_THAT(detail(R"([{"id": "hysteresis", "parameters": {"half_width_kpa": 101}}])",
                     "/effects/0/parameters/half_width_kpa"),
              HasSubstr("≥ 0 and ≤ 100"));
  EXPECT_THAT(detail(R"([{"id": "creep", "parameters": {"fraction": 0.1}}])",
                     "/effects/0/parameters/time_constant_s"),
              HasSubstr("required"));
  EXPECT_THAT(
      detail(R"([{"id": "leak", "parameters": {"law": "viscous"}}])", "/effects/0/parameters/law"),
      HasSubstr("orifice, laminar or porous"));
  EXPECT_THAT(detail(R"([{"id": "valve_delay", "parameters": {"delay_s": 0.1}},
                         {"id": "valve_delay", "parameters": {"delay_s": 0.1}}])",
                     "/effects/1/id"),
              HasSubstr("already"));
  Json twice = Bench(R"([{"id": "valve_delay", "parameters": {"delay_s": 0.1}}])");
  twice["actuators"][0]["effects"] = twice["effects"];
  EXPECT_THAT(DetailAt(Refused(twice), "/actuators/0/effects/0/id"), HasSubstr("whole request"));
}

TEST(SimulationEffects, ARunThatCannotGoOnSaysWhereAndWhy) {
  Json request = Bench(R"([{"id": "nonlinear_compliance",
                            "parameters": {"curvature": -1, "s_amplitude": -1}}])",
                       8.0);
  request["actuators"][0]["expansion_ratio"] = 6;
  request["valve"] = Parse(R"([{"t_s": 0, "state": "inflate"}])");
  request["sample_hz"] = 100;
  const Json answer = Answer(request);
  EXPECT_EQ(answer["status"], "not_finite");
  EXPECT_THAT(answer["detail"].get<std::string>(), HasSubstr("at t = "));
  EXPECT_LT(answer["t_s"].size(), 801u);
  for (const Json& number : answer["groups"][0]["pressure_kpa_gauge"])
    EXPECT_TRUE(number.is_number());
}

// Both bounds of every parameter of every effect go out in the contract's names and come back.
TEST(SimulationEffects, RenderAndReadBackEveryEffect) {
  std::set<std::string> names;
  for (const model::EffectSpec* spec : model::Effects()) {
    for (bool high : {false, true}) {
      model::Effect effect{spec, {}};
      for (const auto& parameter : spec->parameters)
        effect.parameters.push_back(high ? parameter.high : parameter.low);
      const Json owner = {{"effects", RenderEffects(std::vector{effect})}};
      if (!spec->id.starts_with("learned_")) {
        for (const auto& [name, value] : owner["effects"][0]["parameters"].items())
          names.insert(name);
      }
      Errors errors;
      Reader reader(owner, "", errors);
      const auto read = ReadEffects(reader);
      ASSERT_TRUE(errors.empty()) << errors[0].pointer << " " << errors[0].detail;
      ASSERT_EQ(read.size(), 1u);
      EXPECT_EQ(read[0].spec, spec);
      for (std::size_t i = 0; i < effect.parameters.size(); ++i)
        EXPECT_DOUBLE_EQ(read[0].parameters[i], effect.parameters[i]) << spec->id;
    }
  }
  // As the contract spells them, with those of the three effects that it does not list.
  EXPECT_EQ(names, (std::set<std::string>{"law",
                                          "sonic_conductance_dm3_per_s_bar",
                                          "critical_ratio",
                                          "conductance_l_per_min_bar",
                                          "viscous_pa2_s_per_kg",
                                          "inertial_pa2_s2_per_kg2",
                                          "natural_frequency_rad_per_s",
                                          "damping_ratio",
                                          "fraction",
                                          "time_constant_s",
                                          "half_width_kpa",
                                          "delay_s",
                                          "duration_s",
                                          "volume_ml",
                                          "curvature",
                                          "s_amplitude",
                                          "offset_kpa",
                                          "gain",
                                          "pressure_kpa",
                                          "initial_flow_l_per_min_anr",
                                          "fill_factor",
                                          "capacity_ratio",
                                          "start_share",
                                          "length_m",
                                          "inner_diameter_mm"}));
}

TEST(SimulationEffects, TheExampleRuns) {
  std::ifstream file(test::SourceDir().string() + "/examples/simulation_effects.json");
  const Json answer = Answer(Json::parse(file));
  EXPECT_EQ(answer["status"], "done");
  EXPECT_TRUE(answer["groups"][1].contains("temperature_k"));
}

}  // namespace simulation_effects_test
}  // namespace plenum::api
