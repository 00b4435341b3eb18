#include "api/simulate/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "api/json/json.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace simulation_test {

using testing::HasSubstr;

Json Simulated(const Json& request) {
  const auto result = RunSimulation(request, SmallCatalogue());
  for (const Error& error : ErrorsOf(result))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::holds_alternative<Json>(result) ? std::get<Json>(result) : Json();
}
Errors Bad(const Json& request) { return ErrorsOf(RunSimulation(request, SmallCatalogue())); }

// The reference row: V0 50 mL, ε 2, 100 kPa gauge, C 0.05, b 0.3 at 200 kPa gauge; C·P0/V0 = 1/s.
Json ReferenceRow() {
  return Parse(R"({ "schema": "simulation/1",
    "actuators": [ { "name": "a", "rest_volume_ml": 50, "expansion_ratio": 2,
                     "operating_pressure_kpa_gauge": 100,
                     "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 } } ],
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200 },
    "valve": [ { "t_s": 0, "state": "inflate" }, { "t_s": 1.066905, "state": "hold" },
               { "t_s": 3, "state": "deflate" } ],
    "rise": { "to_fraction": 1.0 }, "fall": { "to_fraction": 0.05 },
    "t_end_s": 6, "sample_hz": 100 })");
}

TEST(Simulation, MeetsThePublishedClosedForm) {
  const Json answer = Simulated(ReferenceRow());
  EXPECT_EQ(answer["schema"], "response/1");
  EXPECT_EQ(answer["status"], "done");
  const Json& performance = answer["performance"]["groups"][0];
  EXPECT_EQ(performance["name"], "a");
  EXPECT_NEAR(performance["rise_time_s"].get<double>(), 1.066905, 1e-6);
  EXPECT_NEAR(performance["fall_time_s"].get<double>(), 2.459439, 1e-6);
  EXPECT_NEAR(performance["frequency_hz_max"].get<double>(), 1 / (1.066905 + 2.459439), 1e-6);

  const Json& t_s = answer["t_s"];
  const Json& group = answer["groups"][0];
  ASSERT_EQ(t_s.size(), 601u);
  ASSERT_EQ(group["pressure_kpa_gauge"].size(), t_s.size());
  ASSERT_EQ(group["volume_ml"].size(), t_s.size());
  ASSERT_EQ(answer["source_pressure_kpa_gauge"].size(), t_s.size());
  EXPECT_EQ(group["pressure_kpa_gauge"][0], 0.0);
  EXPECT_EQ(group["volume_ml"][0], 50.0);
  EXPECT_EQ(answer["source_pressure_kpa_gauge"][600], 200.0);
  EXPECT_NEAR(t_s[200].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(group["pressure_kpa_gauge"][200].get<double>(), 100.0, 1e-3);  // held
  EXPECT_NEAR(group["volume_ml"][200].get<double>(), 100.0, 1e-3);
  EXPECT_NEAR(group["air_in_l_anr"].get<double>(), 0.15, 1e-6);  // 50 mL·(2·2 − 1)
}

TEST(Simulation, RunsTheContractsExample) {
  const Json answer = Simulated(Simulation());
  EXPECT_EQ(answer["t_s"].size(), 1601u);
  EXPECT_EQ(answer["groups"][0]["name"], "a");
}

TEST(Simulation, TubesAddTheirBoreToTheVolumeThatIsFilled) {
  Json request = ReferenceRow();
  request["actuators"][0]["line"]["tube"] = Parse(R"({"inner_diameter_mm": 4, "length_m": 2})");
  request["valve"] = Parse(R"([{"t_s": 0, "state": "inflate"}])");
  request["t_end_s"] = 60;
  request["sample_hz"] = 1;
  const Json group = Simulated(request)["groups"][0];
  // Ends at the source pressure of 3 bar absolute: V = 50·(1 + 2) mL, tube π/4·(4 mm)²·2 m =
  // 25.132741 mL; air in = [3·(150 + 25.13) − 1·(50 + 25.13)] mL.
  EXPECT_NEAR(group["air_in_l_anr"].get<double>(), 0.450265482, 2e-5);
  EXPECT_NEAR(group["volume_ml"].back().get<double>(), 150.0, 0.01);
}

TEST(Simulation, DeflatingCrossesTheElementsInTheOppositeOrder) {
  // b = 0: order does not matter and C = 1/√(1/0.3² + 1/0.5²); with b it does.
  const auto fall = [](const char* elements) {
    Json request = ReferenceRow();
    request["actuators"][0]["line"] = Json{{"elements", Parse(elements)}};
    return Simulated(request)["performance"]["groups"][0];
  };
  const Json forward = fall(R"([{"sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35},
                                {"sonic_conductance_dm3_per_s_bar": 0.5, "critical_ratio": 0.2}])");
  const Json backward = fall(R"([{"sonic_conductance_dm3_per_s_bar": 0.5, "critical_ratio": 0.2},
                                 {"sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35}])");
  // Published: C = 0.283 valve first, 0.264 tube first. Filling the first line crosses 0.3 first.
  EXPECT_LT(forward["rise_time_s"].get<double>(), backward["rise_time_s"].get<double>());
  EXPECT_GT(forward["fall_time_s"].get<double>(), backward["fall_time_s"].get<double>());
}

