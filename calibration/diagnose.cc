#include "calibration/diagnose.h"

#include <algorithm>
#include <atomic>
#include <chrono>

#include "calibration/judge/errors.h"
#include "calibration/judge/evidence.h"
#include "calibration/judge/findings.h"
#include "calibration/judge/stated.h"
#include "calibration/judge/ties.h"
#include "calibration/judge/verdict.h"
#include "calibration/learn/discrepancy.h"
#include "calibration/learn/slips.h"
#include "calibration/names/measured_numbers.h"
#include "calibration/names/record_warnings.h"
#include "calibration/names/stability.h"
#include "calibration/names/tied_sets.h"
#include "calibration/names/without_names.h"
#include "calibration/names/wrong_numbers.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kFinalSteps = 200'000;
constexpr int kFirstLooks = 5;
// Readings that threads simulate side by side, each with its derivatives: about 0.3 kB a reading.
constexpr std::size_t kReadingsAtATime = 100'000;

int ThreadsFor(const Dataset& dataset, int threads) {
  std::size_t longest = 1;
  for (const Run& run : dataset.runs) longest = std::max(longest, run.t_s.size());
  return std::clamp(static_cast<int>(kReadingsAtATime / longest), 1, std::max(1, threads));
}

class Diagnosing {
 public:
  Diagnosing(const Dataset& dataset, const DiagnoseOptions& options)
      : options_(options),
        cancelled_(options.cancelled),
        forward_(dataset),
        observed_(Observe(dataset)),
        bench_{dataset, forward_, observed_, {}, {}, OriginalsOf(dataset), {}} {
    options_.cancelled = [this] { return Stopped(); };
    options_.threads = ThreadsFor(dataset, options.threads);
    bench_.data.forward = &forward_;
    bench_.data.observed = &observed_;
    bench_.data.sizes = SizesOf(dataset);
    for (std::size_t i = 0; i < dataset.runs.size(); ++i)
      if (!IsCopy(bench_, i))
        (HeldOut(bench_, i) ? bench_.held_out : bench_.data.runs).push_back(i);
    bench_.tight.noise_share = 1e-3;
    bench_.tight.steps_max = kFinalSteps;
    bench_.tight.threads = options_.threads;
    bench_.tight.cancelled = options_.cancelled;
  }

  Diagnosis Take() {
    diagnosis_.slips = SuspectedSlips(bench_.dataset, options_.cancelled);
    TakeFirstLook();
    if (!SettledOrWarned()) {
      FitBaseAlone();
      StateUnsettled(bench_, base_->fit, diagnosis_);
      return std::move(diagnosis_);
    }
    const FitData data = bench_.data;
    do {
      Search(data, options_);
    } while (LearnReadings(Chosen().fit) && !Stopped());
    Assess();
    if (!diagnosis_.tied.empty()) WidenByTied(bench_.dataset, tied_, diagnosis_.measured);
    return std::move(diagnosis_);
  }

