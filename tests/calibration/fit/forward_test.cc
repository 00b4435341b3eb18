#include "calibration/fit/forward.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "model/flow/tube.h"
#include "tests/calibration/bench.h"

namespace plenum::calibration {
namespace forward_test {

using test::EffectRig;
using test::MeasuredBench;

PredictOptions Tight() { return {.relative_tolerance = 1e-10}; }

// A sample at the instant of a command sees one side of it.
bool AtCommand(const Run& run, std::size_t k) {
  return std::any_of(run.valve.begin(), run.valve.end(), [&](const model::ValveCommand& command) {
    return std::abs(run.t_s[k] - command.time_s) < 1e-3;
  });
}

ModelState With(const ForwardModel& forward, const char* id, std::vector<double> parameters) {
  ModelState state = forward.Declared();
  state.effects = {{model::FindEffect(id), std::move(parameters)}};
  return state;
}

TEST(Forward, DeclaredModelReadsWhatAnIndependentSimulatorReads) {
  const Dataset dataset = MeasuredBench({}, 1, 0.0);
  const ForwardModel forward(dataset);
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction p = forward.Predict(i, forward.Declared(), {}, Tight());
    ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
    for (std::size_t k = 0; k < p.reading.pressure_pa.size(); ++k)
      ASSERT_NEAR(p.reading.pressure_pa[k], dataset.runs[i].pressure_pa[k], 2.0) << i << " " << k;
  }
}

TEST(Forward, EffectsAndFactorsReadAsOnABenchThatHasThem) {
  const Dataset dataset = MeasuredBench(
      [](EffectRig& rig) {
        rig.rest_volume_m3 *= 1.03;
        rig.fill[0].conductance *= 0.9, rig.exhaust[0].conductance *= 0.9;
        rig.creep = {0.1, 0.6};
        rig.sensor_offset_pa = 700.0;
      },
      1, 0.0);
  const ForwardModel forward(dataset);
  ModelState state = With(forward, "creep", {0.1, 0.6});
  state.effects.push_back({model::FindEffect("sensor_offset"), {700.0}});
  state.factor[static_cast<std::size_t>(Declared::kRestVolume)] = 1.03;
  state.factor[static_cast<std::size_t>(Declared::kSonicConductance)] = 0.9;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Prediction p = forward.Predict(i, state, {}, Tight());
    ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
    for (std::size_t k = 0; k < p.reading.pressure_pa.size(); ++k)
      ASSERT_NEAR(p.reading.pressure_pa[k], dataset.runs[i].pressure_pa[k], 3.0) << i << " " << k;
  }
}

// Every kind of parameter against central differences.
TEST(Forward, DerivativesAgreeWithDifferences) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  for (auto& run : dataset.runs) run.line.push_back({{}, {}, LinePiece::Tube{2e-3, 0.8}});
  const ForwardModel forward(dataset);
  const ModelState state = With(forward, "supply_droop", {4e-4, 2e-10, 0.3});
  std::vector<Parameter> parameters;
  for (const Declared number :
       {Declared::kRestVolume, Declared::kExpansionRatio, Declared::kOperatingPressure,
        Declared::kSourcePressure, Declared::kSonicConductance, Declared::kCriticalRatio,
        Declared::kTubeInnerDiameter})
    parameters.push_back({.kind = Parameter::Kind::kDeclared, .declared = number});
  for (const std::size_t number : {0, 1, 2})
    parameters.push_back({.kind = Parameter::Kind::kEffect, .number = number});
  parameters.push_back({.kind = Parameter::Kind::kInitialPressure, .run = 1});
  parameters.push_back({.kind = Parameter::Kind::kClock, .run = 1});
  const Prediction p = forward.Predict(1, state, parameters, Tight());
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  for (std::size_t j = 0; j < parameters.size(); ++j) {
    const bool clock = parameters[j].kind == Parameter::Kind::kClock;
    const double step = clock ? 1e-5 : 1e-4 * NumberOf(state, parameters[j]);
    ModelState above = state, below = state;
    NumberOf(above, parameters[j]) += step;
    NumberOf(below, parameters[j]) -= step;
    const auto up = forward.Predict(1, above, {}, Tight()).reading.pressure_pa;
    const auto down = forward.Predict(1, below, {}, Tight()).reading.pressure_pa;
    double largest = 0.0, off = 0.0;
    for (std::size_t k = 0; k < up.size(); ++k) {
      if (AtCommand(dataset.runs[1], k)) continue;
      const double slope = (up[k] - down[k]) / (2.0 * step);
      largest = std::max(largest, std::abs(slope));
      off = std::max(off, std::abs(slope - p.derivatives[j].pressure_pa[k]));
    }
    EXPECT_GT(largest, 0.0) << j;
    EXPECT_LT(off, 2e-3 * largest) << "parameter " << j;
  }
}