TEST(Simulation, AnExhaustPairServesDeflationOnly) {
  Json request = ReferenceRow();
  request["actuators"][0]["line"]["exhaust"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.1, "critical_ratio": 0.3})");
  const Json performance = Simulated(request)["performance"]["groups"][0];
  EXPECT_NEAR(performance["rise_time_s"].get<double>(), 1.066905, 1e-6);
  EXPECT_NEAR(performance["fall_time_s"].get<double>(), 2.459439 / 2, 1e-6);
}

TEST(Simulation, Co2FlowsAtItsShareOfTheAirFlow) {
  const Json performance =
      Simulated(With(ReferenceRow(), "/gas", "co2"))["performance"]["groups"][0];
  EXPECT_NEAR(performance["rise_time_s"].get<double>(), 1.066905 / 0.79, 2e-6);
}

TEST(Simulation, TakesValvesAndFittingsFromTheCatalogue) {
  Json by_id = ReferenceRow(), by_hand = ReferenceRow();
  by_id["actuators"][0]["line"] =
      Parse(R"({"elements": [{"part": "valve-1"}, {"part": "fitting-1"}]})");
  by_hand["actuators"][0]["line"] = Parse(R"({"elements": [
    {"sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35,
     "exhaust": {"sonic_conductance_dm3_per_s_bar": 0.25, "critical_ratio": 0.3}},
    {"sonic_conductance_dm3_per_s_bar": 0.9, "critical_ratio": 0.5}]})");
  EXPECT_EQ(Simulated(by_id), Simulated(by_hand));
}

TEST(Simulation, NullWhereTheTargetIsNeverReached) {
  Json request = ReferenceRow();
  request["source"]["source_pressure_kpa_gauge"] = 50;
  const Json performance = Simulated(request)["performance"]["groups"][0];
  EXPECT_TRUE(performance["rise_time_s"].is_null());
  EXPECT_TRUE(performance["frequency_hz_max"].is_null());
  EXPECT_NEAR(performance["fall_time_s"].get<double>(), 2.459439, 1e-6);
}

TEST(Simulation, ACycleRunsToItsEnd) {
  Json request = Without(Without(ReferenceRow(), "/valve"), "/t_end_s");
  request["cycle"] = Parse(R"({"frequency_hz": 0.5, "inflate_fraction": 0.4, "cycles": 3})");
  const Json answer = Simulated(request);
  EXPECT_NEAR(answer["t_s"].back().get<double>(), 6.0, 1e-9);
  const Json& pressure = answer["groups"][0]["pressure_kpa_gauge"];
  EXPECT_GT(pressure[79].get<double>(), pressure[70].get<double>());  // inflates to 0.8 s
  EXPECT_LT(pressure[90].get<double>(), pressure[79].get<double>());
}

