#include "calibration/judge/stated.h"

#include <algorithm>
#include <cmath>

#include "calibration/fit/run_cost.h"
#include "calibration/judge/findings.h"
#include "calibration/judge/identifiability.h"
#include "calibration/values/parallel.h"
#include "calibration/values/specimens.h"

namespace plenum::calibration {
namespace {

// What one run has of its own is what another has: they are copies.
void TakeOver(std::size_t from, std::size_t to, StatedModel& model) {
  ModelState& state = model.state;
  state.initial_pressure_pa[to] = state.initial_pressure_pa[from];
  state.initial_temperature_k[to] = state.initial_temperature_k[from];
  state.clock_s[to] = state.clock_s[from];
  state.phase_rad[to] = state.phase_rad[from];
  state.late_s[to] = state.late_s[from];
  state.moved_s[to] = state.moved_s[from];
  model.run_factor[to] = model.run_factor[from];
}

// By run.
std::vector<StatedRun> StatedRuns(const Bench& bench) {
  std::vector<StatedRun> stated;
  stated.reserve(bench.dataset.runs.size());
  for (std::size_t i = 0; i < bench.dataset.runs.size(); ++i) {
    const std::vector<double>& readings = bench.dataset.runs[i].pressure_pa;
    const std::vector<std::size_t>& used = bench.observed[i].signals.front().samples;
    StatedRun& run = stated.emplace_back();
    if (IsCopy(bench, i)) run.copy_of = bench.original[i];
    run.relative_tolerance = OptionsOf(bench.data, i, bench.tight).relative_tolerance;
    for (std::size_t k = 0; k < readings.size(); ++k)
      if (!std::isnan(readings[k]) && !std::binary_search(used.begin(), used.end(), k))
        run.left_out.push_back(k);
  }
  return stated;
}

}  // namespace

StatedModel Stated(const Bench& bench, const ModelState& state) {
  const std::size_t runs = bench.dataset.runs.size();
  StatedModel stated{state, {}, {}, bench.dataset.several};
  for (std::size_t k = 0; k < state.specimen_factor.size(); ++k)
    if (const auto number = static_cast<Declared>(k); OfEachSpecimen(state, number))
      stated.state.factor[k] = MeanFactor(bench.dataset, bench.data.runs, state, number);
  const auto factors_of = [&](std::size_t run, const ModelState& of) {
    Factors factors = FactorsOf(bench.dataset.runs[run], of);
    if (stated.several) std::copy_n(stated.state.factor.begin(), kOfActuator, factors.begin());
    return factors;
  };
  for (std::size_t run = 0; run < runs; ++run) stated.run_factor.push_back(factors_of(run, state));
  stated.fitted_alone.resize(runs);
  for (const std::size_t run : bench.held_out) {
    const Fit aligned = AlignedFit(bench, run, state);
    if (!aligned.Usable()) continue;
    CopyRun(aligned.state, run, stated.state);
    stated.run_factor[run] = factors_of(run, aligned.state);
    for (const Coordinate& coordinate : aligned.coordinates)
      stated.fitted_alone[run].push_back(NameOf(coordinate.parameter, state, bench.dataset));
  }
  for (std::size_t run = 0; run < runs; ++run)
    if (IsCopy(bench, run)) TakeOver(bench.original[run], run, stated);
  return stated;
}

ErrorReport ErrorOf(const Bench& bench, const StatedModel& model) {
  std::vector<Squares> of_runs(bench.dataset.runs.size());
  ForAll(of_runs.size(), bench.tight.threads,
         [&](std::size_t i) { of_runs[i] = ErrorsOf(bench, i, OfRun(model, i)); });
  ErrorReport report;
  Squares fitted, held_out;
  for (std::size_t i = 0; i < of_runs.size(); ++i) {
    report.run_rms_pa.emplace_back(bench.dataset.runs[i].id, of_runs[i].Rms());
    if (!IsCopy(bench, i)) (HeldOut(bench, i) ? held_out : fitted).Add(of_runs[i]);
  }
  const model::Chamber& chamber = bench.dataset.runs.front().chamber;
  report.rms_pa = fitted.Rms();
  report.peak_pa = fitted.peak;
  report.rms_share = report.rms_pa / model::Span(chamber);
  if (held_out.count > 0) report.holdout_rms_pa = held_out.Rms();
  return report;
}

void StateDeclared(const Bench& bench, Diagnosis& diagnosis) {
  StatedModels& models = diagnosis.models;
  models.runs = StatedRuns(bench);
  models.declared = models.before = models.after = Stated(bench, bench.forward.Declared());
  diagnosis.declared = diagnosis.before = diagnosis.after = ErrorOf(bench, models.declared);
}

void StateModels(const Bench& bench, const Fit& before, const Fit& after, Diagnosis& diagnosis) {
  StatedModels& models = diagnosis.models;
  models.before = models.after = Stated(bench, before.state);
  diagnosis.before = diagnosis.after = ErrorOf(bench, models.before);
  if (&before == &after) return;
  models.after = Stated(bench, after.state);
  diagnosis.after = ErrorOf(bench, models.after);
}

void StateLearned(const Bench& bench, const Fit& fit, Diagnosis& diagnosis) {
  diagnosis.models.learned = Stated(bench, fit.state);
  ErrorReport& error = diagnosis.learned.emplace(ErrorOf(bench, *diagnosis.models.learned));
  Discrepancy& discrepancy = *diagnosis.discrepancy;
  discrepancy.beside = EstimatesOf(bench, fit, IntervalsFrom::kCurvature);
  discrepancy.rms_after_pa = error.rms_pa;
  if (error.holdout_rms_pa)
    discrepancy.holdout_after_pa = error.holdout_rms_pa;
  else
    error.holdout_rms_pa = discrepancy.holdout_after_pa;  // of runs left out in turn
}

void WithdrawLearned(Diagnosis& diagnosis) {
  if (!diagnosis.learned) return;
  const auto better =
      PredictsBetter(diagnosis.after.holdout_rms_pa, diagnosis.learned->holdout_rms_pa);
  if (better.value_or(true)) return;
  diagnosis.warnings.emplace_back(
      "a learned term predicts runs that no fit saw worse than the model without it: it is not "
      "offered");
  diagnosis.learned.reset();
  diagnosis.models.learned.reset();
  diagnosis.discrepancy->learned.reset();
}

}  // namespace plenum::calibration