// A recorder that starts late shifts what it shows of a rig with a running pump, and no more.
TEST(Forward, AClockMovesCommandsAndPump) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  calibration::Run& run = dataset.runs[0];
  run.supply = Supply::kCompressor;
  run.source_pressure_pa = 2.2e5;
  run.reservoir_volume_m3 = 2e-4;
  run.compressor.free_air_m3_per_s = model::MonotoneCurve({1e5, 3e5, 6e5}, {1.5e-4, 1e-4, 0.0});
  run.compressor.pressure_max_pa = 6e5;
  const double late_s = 4e-3;
  Dataset late = dataset;
  for (double& t_s : late.runs[0].t_s) t_s += late_s;
  const ForwardModel forward(dataset), shifted(late);
  const auto on_time = forward.Predict(0, forward.Declared(), {}, Tight()).reading;
  ModelState state = shifted.Declared();
  state.clock_s[0] = late_s;
  const Parameter clock{.kind = Parameter::Kind::kClock, .run = 0};
  const Prediction seen = shifted.Predict(0, state, {&clock, 1}, Tight());
  ASSERT_EQ(seen.status, model::SimulateStatus::kDone) << seen.detail;
  double most_pa = 0.0;
  for (std::size_t k = 0; k < on_time.pressure_pa.size(); ++k)
    most_pa = std::max(most_pa, std::abs(seen.reading.pressure_pa[k] - on_time.pressure_pa[k]));
  EXPECT_LT(most_pa, 2.0);  // of 150 that the pump makes in that time
  ModelState above = state, below = state;
  above.clock_s[0] += 1e-5, below.clock_s[0] -= 1e-5;
  const auto up = shifted.Predict(0, above, {}, Tight()).reading.pressure_pa;
  const auto down = shifted.Predict(0, below, {}, Tight()).reading.pressure_pa;
  const std::size_t held = 100;  // long after the stroke
  EXPECT_NEAR(seen.derivatives[0].pressure_pa[held], (up[held] - down[held]) / 2e-5,
              2e-3 * std::abs(seen.derivatives[0].pressure_pa[held]));
}

TEST(Forward, AMeasuredSourceOfOneLevelIsARegulatedOne) {
  Dataset dataset = MeasuredBench({}, 1, 0.0);
  for (auto& run : dataset.runs) {
    run.supply = Supply::kMeasured;
    run.channels.source_pressure_pa.assign(run.t_s.size(), run.source_pressure_pa);
  }
  const ForwardModel forward(dataset);
  const Prediction p = forward.Predict(0, forward.Declared(), {}, Tight());
  ASSERT_EQ(p.status, model::SimulateStatus::kDone) << p.detail;
  for (std::size_t k = 0; k < p.reading.pressure_pa.size(); ++k)
    ASSERT_NEAR(p.reading.pressure_pa[k], dataset.runs[0].pressure_pa[k], 2.0) << k;
}

TEST(Forward, TemperatureIsTheAmbientsWithoutHeatTransfer) {
  const Dataset dataset = MeasuredBench({}, 1, 0.0);
  const ForwardModel forward(dataset);
  const Prediction base = forward.Predict(0, forward.Declared(), {}, Tight());
  EXPECT_EQ(base.reading.channels.temperature_k.at(20), dataset.runs[0].ambient.temperature_k);
  const Prediction warm = forward.Predict(0, With(forward, "heat_transfer", {0.5}), {}, Tight());
  EXPECT_GT(warm.reading.channels.temperature_k.at(20),
            dataset.runs[0].ambient.temperature_k + 1.0);
}

}  // namespace forward_test
}  // namespace plenum::calibration