TEST(Simulation, AClosedReservoirSharesItsGas) {
  Json request = ReferenceRow();
  // 500 mL at 4 bar absolute with a pump that delivers nothing.
  request["source"] = Parse(R"({"kind": "compressor", "reservoir_volume_ml": 500,
    "initial_pressure_kpa_gauge": 300,
    "curve": [{"pressure_kpa_gauge": 0, "free_air_l_per_min": 0}]})");
  request["valve"] = Parse(R"([{"t_s": 0, "state": "inflate"}])");
  request["actuators"][0]["expansion_ratio"] = 1;
  request["t_end_s"] = 60;
  const Json answer = Simulated(request);
  // (500·4 + 50·1)/550 bar absolute.
  EXPECT_NEAR(answer["source_pressure_kpa_gauge"].back().get<double>(), 272.7273, 0.3);
}

TEST(Simulation, GroupsMayHaveTheirOwnValve) {
  Json request = ReferenceRow();
  request["actuators"].push_back(request["actuators"][0]);
  request["actuators"][1]["name"] = "b";
  request["actuators"][1]["valve"] = Parse(R"([{"t_s": 5, "state": "inflate"}])");
  const Json answer = Simulated(request);
  EXPECT_NEAR(answer["groups"][0]["pressure_kpa_gauge"][200].get<double>(), 100.0, 1e-3);
  EXPECT_EQ(answer["groups"][1]["pressure_kpa_gauge"][200], 0.0);
}

TEST(Simulation, NamesEveryFieldThatIsWrong) {
  const struct {
    const char* pointer;
    const char* value;
    const char* detail;
  } cases[] = {
      {"/schema", "\"simulation/2\"", "simulation/1"},
      {"/actuators/0/line", "null", "object"},
      {"/actuators/0/line/elements", "[]", "1 to 8"},
      {"/actuators/0/line/elements/0/sonic_conductance_dm3_per_s_bar", "0", "≥ 1e-6"},
      {"/actuators/0/line/elements/0/critical_ratio", "1", "≤ 0.95"},
      {"/actuators/0/line/elements/1/tube/inner_diameter_mm", "0.1", "≥ 0.3 and ≤ 30"},
      {"/actuators/0/line/elements/2/part", "\"tubing-2\"", "nearest id: tubing-1"},
      {"/actuators/0/line/elements/2/part", "\"battery-1\"", "tubing, fitting or valve"},
      {"/actuators/0/line/elements/2/length_m", "null", "is required"},
      {"/source/kind", "\"wind\"", "regulated, compressor, direct_pump, tank or none"},
      {"/source/source_pressure_kpa_gauge", "-5", "≥ 0"},
      {"/valve/1/t_s", "-1", "≥ 0"},
      {"/valve/2/t_s", "1", "1 follows 1.07"},
      {"/valve/0/state", "\"open\"", "hold, inflate or deflate"},
      {"/cycle", "{}", "not both"},
      {"/effects", R"([{"id": "leek", "parameters": {}}])", "effect"},
      {"/initial/pressure_kpa_gauge", "-100", "> -100"},
      {"/t_end_s", "0", "> 0"},
      {"/sample_hz", "1e5", "≤ 25000 with t_end_s 8"},
      {"/gas", "\"xenon\"", "argon or co2"},
      {"/hz", "1", "unknown field"},
  };
  for (const auto& [pointer, value, detail] : cases) {
    const Errors errors = Bad(With(Simulation(), pointer, Parse(value)));
    ASSERT_EQ(errors.size(), 1u) << pointer;
    const std::string expected =
        std::string(pointer) == "/effects" ? "/effects/0/id" : std::string(pointer);
    EXPECT_EQ(errors[0].pointer, expected);
    EXPECT_THAT(errors[0].detail, HasSubstr(detail));
  }
  EXPECT_THAT(DetailAt(Bad(Without(Simulation(), "/valve")), "/actuators/0/valve"),
              HasSubstr("is required"));
  EXPECT_THAT(DetailAt(Bad(Without(Simulation(), "/t_end_s")), "/t_end_s"),
              HasSubstr("is required"));
}

}  // namespace simulation_test
}  // namespace plenum::api
