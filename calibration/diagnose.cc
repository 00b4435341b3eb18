#include "calibration/diagnose.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>

#include "calibration/criticism.h"
#include "calibration/discrepancy.h"
#include "calibration/evidence.h"
#include "calibration/experiment.h"
#include "calibration/identifiability.h"
#include "calibration/phases.h"
#include "calibration/residual.h"
#include "calibration/thresholds.h"
#include "calibration/verdict.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kCandidatesShown = 30;
constexpr std::size_t kFinalSteps = 200'000;
constexpr std::size_t kReportSteps = 20'000;  // when there is no time left
constexpr std::size_t kFinalists = 5;  // whose held-out error is found by leaving out each run

// Sum of squares and worst of many residuals.
struct Squares {
  double sum = 0.0, peak = 0.0;
  std::size_t count = 0;
  void Add(double residual) {
    if (!std::isfinite(residual)) return;
    sum += residual * residual;
    peak = std::max(peak, std::abs(residual));
    ++count;
  }
  void Add(const Squares& other) {
    sum += other.sum;
    peak = std::max(peak, other.peak);
    count += other.count;
  }
  double Rms() const { return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count)); }
};

std::string TitleOf(const model::EffectSpec& spec) {
  return spec.law.empty() ? std::string(spec.id)
                          : std::string(spec.id) + ":" + std::string(spec.law);
}

