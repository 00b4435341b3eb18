// Sources and valves as designs have them: a shared regulator with a flow limit, several pumps that
// stop at a pressure, valves that close at the operating pressure.
#include <gtest/gtest.h>

#include <algorithm>

#include "api/json/json.h"
#include "api/simulate/simulation.h"
#include "tests/api/support.h"

namespace plenum::api {
namespace simulation_source_test {

Json Simulated(const Json& request) {
  const auto result = RunSimulation(request, SmallCatalogue());
  for (const Error& error : ErrorsOf(result))
    ADD_FAILURE() << error.pointer << ": " << error.detail;
  return std::holds_alternative<Json>(result) ? std::get<Json>(result) : Json();
}

Json Rig() {
  return Parse(R"({ "schema": "simulation/1",
    "actuators": [ { "name": "a", "rest_volume_ml": 50, "expansion_ratio": 2,
                     "operating_pressure_kpa_gauge": 100,
                     "line": { "sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3 } } ],
    "source": { "kind": "regulated", "source_pressure_kpa_gauge": 200 },
    "valve": [ { "t_s": 0, "state": "inflate" } ], "t_end_s": 4, "sample_hz": 50 })");
}

double At(const Json& answer, double t_s) {
  return answer["groups"][0]["pressure_kpa_gauge"][static_cast<std::size_t>(t_s * 50)];
}

TEST(SimulationSource, ARegulatorIsInSeriesWithALoneLine) {
  // b = 0: 1/C² add up.
  Json request = Rig();
  request["actuators"][0]["line"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.03, "critical_ratio": 0})");
  request["source"]["regulator"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.04, "critical_ratio": 0})");
  Json equivalent = Rig();
  equivalent["actuators"][0]["line"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.024, "critical_ratio": 0})");
  const Json a = Simulated(request), b = Simulated(equivalent);
  for (const double t_s : {0.2, 0.8, 2.0}) EXPECT_NEAR(At(a, t_s), At(b, t_s), 1e-3) << t_s;
}

TEST(SimulationSource, AFlowLimitFillsAtAConstantRate) {
  // 1.2 L/min ANR into 50 mL of a rigid actuator: 40 kPa/s.
  Json request = Rig();
  request["actuators"][0]["expansion_ratio"] = 1;
  request["source"]["flow_l_per_min_anr_max"] = 1.2;
  const Json answer = Simulated(request);
  EXPECT_NEAR(At(answer, 1.0), 40.0, 0.05);
  EXPECT_NEAR(At(answer, 2.0), 80.0, 0.05);
}

TEST(SimulationSource, AValveMayCloseAtTheOperatingPressure) {
  Json request = Rig();
  EXPECT_GT(At(Simulated(request), 4.0), 150.0);
  request["actuators"][0]["close_at_operating_pressure"] = true;
  EXPECT_NEAR(At(Simulated(request), 4.0), 100.0, 1e-3);
}

TEST(SimulationSource, PumpsStopAtTheirPressure) {
  // Two pumps of 3 L/min into a litre: 10 kPa/s up to 25 kPa.
  Json request = Rig();
  request["valve"] = Parse(R"([{"t_s": 0, "state": "hold"}])");
  request["source"] = Parse(R"({ "kind": "compressor", "count": 2, "reservoir_volume_ml": 1000,
    "curve": [ { "pressure_kpa_gauge": 0, "free_air_l_per_min": 3 },
               { "pressure_kpa_gauge": 200, "free_air_l_per_min": 3 } ],
    "stop_pressure_kpa_gauge": 25 })");
  const Json source = Simulated(request)["source_pressure_kpa_gauge"];
  EXPECT_NEAR(source[100].get<double>(), 20.0, 0.05);
  EXPECT_NEAR(source[200].get<double>(), 25.0, 1e-3);
}

// 20 strokes of 15 kPa each out of a litre at 800 kPa gauge (physics of a blowdown, worked out by
// hand: (200·100 − 100·50) kPa·mL).
TEST(SimulationSource, ATankFallsByWhatEachStrokeTakes) {
  Json request = Rig();
  request["actuators"][0]["line"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.2, "critical_ratio": 0.3})");
  request["actuators"][0]["close_at_operating_pressure"] = true;
  request["source"] = Parse(
      R"({ "kind": "tank", "reservoir_volume_ml": 1000, "initial_pressure_kpa_gauge": 800 })");
  request.erase("valve");
  request["cycle"] = Parse(R"({"frequency_hz": 0.5, "inflate_fraction": 0.5, "cycles": 20})");
  request["t_end_s"] = 40;
  const Json source = Simulated(request)["source_pressure_kpa_gauge"];
  for (const int strokes : {1, 10, 20})
    EXPECT_NEAR(source[static_cast<std::size_t>(strokes * 100 - 1)].get<double>(),
                800.0 - 15.0 * strokes, 1e-3)
        << strokes;
  request["source"].erase("initial_pressure_kpa_gauge");
  const auto errors = ErrorsOf(RunSimulation(request, SmallCatalogue()));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/source/initial_pressure_kpa_gauge");
}

// physics, 2.15: 6 L/min straight to nothing at 100 kPa gauge, 50 mL that double up to 60 kPa.
TEST(SimulationSource, APumpWithoutAReservoirFillsTheActuatorItself) {
  Json request = Rig();
  request["actuators"][0]["operating_pressure_kpa_gauge"] = 60;
  request["actuators"][0]["line"] =
      Parse(R"({"sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3})");
  request["actuators"][0]["close_at_operating_pressure"] = true;
  request["source"] = Parse(R"({ "kind": "direct_pump",
    "curve": [ { "pressure_kpa_gauge": 0, "free_air_l_per_min": 6 },
               { "pressure_kpa_gauge": 100, "free_air_l_per_min": 0 } ] })");
  const Json answer = Simulated(request);
  EXPECT_NEAR(answer["performance"]["groups"][0]["rise_time_s"].get<double>(), 2.296567, 2e-5);
  EXPECT_NEAR(At(answer, 4.0), 60.0, 1e-3);
  // Off again once the valve is closed.
  const Json& source = answer["source_pressure_kpa_gauge"];
  EXPECT_GT(source[50].get<double>(), At(answer, 1.0));
  EXPECT_NEAR(source[200].get<double>(), 0.0, 1e-9);
  request["effects"] = Parse(R"([{"id": "supply_droop", "parameters": {"volume_ml": 100,
    "sonic_conductance_dm3_per_s_bar": 0.1, "critical_ratio": 0.3}}])");
  const auto errors = ErrorsOf(RunSimulation(request, SmallCatalogue()));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].pointer, "/source/kind");
}

}  // namespace simulation_source_test
}  // namespace plenum::api
