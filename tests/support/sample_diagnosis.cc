#include "tests/support/sample_diagnosis.h"

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "calibration/judge/residual.h"
#include "calibration/noise/phases.h"
#include "model/simulate/simulate.h"

namespace plenum::test {
namespace {

using calibration::Diagnosis;
using calibration::Run;
using model::ValveState;

constexpr double kNoisePa = 210.0;
constexpr double kEndS = 8.0;

Run MakeRun(const std::string& id, double source_pa, int samples) {
  Run run;
  run.id = id;
  run.chamber = {.rest_volume_m3 = 50e-6,
                 .expansion_ratio = 2.0,
                 .operating_pressure_pa = 2e5,
                 .volume_curve = {}};
  const model::FlowElement pair{0.05e-8, 0.3};
  run.line.push_back({pair, pair, {}});
  run.supply = calibration::Supply::kRegulated;
  run.source_pressure_pa = source_pa;
  run.initial_pressure_pa = 1e5;
  run.valve = {{0.0, ValveState::kHold},
               {0.3, ValveState::kInflate},
               {1.3, ValveState::kHold},
               {6.0, ValveState::kDeflate}};
  for (int i = 0; i < samples; ++i) run.t_s.push_back(kEndS * i / (samples - 1));
  return run;
}

std::vector<double> Pressures(const Run& run, double conductance_factor,
                              std::vector<model::Effect> effects) {
  model::GroupRig group;
  group.chamber = run.chamber;
  group.fill = {run.line.front().fill};
  group.fill.front().sonic_conductance_m3_per_s_pa *= conductance_factor;
  group.exhaust = group.fill;
  group.schedule = run.valve;
  group.initial_pressure_pa = *run.initial_pressure_pa;
  group.effects = std::move(effects);
  model::Rig rig;
  rig.source = model::RegulatedSource{run.source_pressure_pa};
  rig.groups = {group};
  model::SimulateOptions options;
  options.end_s = kEndS;
  options.sample_hz = static_cast<double>(run.t_s.size() - 1) / kEndS;
  return model::Simulate(rig, options).groups.front().pressure_pa;
}

void AddError(const Run& run, const std::vector<double>& model_pa, bool held_out,
              calibration::ErrorReport& error) {
  double squares = 0.0;
  for (std::size_t i = 0; i < model_pa.size(); ++i) {
    const double off = run.pressure_pa[i] - model_pa[i];
    squares += off * off;
    if (!held_out) error.peak_pa = std::max(error.peak_pa, std::abs(off));
  }
  const double rms_pa = std::sqrt(squares / static_cast<double>(model_pa.size()));
  error.run_rms_pa.emplace_back(run.id, rms_pa);
  if (held_out)
    error.holdout_rms_pa = rms_pa;
  else
    error.rms_pa = std::hypot(error.rms_pa, rms_pa / std::sqrt(2.0));
  error.rms_share = error.rms_pa / 1e5;
}

}  // namespace

SampleDiagnosis MakeSampleDiagnosis(int samples) {
  SampleDiagnosis sample;
  sample.dataset.name = "pneunet bench";
  sample.dataset.relative_uncertainty[4] = 0.03;
  sample.dataset.holdout = {"r3"};
  Diagnosis& diagnosis = sample.diagnosis;
  const model::EffectSpec* creep = model::FindEffect("creep");
  std::mt19937_64 generator(1);
  std::normal_distribution<double> noise(0.0, kNoisePa);
  std::vector<calibration::FittedRun> fitted;
  for (int i = 0; i < 3; ++i) {
    Run run = MakeRun("r" + std::to_string(i + 1), 3e5 + 5e4 * (i - 1), samples);
    calibration::Series series;
    series.run = run.id;
    series.held_out = i == 2;
    series.t_s = run.t_s;
    series.declared_pa = Pressures(run, 1.0, {});
    series.before_pa = Pressures(run, 0.98, {});
    series.after_pa = Pressures(run, 1.02, {{creep, {0.15, 2.0}}});
    const auto phases = calibration::PhasesOf(run);
    for (std::size_t k = 0; k < run.t_s.size(); ++k) {
      run.pressure_pa.push_back(series.after_pa[k] + noise(generator));
      series.phase.push_back(phases[calibration::PhaseAt(phases, run.t_s[k])].phase);
    }
    series.measured_pa = run.pressure_pa;
    AddError(run, series.declared_pa, series.held_out, diagnosis.declared);
    AddError(run, series.before_pa, series.held_out, diagnosis.before);
    AddError(run, series.after_pa, series.held_out, diagnosis.after);
    sample.dataset.runs.push_back(run);
    diagnosis.series.push_back(std::move(series));
  }
  for (std::size_t i = 0; i < sample.dataset.runs.size(); ++i) {
    const Run& run = sample.dataset.runs[i];
    fitted.push_back({&run, diagnosis.series[i].after_pa,
                      calibration::EstimateNoise(calibration::ReadingsOf(run))});
  }
  diagnosis.verdict = calibration::Verdict::kExplained;
  diagnosis.sentence =
      "Explained by creep: the volume grows by a further 15 % over 2 s, which takes the error from "
      "the refitted base model's to that of the noise.";
  diagnosis.noise_pa = kNoisePa;
  diagnosis.effects = {{{creep, {0.15, 2.0}}, {{0.15, 0.14, 0.16, true}, {2.0, 1.8, 2.3, true}}}};
  diagnosis.candidates = {{{"creep"},
                           -8123.0,
                           0.0,
                           diagnosis.after.rms_pa,
                           diagnosis.after.holdout_rms_pa,
                           3,
                           true,
                           4,
                           4,
                           {}},
                          {{"leak:porous"}, -8002.0, 121.0, 480.0, 510.0, 3, true, 4, 3, {}},
                          {{},
                           -3100.0,
                           5023.0,
                           diagnosis.before.rms_pa,
                           diagnosis.before.holdout_rms_pa,
                           1,
                           true,
                           1,
                           1,
                           {}},
                          {{"heat_transfer"}, -2100.0, 6023.0, 9e3, {}, 2, false, 4, 1, {}}};
  diagnosis.tied = {{"creep"}, {"leak:porous"}};
  calibration::Experiment experiment;
  experiment.run = MakeRun("next", 3e5, 801);
  experiment.run.valve = {{0.0, ValveState::kInflate}, {1.3, ValveState::kHold}};
  experiment.measure = {"flow_l_per_min_anr"};
  experiment.expected_difference_pa = 2300.0;
  experiment.expected_delta_bic = 900.0;
  experiment.why = "A hold of 6 s lets creep settle while a leak goes on.";
  diagnosis.next_experiment = experiment;
  diagnosis.residual = calibration::AssessResiduals(fitted, 3);
  diagnosis.fitted = {{calibration::Declared::kSonicConductance, {1.02, 1.015, 1.025, true}}};
  calibration::Discrepancy discrepancy;
  discrepancy.equation = model::EffectPlace::kVolume;
  discrepancy.features = {"pressure"};
  discrepancy.learned = diagnosis.effects.front();
  discrepancy.rms_before_pa = 900.0;
  discrepancy.rms_after_pa = 300.0;
  discrepancy.holdout_before_pa = 950.0;
  discrepancy.places = {{"phase", "hold", 0.7}, {"pressure", "60 to 80 kPa", 0.4}};
  diagnosis.discrepancy = discrepancy;
  diagnosis.unexplained_fraction = 0.02;
  diagnosis.warnings = {
      "r2: 3 readings off both neighbours by more than 6 times the noise were "
      "left out (at 1.20, 3.31 and 5.02 s)"};
  return sample;
}

}  // namespace plenum::test