class Diagnosing {
 public:
  Diagnosing(const Dataset& dataset, const DiagnoseOptions& options)
      : dataset_(dataset),
        options_(options),
        cancelled_(options.cancelled),
        forward_(dataset),
        observed_(Observe(dataset)) {
    options_.cancelled = [this] { return Stopped(); };
    data_.forward = &forward_;
    data_.observed = &observed_;
    data_.sizes = SizesOf(dataset);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i)
      (HeldOut(i) ? held_out_ : data_.runs).push_back(i);
    tight_.noise_share = 1e-3;
    tight_.steps_max = kFinalSteps;
    tight_.threads = options.threads;
    tight_.cancelled = options_.cancelled;
  }

  Diagnosis Take() {
    const auto enough = [this](const Fit& fit) {
      return PriorsHold(fit) && IsNoise(LeftoverOf(fit, false));
    };
    search_ = SearchEffects(data_, options_, enough);
    data_ = search_.data;
    base_ = &search_.contenders[search_.base];
    Assess();
    return std::move(diagnosis_);
  }

  Diagnosis TakeOf(const KnownModel& known) {
    ModelState state = forward_.Declared();
    state.effects = known.effects;
    for (const auto& [number, factor] : known.factors)
      state.factor[static_cast<std::size_t>(number)] = factor;
    data_.runs.insert(data_.runs.end(), held_out_.begin(), held_out_.end());
    held_out_.clear();
    FitOptions options = tight_;
    options.nuisance_only = true;
    const Fit aligned = FitModel(data_, state, options);
    diagnosis_.noise_pa = NoiseOf(data_.runs);
    diagnosis_.declared = ErrorOf(forward_.Declared());
    if (!aligned.Usable()) {
      diagnosis_.sentence = "The saved model cannot be run on these data: " + aligned.detail + ".";
      return std::move(diagnosis_);
    }
    const Leftover left = LeftoverOf(aligned, false);
    diagnosis_.before = diagnosis_.after = ErrorOf(aligned.state);
    diagnosis_.residual = left.residual;
    diagnosis_.verdict = IsNoise(left) ? Verdict::kAdequate : Verdict::kUnexplained;
    diagnosis_.unexplained_fraction =
        diagnosis_.verdict == Verdict::kAdequate ? 0.0 : UnexplainedFraction(left, left);
    AddSeries(forward_.Declared(), aligned.state, aligned.state);
    diagnosis_.sentence = diagnosis_.verdict == Verdict::kAdequate
                              ? "The saved model predicts these runs to within their noise."
                              : "The saved model leaves structure in these runs.";
    return std::move(diagnosis_);
  }

 private:
  using Clock = std::chrono::steady_clock;

  // Once true, true for good: the caller's wish, or the end of the time.
  bool Stopped() const {
    if (stopped_) return true;
    const std::chrono::duration<double> taken = Clock::now() - start_;
    if ((cancelled_ && cancelled_()) || taken.count() > options_.time_limit_s) stopped_ = true;
    return stopped_;
  }

  // Of what is known already: also when the time is over.
  Reading Shown(const ModelState& state, std::size_t run) const {
    FitOptions options = tight_;
    options.cancelled = nullptr;
    if (Stopped()) options.steps_max = kReportSteps;
    return Predicted(data_, state, run, options);
  }

  void Progress(double share, const std::string& what) const {
    if (options_.progress) options_.progress(share, what);
  }

  bool HeldOut(std::size_t run) const {
    const std::string& id = dataset_.runs[run].id;
    return std::find(dataset_.holdout.begin(), dataset_.holdout.end(), id) !=
           dataset_.holdout.end();
  }

  Squares ErrorsOf(std::size_t run, const ModelState& state) const {
    const Reading reading = Shown(state, run);
    Squares squares;
    if (reading.pressure_pa.empty()) {
      squares.Add(std::numeric_limits<double>::max());
      return squares;
    }
    for (const double r : PressureResidual(dataset_.runs[run], observed_[run], reading))
      squares.Add(r);
    return squares;
  }

  ErrorReport ErrorOf(const ModelState& state) const {
    ErrorReport report;
    Squares fitted, held_out;
    for (std::size_t i = 0; i < dataset_.runs.size(); ++i) {
      const Squares squares = HeldOut(i) ? ErrorsUnseen(i, state) : ErrorsOf(i, state);
      report.run_rms_pa.emplace_back(dataset_.runs[i].id, squares.Rms());
      (HeldOut(i) ? held_out : fitted).Add(squares);
    }
    const model::Chamber& chamber = dataset_.runs.front().chamber;
    report.rms_pa = fitted.Rms();
    report.peak_pa = fitted.peak;
    report.rms_share =
        report.rms_pa / (chamber.operating_pressure_pa - chamber.ambient_pressure_pa);
    if (held_out.count > 0) report.holdout_rms_pa = held_out.Rms();
    return report;
  }

  // Errors on a run that the fit did not see. Its clock and its initial pressure, where unknown,
  // are its own: nothing that was learned from other runs can tell them, so that they alone are
  // fitted.
  Squares ErrorsUnseen(std::size_t run, const ModelState& state) const {
    FitData data = data_;
    data.runs = {run};
    FitOptions options = tight_;
    options.nuisance_only = true;
    const Fit aligned = FitModel(data, state, options);
    return ErrorsOf(run, aligned.Usable() ? aligned.state : state);
  }

  // Of the usable samples of these runs.
  double NoiseOf(const std::vector<std::size_t>& runs) const {
    double sum = 0.0, count = 0.0;
    for (const std::size_t i : runs) {
      const ObservedSignal& pressure = observed_[i].signals.front();
      const double samples = static_cast<double>(pressure.samples.size());
      sum += samples * pressure.sigma * pressure.sigma;
      count += samples;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
  }

  // The error on runs left out one by one, each predicted by a fit to the others.
  std::optional<double> LeaveOneOut(const Fit& fit) const {
    if (data_.runs.size() < 2) return std::nullopt;
    Squares squares;
    for (const std::size_t left_out : data_.runs) {
      FitData data = data_;
      std::erase(data.runs, left_out);
      FitOptions options = tight_;
      options.noise_share = 1e-2;
      ModelState start = fit.state;
      const ModelState declared = forward_.Declared();
      start.initial_pressure_pa[left_out] = declared.initial_pressure_pa[left_out];
      start.initial_temperature_k[left_out] = declared.initial_temperature_k[left_out];
      start.clock_s[left_out] = 0.0;
      const Fit without = FitModel(data, start, options);
      if (!without.Usable()) return std::nullopt;
      squares.Add(ErrorsUnseen(left_out, without.state));
    }
    return squares.Rms();
  }

  Leftover LeftoverOf(const Fit& fit, bool with_holdout) const {
    Leftover leftover;
    if (!fit.Usable()) return leftover;
    std::vector<FittedRun> runs;
    Squares squares;
    for (const std::size_t i : data_.runs) {
      const Reading reading = Shown(fit.state, i);
      if (reading.pressure_pa.empty()) return leftover;
      runs.push_back({&dataset_.runs[i], reading.pressure_pa, observed_[i].noise});
      for (const double r : PressureResidual(dataset_.runs[i], observed_[i], reading))
        squares.Add(r);
    }
    leftover.residual = AssessResiduals(runs, static_cast<int>(fit.coordinates.size()));
    leftover.rms_pa = squares.Rms();
    leftover.noise_pa = NoiseOf(data_.runs);
    if (IsNoise(leftover)) leftover.learnable_bic = LearnableGain(data_, fit, tight_);
    if (!with_holdout) return leftover;
    if (held_out_.empty()) {
      leftover.holdout_rms_pa = LeaveOneOut(fit);
      leftover.holdout_noise_pa = leftover.noise_pa;
    } else {
      Squares held_out;
      for (const std::size_t i : held_out_) held_out.Add(ErrorsUnseen(i, fit.state));
      leftover.holdout_rms_pa = held_out.Rms();
      leftover.holdout_noise_pa = NoiseOf(held_out_);
    }
    return leftover;
  }

  void Assess() {
    Evidence evidence;
    evidence.complete = search_.complete && base_->fit.Usable() && Chosen().fit.Usable();
    diagnosis_.noise_pa = NoiseOf(data_.runs);
    diagnosis_.declared = ErrorOf(forward_.Declared());
    if (!base_->fit.Usable() && Stopped()) {
      diagnosis_.before = diagnosis_.after = diagnosis_.declared;
      diagnosis_.sentence = Sentence();
      return;
    }
    if (!base_->fit.Usable()) {
      diagnosis_.sentence = "The base model could not be fitted: " + base_->fit.detail + ".";
      return;
    }
    evidence.before = LeftoverOf(base_->fit, !Stopped());
    Weigh(1.0, evidence);
    diagnosis_.verdict = Judge(evidence);
    if (diagnosis_.verdict == Verdict::kUnexplained && evidence.accepted) {
      const double memory = MemoryOf(WhitenedOf(Chosen().fit));
      search_.chosen = Standing(search_.contenders, memory);
      Weigh(memory, evidence);
    }
    const Contender& chosen = Chosen();
    diagnosis_.before = ErrorOf(base_->fit.state);
    const ErrorReport after = evidence.accepted ? ErrorOf(chosen.fit.state) : diagnosis_.before;
    AddCandidates();
    // Effects are established where they account for most of the residual and a term learned
    // without them does not do as well; which of several they are may still be open.
    bool established =
        evidence.accepted && UnexplainedFraction(evidence.before, evidence.after) <= kEstablished;
    const bool open =
        diagnosis_.verdict == Verdict::kTie ||
        (diagnosis_.verdict == Verdict::kUnexplained && established && tied_.size() > 1u);
    const Contender* shown = &chosen;
    if (diagnosis_.verdict == Verdict::kUnexplained) {
      Progress(0.95, "what is left unexplained");
      LearnedModel learned =
          LearnDiscrepancy(data_, open ? chosen.fit : base_->fit, held_out_, tight_);
      if (established && !open) {
        established = false;
        if (!Stopped() && !IsNoise(LeftoverOf(learned.fit, false))) {
          LearnedModel beside = LearnDiscrepancy(data_, chosen.fit, held_out_, tight_);
          established = beside.fit.bic < learned.fit.bic - kAccept;
          if (established) learned = std::move(beside);
        }
      }
      if (!established) shown = base_, evidence.after = evidence.before;
      diagnosis_.discrepancy = std::move(learned.discrepancy);
      AddEstimates(learned.fit);
      if (diagnosis_.discrepancy->learned) diagnosis_.effects.pop_back();
    } else {
      AddEstimates(chosen.fit);
    }
    diagnosis_.after = shown == base_ ? diagnosis_.before : after;
    diagnosis_.before.holdout_rms_pa = evidence.before.holdout_rms_pa;
    diagnosis_.after.holdout_rms_pa = evidence.after.holdout_rms_pa;
    diagnosis_.residual = evidence.after.residual;
    diagnosis_.unexplained_fraction = UnexplainedFraction(evidence.before, evidence.after);
    if (diagnosis_.verdict == Verdict::kUndecided) diagnosis_.effects.clear();
    if (open) {
      diagnosis_.effects.clear();
      std::vector<TiedFit> fits;
      for (const Contender* contender : tied_) {
        diagnosis_.tied.push_back(IdsOf(*contender));
        fits.push_back({IdsOf(*contender), &contender->fit});
      }
      diagnosis_.next_experiment = DesignExperiment(data_, fits, tight_);
    }
    Progress(0.99, "report");
    AddSeries(forward_.Declared(), base_->fit.state, shown->fit.state);
    AddWarnings();
    if (Stopped()) {
      diagnosis_.warnings.push_back(
          diagnosis_.verdict == Verdict::kUndecided
              ? "stopped before all sets of effects were compared: what is listed is the best so "
                "far"
              : "stopped after the verdict: a learned term, the next experiment or held-out errors "
                "may be lacking");
    } else if (const auto found = Identify(data_, shown->fit, tight_)) {
      for (std::string& sentence : Sentences(*found))
        diagnosis_.warnings.push_back(std::move(sentence));
    }
    diagnosis_.sentence = Sentence();
  }

  const Contender& Chosen() const { return search_.contenders[search_.chosen]; }

  // What the chosen set leaves and what does as well, by residuals that are worth 1/memory of their
  // number.
  void Weigh(double memory, Evidence& evidence) {
    evidence.accepted = &Chosen() != base_;
    evidence.after = evidence.accepted ? LeftoverOf(Chosen().fit, !Stopped()) : evidence.before;
    tied_ = Tied(Chosen(), memory, IsNoise(evidence.before) ? kTieInNoise : kTie);
    evidence.tied = static_cast<int>(tied_.size()) - 1;
    if (Stopped()) evidence.complete = false;
  }

  // Of the pressure, by run.
  std::vector<std::vector<double>> WhitenedOf(const Fit& fit) const {
    std::vector<std::vector<double>> series;
    for (const std::size_t i : data_.runs) {
      std::vector<double>& rows = series.emplace_back(observed_[i].rows());
      Residuals(dataset_.runs[i], observed_[i], Shown(fit.state, i), rows);
      rows.resize(observed_[i].signals.front().samples.size());
    }
    return series;
  }

  // The chosen set and those of its size that do as well, the best first, each set of ids once.
  std::vector<const Contender*> Tied(const Contender& chosen, double memory, double reach) const {
    std::vector<const Contender*> tied = {&chosen};
    for (const Contender& contender : search_.contenders) {
      if (contender.effects.size() != chosen.effects.size() || !contender.fit.Usable()) continue;
      if (BicWith(contender.fit, memory) > BicWith(chosen.fit, memory) + reach) continue;
      const bool known = std::any_of(tied.begin(), tied.end(), [&](const Contender* other) {
        return SameEffects(contender, *other);
      });
      if (!known) tied.push_back(&contender);
    }
    return tied;
  }

  static std::vector<std::string> IdsOf(const Contender& contender) {
    std::vector<std::string> ids;
    for (const model::EffectSpec* spec : contender.effects) ids.emplace_back(spec->id);
    return ids;
  }

  void AddEstimates(const Fit& fit) {
    FitOptions options = tight_;
    options.cancelled = nullptr;  // one evaluation
    const Eigen::MatrixXd covariance = Covariance(data_, fit, options);
    const std::vector<Estimate> estimates = Intervals(fit, covariance);
    std::vector<std::size_t> effects, fitted;  // which coordinates
    for (const model::Effect& effect : fit.state.effects)
      diagnosis_.effects.push_back({effect, std::vector<Estimate>(effect.parameters.size())});
    for (std::size_t j = 0; j < estimates.size(); ++j) {
      const Parameter& parameter = fit.coordinates[j].parameter;
      if (parameter.kind == Parameter::Kind::kEffect) {
        diagnosis_.effects[parameter.effect].parameters[parameter.number] = estimates[j];
        effects.push_back(j);
      }
      if (parameter.kind == Parameter::Kind::kDeclared) {
        diagnosis_.fitted.emplace_back(parameter.declared, estimates[j]);
        fitted.push_back(j);
      }
    }
    std::vector<std::size_t> shown = effects;
    shown.insert(shown.end(), fitted.begin(), fitted.end());
    const auto slope = [&](std::size_t j) {
      return fit.coordinates[j].Slope(fit.u[static_cast<Eigen::Index>(j)]);
    };
    for (const std::size_t i : shown) {
      std::vector<double>& row = diagnosis_.covariance.emplace_back();
      for (const std::size_t j : shown)
        row.push_back(slope(i) * slope(j) *
                      covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)));
    }
  }

  void AddCandidates() {
    const double best = search_.contenders.front().fit.bic;
    for (std::size_t i = 0; i < search_.contenders.size(); ++i) {
      const Contender& contender = search_.contenders[i];
      const std::size_t shown = Stopped() ? kFinalists : kCandidatesShown;
      if (i >= shown && &contender != base_) continue;
      Candidate candidate;
      for (const model::EffectSpec* spec : contender.effects)
        candidate.effects.push_back(TitleOf(*spec));
      candidate.bic = contender.fit.bic;
      candidate.delta_bic = contender.fit.bic - best;
      candidate.converged = contender.fit.status == FitStatus::kConverged;
      candidate.starts = contender.starts;
      candidate.found_again = contender.found_again;
      candidate.parameters = static_cast<int>(contender.fit.coordinates.size());
      if (contender.fit.Usable()) {
        Squares fitted, held_out;
        for (const std::size_t run : data_.runs) fitted.Add(ErrorsOf(run, contender.fit.state));
        for (const std::size_t run : held_out_)
          if (!Stopped()) held_out.Add(ErrorsUnseen(run, contender.fit.state));
        candidate.rms_pa = fitted.Rms();
        if (held_out_.empty() && i < kFinalists && !Stopped())
          candidate.holdout_rms_pa = LeaveOneOut(contender.fit);
        else if (held_out.count > 0 && !Stopped())
          candidate.holdout_rms_pa = held_out.Rms();
      }
      diagnosis_.candidates.push_back(std::move(candidate));
    }
  }

  void AddSeries(const ModelState& declared, const ModelState& before, const ModelState& after) {
    for (std::size_t i = 0; i < dataset_.runs.size(); ++i) {
      const Run& run = dataset_.runs[i];
      Series series;
      series.run = run.id;
      series.held_out = HeldOut(i);
      series.t_s = run.t_s;
      series.measured_pa = run.pressure_pa;
      const std::vector<PhaseSpan> phases = PhasesOf(run);
      for (const double t_s : run.t_s) series.phase.push_back(phases[PhaseAt(phases, t_s)].phase);
      const auto predict = [&](const ModelState& state) {
        std::vector<double> pressure_pa = Shown(state, i).pressure_pa;
        pressure_pa.resize(run.t_s.size(), std::numeric_limits<double>::quiet_NaN());
        return pressure_pa;
      };
      series.declared_pa = predict(declared);
      series.before_pa = predict(before);
      series.after_pa = predict(after);
      diagnosis_.series.push_back(std::move(series));
    }
  }

  void AddWarnings() {
    std::size_t outliers = 0, clipped = 0, staircases = 0;
    for (const ObservedRun& run : observed_) {
      outliers += run.noise.outliers.size();
      clipped += run.noise.clipped.size();
      staircases += run.noise.staircase;
    }
    std::vector<std::string>& warnings = diagnosis_.warnings;
    if (outliers > 0) warnings.push_back(std::to_string(outliers) + " wild readings were left out");
    if (clipped > 0)
      warnings.push_back(std::to_string(clipped) +
                         " readings at an end of the sensor's range were left out");
    if (staircases > 0)
      warnings.push_back("the readings' steps are coarser than their noise in " +
                         std::to_string(staircases) + " runs");
    if (data_.clocks)
      warnings.push_back(
          "the clocks of readings and valve are off by a part of a sample; each run's was fitted");
    for (const FittedEffect& effect : diagnosis_.effects) {
      if (effect.effect.spec->id == "dead_volume")
        warnings.push_back(
            "dead_volume differs from a larger rest_volume only by the declared uncertainties");
    }
  }

  std::string Sentence() const {
    const auto list = [](const std::vector<std::string>& ids) {
      std::string text;
      for (const std::string& id : ids) text += (text.empty() ? "" : " + ") + id;
      return text;
    };
    std::string either;
    for (const auto& ids : diagnosis_.tied) either += (either.empty() ? "" : " or ") + list(ids);
    switch (diagnosis_.verdict) {
      case Verdict::kAdequate:
        return "The model is good enough: after its uncertain numbers were fitted, only noise is "
               "left.";
      case Verdict::kExplained:
        return "The model lacks " + list(IdsOf(search_.contenders[search_.chosen])) +
               "; with it, only noise is left.";
      case Verdict::kTie:
        return "The data cannot tell which is missing: " + either + ".";
      case Verdict::kUnexplained:
        if (!diagnosis_.tied.empty())
          return "The data cannot tell which is missing: " + either +
                 "; and structure is left that no known effect accounts for.";
        return diagnosis_.effects.empty()
                   ? "Structure is left that no known effect accounts for."
                   : "The model lacks " + list(IdsOf(search_.contenders[search_.chosen])) +
                         ", but structure is left that no known effect accounts for.";
      case Verdict::kUndecided:
        break;
    }
    return Stopped() ? "Undecided: the search was stopped before its end."
                     : "Undecided: a fit that matters failed.";
  }

  const Dataset& dataset_;
  DiagnoseOptions options_;  // asks Stopped
  const std::function<bool()> cancelled_;
  const Clock::time_point start_ = Clock::now();
  mutable std::atomic<bool> stopped_ = false;
  ForwardModel forward_;
  std::vector<ObservedRun> observed_;
  FitData data_;
  std::vector<std::size_t> held_out_;
  FitOptions tight_;
  SearchResult search_;
  const Contender* base_ = nullptr;
  std::vector<const Contender*> tied_;  // the chosen set first
  Diagnosis diagnosis_;
};

}  // namespace

Diagnosis Diagnose(const Dataset& dataset, const DiagnoseOptions& options) {
  return Diagnosing(dataset, options).Take();
}

Diagnosis Predict(const Dataset& dataset, const KnownModel& known, const DiagnoseOptions& options) {
  return Diagnosing(dataset, options).TakeOf(known);
}

}  // namespace plenum::calibration
