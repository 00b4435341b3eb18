#include "bench/simulator.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <variant>
#include <vector>

#include "bench/batch/simulate_batch.h"
#include "bench/method.h"
#include "model/simulate/simulate.h"

namespace plenum::bench {
namespace {

// One actuator at constant pressure. Without an exhaust line only the rise is simulated.
model::Rig EmptyRig() {
  model::Rig rig;
  rig.source = model::RegulatedSource{};
  rig.groups.resize(1);
  rig.groups[0].fill.resize(1);
  return rig;
}

void SetRig(const RiseRig& rise, model::Rig& rig) {
  rig.ambient.pressure_pa = rise.ambient_pa;
  std::get<model::RegulatedSource>(rig.source).pressure_pa = rise.source_pa;
  model::GroupRig& group = rig.groups[0];
  group.fill[0].sonic_conductance_m3_per_s_pa = rise.conductance_m3_per_s_pa;
  group.fill[0].critical_ratio = rise.critical_ratio;
  group.initial_pressure_pa = rise.ambient_pa;
  group.chamber.rest_volume_m3 = rise.rest_volume_m3;
  group.chamber.expansion_ratio = rise.expansion_ratio;
  group.chamber.operating_pressure_pa = rise.operating_pa;
  group.chamber.ambient_pressure_pa = rise.ambient_pa;
}

model::SimulateOptions OptionsAt(double tolerance) {
  model::SimulateOptions options;
  options.relative_tolerance = tolerance;
  return options;
}

class RiseSimulation {
 public:
  double operator()(const RiseRig& rise, double tolerance) {
    SetRig(rise, rig_);
    return model::FullStrokes(rig_, OptionsAt(tolerance))[0].rise_time_s;
  }

 private:
  model::Rig rig_ = EmptyRig();
};

// As many rigs at a time as a cache holds.
class RiseSimulations {
 public:
  void operator()(std::span<const RiseRig> rises, double tolerance, std::span<double> rise_s) {
    const model::SimulateOptions options = OptionsAt(tolerance);
    for (std::size_t first = 0; first < rises.size(); first += rigs_.size()) {
      const std::size_t size = std::min(rigs_.size(), rises.size() - first);
      for (std::size_t i = 0; i < size; ++i) SetRig(rises[first + i], rigs_[i]);
      FullStrokesOfMany(std::span(rigs_).first(size), options, std::span(strokes_).first(size));
      for (std::size_t i = 0; i < size; ++i) rise_s[first + i] = strokes_[i].rise_time_s;
    }
  }

 private:
  static constexpr std::size_t kRigs = 1024;
  std::vector<model::Rig> rigs_ = std::vector(kRigs, EmptyRig());
  std::vector<model::FullStroke> strokes_ = std::vector<model::FullStroke>(kRigs);
};

constexpr double kCycleHz = 1.0;

// 50 mL actuators to 2 bar absolute, ε = 2, each with a line of its own and its own phase.
model::Rig CycleRig(model::Source source, int groups, int cycles) {
  model::Rig rig;
  rig.source = std::move(source);
  for (int i = 0; i < groups; ++i) {
    model::GroupRig group;
    group.chamber.rest_volume_m3 = 50e-6;
    group.chamber.expansion_ratio = 2.0;
    group.chamber.operating_pressure_pa = 2e5;
    group.fill = {{(0.20 + 0.02 * i) * 1e-8, 0.3}};
    group.exhaust = {{(0.40 + 0.02 * i) * 1e-8, 0.3}};
    group.schedule = model::CycleSchedule(kCycleHz, 0.5, cycles, 0.5 * i / groups);
    rig.groups.push_back(group);
  }
  return rig;
}

double SecondsToSimulate(const model::Rig& rig, int cycles) {
  model::SimulateOptions options;
  options.end_s = cycles / kCycleHz;
  const auto start = std::chrono::steady_clock::now();
  const model::Response response = model::Simulate(rig, options);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  if (response.status != model::SimulateStatus::kDone) throw std::runtime_error(response.detail);
  return elapsed.count();
}

double ConstantPressure(int groups, int cycles) {
  return SecondsToSimulate(CycleRig(model::RegulatedSource{.pressure_pa = 3e5}, groups, cycles),
                           cycles);
}

double WithEffects(int groups, int cycles, const std::vector<model::Effect>& effects) {
  model::Rig rig = CycleRig(model::RegulatedSource{.pressure_pa = 3e5}, groups, cycles);
  for (model::GroupRig& group : rig.groups) group.effects = effects;
  return SecondsToSimulate(rig, cycles);
}

double WithHeat(int groups, int cycles) {
  return WithEffects(groups, cycles, {{model::FindEffect("heat_transfer"), {0.5}}});
}

double WithSixEffects(int groups, int cycles) {
  return WithEffects(groups, cycles,
                     {{model::FindEffect("heat_transfer"), {0.5}},
                      {model::FindEffect("creep"), {0.15, 3.0}},
                      {model::FindEffect("hysteresis"), {4e3}},
                      {model::FindEffect("leak", "orifice"), {5e-12, 0.3}},
                      {model::FindEffect("valve_ramp"), {0.02}},
                      {model::FindEffect("sensor_lag"), {0.03}}});
}

double ReservoirAndCompressor(int groups, int cycles) {
  model::ReservoirSource source;
  source.volume_m3 = 2e-3;
  source.initial_pressure_pa = 3e5;
  source.stop_pressure_pa = 3.2e5;
  source.compressor_count = groups;
  source.compressor.free_air_m3_per_s = model::MonotoneCurve({1e5, 3e5, 5e5}, {3e-4, 2e-4, 1e-4});
  source.compressor.current_a = model::MonotoneCurve({1e5, 5e5}, {1.0, 3.0});
  source.compressor.voltage_v = 12.0;
  source.compressor.pressure_max_pa = 5e5;
  return SecondsToSimulate(CycleRig(source, groups, cycles), cycles);
}

}  // namespace

std::vector<Method> Simulators() {
  return {OneByOne("plenum simulator", true, RiseSimulation()),
          {"plenum simulator, batch", true, RiseSimulations()}};
}

std::vector<CycleVariant> CycleVariants() {
  return {{"constant pressure", ConstantPressure},
          {"reservoir and compressor", ReservoirAndCompressor},
          {"constant, heat transfer", WithHeat},
          {"constant, six effects", WithSixEffects}};
}

}  // namespace plenum::bench
