#include "calibration/judge/findings.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "calibration/fit/profile.h"
#include "calibration/judge/evidence.h"
#include "calibration/noise/phases.h"
#include "calibration/values/parallel.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kCandidatesShown = 30, kStoppedShown = 2;
constexpr std::size_t kFinalists = 5;  // whose held-out error is found by leaving out each run

std::string TitleOf(const model::EffectSpec& spec) {
  return spec.law.empty() ? std::string(spec.id)
                          : std::string(spec.id) + ":" + std::string(spec.law);
}

Candidate CandidateOf(const Bench& bench, const Contender& contender, bool finalist,
                      const HoldoutByFit& known) {
  Candidate candidate;
  for (const model::EffectSpec* spec : contender.effects)
    candidate.effects.push_back(TitleOf(*spec));
  const Fit& fit = contender.fit;
  candidate.bic = fit.bic;
  candidate.converged = fit.status == FitStatus::kConverged;
  candidate.starts = contender.starts;
  candidate.found_again = contender.found_again;
  candidate.parameters = static_cast<int>(fit.coordinates.size());
  if (!fit.Usable()) return candidate;
  Squares fitted, held_out;
  for (const std::size_t run : bench.data.runs) fitted.Add(ErrorsOf(bench, run, fit.state));
  candidate.rms_pa = fitted.Rms();
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const auto& one) { return one.first == &fit; });
  if (found != known.end()) candidate.holdout_rms_pa = found->second;
  if (candidate.holdout_rms_pa || Stopped(bench)) return candidate;
  for (const std::size_t run : bench.held_out) held_out.Add(ErrorsUnseen(bench, run, fit.state));
  if (bench.held_out.empty() && finalist) {
    if (const auto unseen = LeaveOneOut(bench, fit)) candidate.holdout_rms_pa = unseen->rms_pa;
  } else if (held_out.count > 0 && !Stopped(bench)) {
    candidate.holdout_rms_pa = held_out.Rms();
  }
  return candidate;
}

}  // namespace

std::vector<std::string> IdsOf(const Contender& contender) {
  std::vector<std::string> ids;
  for (const model::EffectSpec* spec : contender.effects) ids.emplace_back(spec->id);
  return ids;
}