  Diagnosis TakeOf(const KnownModel& known) {
    ModelState state = forward_.Declared();
    state.effects = known.effects;
    for (const auto& [number, factor] : known.factors) SetFactor(number, factor, state);
    bench_.data.runs.insert(bench_.data.runs.end(), bench_.held_out.begin(), bench_.held_out.end());
    bench_.held_out.clear();
    FitOptions options = bench_.tight;
    options.nuisance_only = true;
    Fit aligned = FitModel(bench_.data, state, options);
    if (LearnReadings(aligned)) aligned = FitModel(bench_.data, aligned.state, options);
    StatePrediction(bench_, aligned, diagnosis_);
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

  void Progress(double share, const std::string& what) const {
    if (options_.progress) options_.progress(share, what);
  }

  // What readings on a grid, few readings and sizes that are not known are taken for at first.
  void TakeFirstLook() {
    const auto& uncertainty = bench_.dataset.relative_uncertainty;
    const bool unknown = std::count(uncertainty.begin(), uncertainty.end(), kUnknown) > 0;
    const bool rough = std::any_of(observed_.begin(), observed_.end(), [](const ObservedRun& run) {
      return run.noise.staircase || !(run.noise.relative_error < kRoughNoise);
    });
    if (!rough && !unknown) return;
    Fit first = FitModel(bench_.data, forward_.Declared(), bench_.tight);
    for (int k = 0; k < kFirstLooks && rough && LearnReadings(first); ++k)
      first = FitModel(bench_.data, first.state, bench_.tight);
    if (first.Usable()) bench_.data.sizes = SizesOf(bench_.dataset, first.state);
  }

  // What a fit shows of the readings: wild ones, and their noise. True where fits are to be made
  // again.
  bool LearnReadings(const Fit& fit) {
    if (!fit.Usable()) return false;
    std::vector<Reading> predicted(observed_.size());
    for (const std::size_t run : bench_.data.runs) predicted[run] = Shown(bench_, fit.state, run);
    for (const std::size_t run : bench_.held_out)
      predicted[run] = Shown(bench_, Aligned(bench_, run, fit.state), run);
    LeaveOutWild(bench_.dataset, bench_.held_out, predicted, observed_);
    const bool wild = LeaveOutWild(bench_.dataset, bench_.data.runs, predicted, observed_);
    const bool less = TakeNoiseOfFit(bench_.dataset, bench_.data.runs, predicted,
                                     fit.coordinates.size(), observed_);
    return TakeHiddenNoise(bench_.dataset, bench_.data.runs, predicted, observed_) || wild || less;
  }

  void Search(const FitData& data, const SearchOptions& options) {
    search_ = SearchEffects(
        data, options,
        [this](const Fit& fit) {
          return PriorsHold(fit) && IsNoise(LeftoverOf(bench_, fit, false));
        },
        search_);
    bench_.data = search_.data;
    base_ = &search_.contenders[search_.base];
  }

  // Whether effects may be named. Of a record that is as it was meant slips are only warned of.
  bool SettledOrWarned() {
    for (const SuspectedSlip& slip : diagnosis_.slips) diagnosis_.warnings.push_back(slip.what);
    if (bench_.dataset.as_written) diagnosis_.slips.clear();
    return diagnosis_.slips.empty();
  }

  void FitBaseAlone() {
    Contender base;
    base.fit = FitModel(bench_.data, forward_.Declared(), bench_.tight);
    search_ = {bench_.data, {std::move(base)}, 0, 0, true, false};
    base_ = &search_.contenders.front();
  }

  bool Complete() const { return search_.complete && base_->fit.Usable() && Chosen().fit.Usable(); }

  // In one run a clock that is off and strokes that are late are one. If several effects that act
  // in time do as well as the clock of the only run, the tie among them is the verdict.
  void ConsiderEffectsForTheClock(Evidence& evidence) {
    SearchResult with_clock = search_;
    SearchOptions options = options_;
    options.clocks_may_be_off = false;
    FitData data = bench_.data;
    data.clocks = false;
    Search(data, options);
    Evidence without;
    without.complete = Complete();
    if (without.complete) {
      without.before = LeftoverOf(bench_, base_->fit, false);
      Weigh(1.0, without);
    }
    const Fit& clock = with_clock.contenders[with_clock.base].fit;
    const auto in_time = [](const Contender* one) {
      return std::all_of(one->effects.begin(), one->effects.end(),
                         [](const model::EffectSpec* spec) { return ActsInTime(*spec); });
    };
    if (Judge(without) == Verdict::kTie && std::all_of(tied_.begin(), tied_.end(), in_time) &&
        Chosen().fit.bic < clock.bic + kClock) {
      evidence = without;
      by_the_clock_ = clock;
      diagnosis_.verdict = Verdict::kTie;
      diagnosis_.warnings.push_back(
          "or none of them: the clock of readings and valve may be off in the only run");
      return;
    }
    search_ = std::move(with_clock);
    bench_.data = search_.data;
    base_ = &search_.contenders[search_.base];
    Weigh(1.0, evidence);
  }

  void Assess() {
    Evidence evidence;
    evidence.complete = Complete();
    diagnosis_.noise_pa = NoiseOf(bench_, bench_.data.runs);
    if (!base_->fit.Usable()) StateDeclared(bench_, diagnosis_);
    if (!base_->fit.Usable() && Stopped()) {
      diagnosis_.sentence = Sentence(bench_, search_, WhatIsOpen(evidence), diagnosis_);
      return;
    }
    if (!base_->fit.Usable()) {
      diagnosis_.sentence = "The base model could not be fitted: " + base_->fit.detail + ".";
      return;
    }
    evidence.before = LeftoverOf(bench_, base_->fit, !Stopped());
    Weigh(1.0, evidence);
    diagnosis_.verdict = Judge(evidence);
    if (diagnosis_.verdict == Verdict::kAdequate && bench_.data.clocks &&
        IsOneRecording(bench_.data) && !Stopped())
      ConsiderEffectsForTheClock(evidence);
    if (IsNamed(diagnosis_.verdict)) {
      evidence.imitated = IsImitated();
      diagnosis_.verdict = Judge(evidence);
    }
    if (diagnosis_.verdict == Verdict::kUnexplained && !Stopped()) {
      diagnosis_.slips = SlipsThatFit(bench_.data, base_->fit, Chosen().fit, options_);
      if (!SettledOrWarned()) return StateUnsettled(bench_, base_->fit, diagnosis_);
    }
    if (diagnosis_.verdict == Verdict::kUnexplained && evidence.accepted)
      ChooseBesideStructure(evidence);
    const Contender& chosen = Chosen();
    AddCandidates(bench_, search_, memory_,
                  {{&base_->fit, evidence.before.holdout_rms_pa},
                   {&chosen.fit, evidence.after.holdout_rms_pa}},
                  diagnosis_);
    std::string doubt;  // why the chosen set is not named, where it is not
    // Effects are established where they account for most of the residual and a term learned
    // without them does not do as well; which of several they are may still be open.
    bool established = evidence.accepted && !PredictsWorse(evidence.before, evidence.after) &&
                       UnexplainedFraction(evidence.before, evidence.after) <= kEstablished;
    if (evidence.imitated && tied_.size() > 1u) established = false;
    if (evidence.complete && established) doubt = DoubtOfNames(evidence);
    if (!doubt.empty()) established = false;
    const bool open = diagnosis_.verdict == Verdict::kTie ||
                      (diagnosis_.verdict == Verdict::kUnexplained && established &&
                       !evidence.imitated && tied_.size() > 1u);
    const Contender* shown = &chosen;
    if (diagnosis_.verdict == Verdict::kUnexplained) {
      LearnedModel learned = Learn(open, established);
      if (!established && doubt.empty()) doubt = DoubtOf(evidence);
      if (!established) shown = base_, evidence.after = evidence.before;
      diagnosis_.discrepancy = std::move(learned.discrepancy);
      if (diagnosis_.discrepancy->learned) StateLearned(bench_, learned.fit, diagnosis_);
    }
    StateDeclared(bench_, diagnosis_);
    StateModels(bench_, base_->fit, shown->fit, diagnosis_);
    if (diagnosis_.verdict != Verdict::kUndecided)
      static_cast<Estimates&>(diagnosis_) =
          EstimatesOf(bench_, shown->fit, IntervalsFrom::kProfile);
    if (bench_.held_out.empty()) {  // those of runs left out in turn
      diagnosis_.before.holdout_rms_pa = evidence.before.holdout_rms_pa;
      diagnosis_.after.holdout_rms_pa = evidence.after.holdout_rms_pa;
    }
    WithdrawLearned(diagnosis_);
    diagnosis_.residual = evidence.after.residual;
    diagnosis_.unexplained_fraction = UnexplainedFraction(evidence.before, evidence.after);
    if (diagnosis_.verdict != Verdict::kUndecided && !open)
      diagnosis_.numbers = WrongNumbersOf(bench_.dataset, *shown, search_.contenders, memory_);
    if (open) {
      StateTied(bench_, search_, memory_, tied_, diagnosis_);
      Propose();
    }
    Progress(0.99, "report");
    AddSeries(bench_, diagnosis_);
    AddWarnings(bench_, diagnosis_);
    AddReasons(search_, memory_, open ? tied_ : std::vector<const Contender*>{shown}, doubt,
               rival_.as_good, diagnosis_);
    AddLimits(bench_, shown->fit, diagnosis_);
    diagnosis_.sentence = Sentence(bench_, search_, WhatIsOpen(evidence), diagnosis_);
  }

  // Where structure is left: the choice again, by what readings that remember each other are worth.
  void ChooseBesideStructure(Evidence& evidence) {
    const double memory = MemoryOf(WhitenedOf(bench_, Chosen().fit));
    const EffectSet before = Chosen().effects;
    const Fit base = base_->fit;
    Reweigh(bench_.data, bench_.tight, memory, search_.contenders);
    search_.chosen = StandingBesideSubsets(bench_.data, bench_.tight, memory, search_.contenders);
    base_ = &search_.contenders[search_.base];
    Weigh(memory, evidence);
    search_.contenders[search_.base].fit = base;  // what it leaves is told of its least squares
    KeepEstablished(evidence);
    if (!evidence.complete || (evidence.imitated && Chosen().effects == before)) return;
    evidence.imitated = false;
    rival_ = {};
    const Verdict again = JudgeBesideStructure(evidence);
    if (again == Verdict::kUnexplained) return;
    evidence.imitated = IsImitated();
    if (!evidence.imitated) diagnosis_.verdict = again;
  }

  // A term for what is left, beside the chosen set where that is established; whether it is shows
  // by what a term does without it.
  LearnedModel Learn(bool open, bool& established) {
    Progress(0.95, "what is left unexplained");
    const Fit& chosen = Chosen().fit;
    LearnedModel learned =
        LearnDiscrepancy(bench_.data, open ? chosen : base_->fit, bench_.held_out, bench_.tight);
    if (!established || open) return learned;
    established = false;
    if (Stopped() || IsNoise(LeftoverOf(bench_, learned.fit, false))) return learned;
    LearnedModel beside = LearnDiscrepancy(bench_.data, chosen, bench_.held_out, bench_.tight);
    established = beside.fit.bic < learned.fit.bic - kAccept ||
                  HoldsAll(learned.discrepancy, Chosen().effects);
    return established ? beside : learned;
  }

  // Why the chosen set, or the tie of sets, may not be named; empty where it may. Sets that do
  // better when the readings are changed, and account for as much, join it as a tie.
  std::string DoubtOfNames(Evidence& evidence) {
    Progress(0.94, "whether names hold");
    const Stability found = StabilityOf(bench_, search_.contenders, tied_, memory_);
    diagnosis_.stability = found.changes;
    if (found.Holds()) return "";
    for (const Contender* other : found.beaten_by)
      if (std::none_of(tied_.begin(), tied_.end(),
                       [&](const Contender* one) { return IsNested(*one, *other); }))
        tied_.push_back(other);
    KeepEstablished(evidence);
    const bool joined = std::any_of(tied_.begin(), tied_.end(), [&](const Contender* one) {
      return std::count(found.beaten_by.begin(), found.beaten_by.end(), one) > 0;
    });
    if (!joined) diagnosis_.verdict = Verdict::kUnexplained;
    if (diagnosis_.verdict == Verdict::kExplained) diagnosis_.verdict = Verdict::kTie;
    return joined && !evidence.imitated ? "" : "does not hold when the readings are changed";
  }

  void Propose() {
    Progress(0.96, "a run that would decide");
    Proposal proposal = ProposalFor(bench_, tied_, by_the_clock_);
    diagnosis_.next_experiment = std::move(proposal.experiment);
    diagnosis_.no_experiment = std::move(proposal.why_none);
    if (!proposal.caution.empty()) diagnosis_.warnings.push_back(std::move(proposal.caution));
  }

  const Contender& Chosen() const { return search_.contenders[search_.chosen]; }

  // A learned term does better than the effects chosen, or as well with fewer numbers.
  bool IsImitated() {
    if (Chosen().effects.empty() || Stopped()) return false;
    Progress(0.94, "what else would do as well");
    rival_ = RivalOf(bench_.data, base_->fit, Chosen().fit, bench_.tight);
    return rival_.instead;
  }

  // Beside structure a set of a tie must account for most of the residual itself: among few
  // readings of little worth one that does nothing comes near.
  void KeepEstablished(Evidence& evidence) {
    std::erase_if(tied_, [&](const Contender* one) {
      if (one == &Chosen()) return false;
      return UnexplainedFraction(evidence.before, LeftoverOf(bench_, one->fit, false)) >
             kEstablished;
    });
    evidence.tied = static_cast<int>(tied_.size()) - 1;
  }

  // What the chosen set leaves and what does as well, by residuals that are worth 1/memory of their
  // number.
  void Weigh(double memory, Evidence& evidence) {
    evidence.accepted = &Chosen() != base_;
    evidence.after =
        evidence.accepted ? LeftoverOf(bench_, Chosen().fit, !Stopped()) : evidence.before;
    memory_ = memory;
    tied_ = TiedWith(bench_, search_.contenders, Chosen(), memory, kTie);
    evidence.tied = static_cast<int>(tied_.size()) - 1;
    if (Stopped()) evidence.complete = false;
  }

  DiagnoseOptions options_;  // asks Stopped
  const std::function<bool()> cancelled_;
  const Clock::time_point start_ = Clock::now();
  mutable std::atomic<bool> stopped_ = false;
  ForwardModel forward_;
  std::vector<ObservedRun> observed_;
  Bench bench_;
  SearchResult search_;
  const Contender* base_ = nullptr;
  std::vector<const Contender*> tied_;  // the chosen set first
  double memory_ = 1.0;                 // of the residuals that the choice was made by
  Rival rival_;                         // of the chosen set
  Fit by_the_clock_;                    // usable if the clock of the only run does as well as they
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
