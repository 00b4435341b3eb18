// Small measured data sets from the independent simulator, for tests of the fit and the search.
#ifndef PLENUM_TESTS_CALIBRATION_BENCH_H_
#define PLENUM_TESTS_CALIBRATION_BENCH_H_

#include <functional>
#include <string>
#include <vector>

#include "calibration/values/dataset.h"
#include "tests/calibration/noise/processes.h"
#include "tests/support/effects/effect_form.h"

namespace plenum::test {

inline constexpr double kBenchNoisePa = 150.0;
inline constexpr double kBenchConductance = 0.05e-8;  // m³/(s·Pa)

// 50 mL, ε 2, 100 kPa, as declared; `change` makes the true rig another.
using Change = std::function<void(EffectRig&)>;

inline calibration::Run DeclaredRun(const std::string& id, double source_pa, bool blocked) {
  calibration::Run run;
  run.id = id;
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  const model::FlowElement pair{kBenchConductance, 0.3};
  run.line = {{pair, pair, {}}};
  run.supply = calibration::Supply::kRegulated;
  run.source_pressure_pa = source_pa;
  run.blocked = blocked;
  run.initial_pressure_pa = 1e5;
  const double rise_s = blocked ? 0.35 : 0.9;
  run.valve = {{0.0, model::ValveState::kHold},
               {0.2, model::ValveState::kInflate},
               {0.2 + rise_s, model::ValveState::kHold},
               {2.5, model::ValveState::kDeflate},
               {4.5, model::ValveState::kHold}};
  for (int i = 0; i <= 250; ++i) run.t_s.push_back(0.02 * i);
  return run;
}

inline void Measure(const Change& change, std::uint64_t seed, double noise_pa,
                    calibration::Run& run) {
  EffectRig rig;
  rig.blocked = run.blocked;
  rig.source_pa = run.source_pressure_pa;
  rig.fill = rig.exhaust = {{kBenchConductance, 0.3}};
  for (const model::ValveCommand& command : run.valve)
    rig.schedule.push_back({command.time_s, command.state == model::ValveState::kInflate   ? 1
                                            : command.state == model::ValveState::kDeflate ? -1
                                                                                           : 0});
  if (change) change(rig);
  run.pressure_pa = SimulateEffects(rig, run.t_s, 5e-4).measured_pa;
  const std::vector<double> noise = WhiteNoise(seed, run.t_s.size(), noise_pa);
  for (std::size_t i = 0; i < noise.size(); ++i) run.pressure_pa[i] += noise[i];
}

// Three runs to fit — two source pressures and a blocked one — and one to hold out. Volume and
// conductance are declared to 2 and 3 %.
inline calibration::Dataset MeasuredBench(const Change& change, std::uint64_t seed,
                                          double noise_pa = kBenchNoisePa) {
  calibration::Dataset dataset;
  dataset.name = "bench";
  dataset.runs = {DeclaredRun("low", 2.6e5, false), DeclaredRun("high", 3.4e5, false),
                  DeclaredRun("blocked", 3e5, true), DeclaredRun("unseen", 3e5, false)};
  for (std::size_t i = 0; i < dataset.runs.size(); ++i)
    Measure(change, 10 * seed + i, noise_pa, dataset.runs[i]);
  using calibration::Declared;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kRestVolume)] = 0.02;
  dataset.relative_uncertainty[static_cast<std::size_t>(Declared::kSonicConductance)] = 0.03;
  dataset.holdout = {"unseen"};
  return dataset;
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_CALIBRATION_BENCH_H_