void AddEstimates(const Bench& bench, const Fit& fit, Diagnosis& diagnosis) {
  FitOptions options = bench.tight;
  options.cancelled = nullptr;  // one evaluation
  const double memory = MemoryOf(WhitenedOf(bench, fit));
  const Eigen::MatrixXd covariance = Covariance(bench.data, fit, options, memory);
  std::vector<Estimate> estimates = Intervals(fit, covariance);
  if (!Stopped(bench))
    ProfileIntervals(bench.data, fit, covariance, Inflation(fit, memory), bench.tight, estimates);
  std::vector<std::size_t> effects, fitted;  // which coordinates
  for (const model::Effect& effect : fit.state.effects)
    diagnosis.effects.push_back({effect, std::vector<Estimate>(effect.parameters.size())});
  for (std::size_t j = 0; j < estimates.size(); ++j) {
    const Parameter& parameter = fit.coordinates[j].parameter;
    if (parameter.kind == Parameter::Kind::kEffect) {
      diagnosis.effects[parameter.effect].parameters[parameter.number] = estimates[j];
      effects.push_back(j);
    }
    if (parameter.kind == Parameter::Kind::kDeclared) {
      diagnosis.fitted.emplace_back(parameter.declared, estimates[j]);
      fitted.push_back(j);
    }
  }
  std::vector<std::size_t> shown = effects;
  shown.insert(shown.end(), fitted.begin(), fitted.end());
  const auto slope = [&](std::size_t j) {
    return fit.coordinates[j].Slope(fit.u[static_cast<Eigen::Index>(j)]);
  };
  for (const std::size_t i : shown) {
    std::vector<double>& row = diagnosis.covariance.emplace_back();
    for (const std::size_t j : shown)
      row.push_back(slope(i) * slope(j) *
                    covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
  }
}

void AddCandidates(const Bench& bench, const SearchResult& search, const HoldoutByFit& known,
                   Diagnosis& diagnosis) {
  const double best = search.contenders.front().fit.bic;
  std::vector<std::optional<Candidate>> candidates(search.contenders.size());
  const int threads = bench.tight.threads;
  ForAll(candidates.size(), threads, [&](std::size_t i) {
    const std::size_t shown = Stopped(bench) ? kStoppedShown : kCandidatesShown;
    if (i >= shown && i != search.base) return;
    Bench each = bench;
    each.tight.threads = 1;
    candidates[i] = CandidateOf(each, search.contenders[i], i < kFinalists, known);
    candidates[i]->delta_bic = candidates[i]->bic - best;
  });
  for (std::optional<Candidate>& candidate : candidates)
    if (candidate) diagnosis.candidates.push_back(std::move(*candidate));
}

void AddSeries(const Bench& bench, const ModelState& before, const ModelState& after,
               Diagnosis& diagnosis) {
  std::size_t samples = 0;
  for (const Run& run : bench.dataset.runs) samples += run.t_s.size();
  const std::size_t stride = (samples + kSeriesSamplesMax - 1) / kSeriesSamplesMax;
  diagnosis.series.resize(bench.dataset.runs.size());
  ForAll(bench.dataset.runs.size(), bench.tight.threads, [&](std::size_t i) {
    const Run& run = bench.dataset.runs[i];
    Series& series = diagnosis.series[i];
    series.run = run.id;
    series.held_out = HeldOut(bench, i);
    const auto chosen = [&](const std::vector<double>& all) {
      std::vector<double> some;
      for (std::size_t k = 0; k < all.size(); k += stride) some.push_back(all[k]);
      return some;
    };
    series.t_s = chosen(run.t_s);
    series.measured_pa = chosen(run.pressure_pa);
    const std::vector<PhaseSpan> phases = PhasesOf(run);
    for (const double t_s : series.t_s) series.phase.push_back(phases[PhaseAt(phases, t_s)].phase);
    const auto predict = [&](const ModelState& state) {
      const ModelState shown = series.held_out ? Aligned(bench, i, state) : state;
      std::vector<double> pressure_pa = Shown(bench, shown, i).pressure_pa;
      pressure_pa.resize(run.t_s.size(), std::numeric_limits<double>::quiet_NaN());
      return chosen(pressure_pa);
    };
    series.declared_pa = predict(bench.forward.Declared());
    series.before_pa = predict(before);
    series.after_pa = predict(after);
  });
}

void AddWarnings(const Bench& bench, Diagnosis& diagnosis) {
  std::size_t outliers = 0, clipped = 0, staircases = 0;
  for (const ObservedRun& run : bench.observed) {
    outliers += run.noise.outliers.size();
    clipped += run.noise.clipped.size();
    staircases += run.noise.staircase;
  }
  std::vector<std::string>& warnings = diagnosis.warnings;
  if (outliers > 0) warnings.push_back(std::to_string(outliers) + " wild readings were left out");
  if (clipped > 0)
    warnings.push_back(std::to_string(clipped) +
                       " readings at an end of the sensor's range were left out");
  if (staircases > 0)
    warnings.push_back("the readings' steps are coarser than their noise in " +
                       std::to_string(staircases) + " runs");
  if (bench.data.clocks)
    warnings.push_back(
        "the clocks of readings and valve are off by a part of a sample; each run's was fitted");
  for (const FittedEffect& effect : diagnosis.effects) {
    if (effect.effect.spec->id == "dead_volume")
      warnings.push_back(
          "dead_volume differs from a larger rest_volume only by the declared uncertainties");
  }
}

std::string Sentence(const Bench& bench, const SearchResult& search, const Diagnosis& diagnosis) {
  const auto list = [](const std::vector<std::string>& ids) {
    std::string text;
    for (const std::string& id : ids) text += (text.empty() ? "" : " + ") + id;
    return text;
  };
  std::string either;
  for (const auto& ids : diagnosis.tied) either += (either.empty() ? "" : " or ") + list(ids);
  switch (diagnosis.verdict) {
    case Verdict::kAdequate:
      return "The model is good enough: after its uncertain numbers were fitted, only noise is "
             "left.";
    case Verdict::kExplained:
      return "The model lacks " + list(IdsOf(search.contenders[search.chosen])) +
             "; with it, only noise is left.";
    case Verdict::kTie:
      return "The data cannot tell which is missing: " + either +
             (diagnosis.unexplained_fraction > 0.0 ? "; and some structure is left." : ".");
    case Verdict::kUnexplained:
      if (!diagnosis.tied.empty())
        return "The data cannot tell which is missing: " + either +
               "; and structure is left that no known effect accounts for.";
      return diagnosis.effects.empty()
                 ? "Structure is left that no known effect accounts for."
                 : "The model lacks " + list(IdsOf(search.contenders[search.chosen])) +
                       ", but structure is left that no known effect accounts for.";
    case Verdict::kUndecided:
      break;
  }
  return Stopped(bench) ? "Undecided: the search was stopped before its end."
                        : "Undecided: a fit that matters failed.";
}

}  // namespace plenum::calibration
