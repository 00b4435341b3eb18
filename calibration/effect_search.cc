#include "calibration/effect_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <thread>

#include "calibration/parallel.h"
#include "calibration/thresholds.h"

namespace plenum::calibration {
namespace {

using Spec = const model::EffectSpec*;
using Set = std::vector<Spec>;

constexpr std::size_t kFinalSteps = 30'000;
constexpr double kSameOptimum = 1.0;  // χ² apart
// Fits that only have to be compared end where χ² falls by less than this share, at most after so
// many steps; those near the best are then taken further.
constexpr double kScreening = 1e-4;
constexpr int kScreeningIterations = 12;
// After so many steps only those go on that explain at least this share of what the best one does
// beyond the smaller set, and the very best.
constexpr int kFirstLook = 5;
constexpr double kHopeful = 0.5;
constexpr std::size_t kAlwaysOn = 6;
constexpr double kNear = 20.0;       // of BIC
constexpr double kNearShare = 0.02;  // of what the best set gains over the base model
constexpr double kNever = std::numeric_limits<double>::infinity(), kClocksAreAll = -kNever;
constexpr int kTriplesFrom = 1;  // best pairs

std::size_t Place(Spec spec) {
  const auto all = model::Effects();
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), spec) - all.begin());
}

Set Ordered(Set set) {
  std::sort(set.begin(), set.end(), [](Spec a, Spec b) { return Place(a) < Place(b); });
  return set;
}

// Whether the data exercise what an effect acts on: a valve that never opens tells nothing of
// itself, of its line and of what feeds it, and a blocked actuator nothing of its volume.
bool Exercised(const model::EffectSpec& spec, const std::vector<Run>& runs) {
  using enum model::EffectPlace;
  const auto opens = [](const Run& run) {
    return std::any_of(run.valve.begin(), run.valve.end(), [](const model::ValveCommand& command) {
      return command.state != model::ValveState::kHold;
    });
  };
  const bool fed = spec.place == kValve || spec.place == kLine || spec.place == kSupply;
  return !fed || std::any_of(runs.begin(), runs.end(), opens);
}

// The effects that have a name, of which the data can tell; learned terms stand for what has none
// (discrepancy.h).
std::vector<Spec> NamedEffects(const FitData& data) {
  std::vector<Spec> named;
  for (const Spec spec : model::Effects())
    if (!spec->id.starts_with("learned") && Exercised(*spec, data.forward->dataset().runs))
      named.push_back(spec);
  return named;
}

bool HoldsId(const Set& set, std::string_view id) {
  return std::any_of(set.begin(), set.end(), [&](Spec spec) { return spec->id == id; });
}

// Effects that shift strokes in time, as a clock does.
bool ActsInTime(const model::EffectSpec& spec) {
  for (const std::string_view id : {"valve_delay", "valve_ramp", "sensor_lag", "line_dynamics"})
    if (spec.id == id) return true;
  return false;
}

class Search {
 public:
  Search(const FitData& data, const SearchOptions& options,
         const std::function<bool(const Fit&)>& enough)
      : options_(options), enough_(enough) {
    result_.data = data;
    fit_options_.cancelled = options.cancelled;
    fit_options_.function_tolerance = kScreening;
    fit_options_.iterations_max = kScreeningIterations;
  }

  SearchResult Run() {
    Compare();
    if (!ClocksAreOff()) return std::move(result_);
    SearchResult without = result_;
    UseClocks();
    Compare();
    if (!Cancelled()) return std::move(result_);
    without.complete = false;
    return without;
  }

 private:
  struct Job {
    Set set;
    ModelState start;
    double bic_before = 0.0;  // of the smaller set
    Fit fit = {};
  };

  // All sets as deep as need be, and the choice among them.
  void Compare() {
    std::optional<std::size_t> chosen = Grow();
    if (!chosen) {  // again, with each run's clock fitted
      const SearchResult without = result_;
      UseClocks();
      chosen = Grow();
      if (Cancelled()) result_ = without, chosen = 0;
    }
    if (Of(*chosen).effects.size() > 1u && LeftShare(Of(*chosen)) < kEstablished && !Cancelled()) {
      const int size = static_cast<int>(Of(*chosen).effects.size());
      Shrink(Of(*chosen).effects);
      Exchange(Of(*chosen).effects);
      chosen = Best(size);
    }
    Finish(static_cast<int>(Of(*chosen).effects.size()));
  }

  void UseClocks() {
    result_.data.clocks = true;
    result_.contenders.clear();
  }

  // Whether the chosen set, fitted to the end, gains by the runs' clocks what none of its own
  // numbers can take up: small errors of the clocks hide beside an effect that leaves little.
  bool ClocksAreOff() const {
    const Fit& chosen = Of(result_.chosen).fit;
    if (result_.data.clocks || Cancelled() || !chosen.Usable()) return false;
    FitData data = result_.data;
    data.clocks = true;
    const Fit with = FitModel(data, chosen.state, Tight());
    return with.Usable() && with.bic + ClocksCost(data, with, Tight()) < chosen.bic - kClock;
  }

  // Sets forwards from the base model, and the best of them; none where the clocks are found off.
  std::optional<std::size_t> Grow() {
    FitBase();
    std::size_t chosen = 0;
    for (int size = 1; size <= kEffectsMax && !Cancelled(); ++size) {
      if (size > 1 && enough_(Of(chosen).fit)) break;
      const double clocks_bic = WithClocks(chosen);
      if (clocks_bic == kClocksAreAll) return {};
      if (size > 2 && LeftShare(Of(chosen)) > kEstablished) break;
      if (size == 1) {
        FitSingles();
      } else {
        ExtendSets(Seeds(size - 1), size);
        TryLaws(size);
      }
      const Contender* best = BestOfSize(size);
      if (clocks_bic < std::min(best ? best->fit.bic : kNever, Of(chosen).fit.bic) - kClock)
        return {};
      if (!best || !(best->fit.bic < Of(chosen).fit.bic - kAccept)) break;
      chosen = IndexOf(*best);
    }
    return chosen;
  }

  const Contender& Of(std::size_t i) const { return result_.contenders[i]; }
  const Contender& Base() const { return result_.contenders.front(); }
  std::size_t IndexOf(const Contender& contender) const {
    return static_cast<std::size_t>(&contender - result_.contenders.data());
  }
  // Variance above the noise over that of the base model.
  double LeftShare(const Contender& contender) const {
    const auto above = [](const Fit& fit) {
      return std::max(0.0, fit.chi2_data / static_cast<double>(fit.rows) - 1.0);
    };
    return above(contender.fit) / std::max(above(Base().fit), 1e-300);
  }
  bool Cancelled() const { return options_.cancelled && options_.cancelled(); }

  void Report(double share, const std::string& what) const {
    if (options_.progress) options_.progress(share, what);
  }

  // Of the contenders with that many effects; null if none could be fitted.
  const Contender* BestOfSize(int size) const {
    const Contender* best = nullptr;
    for (const Contender& contender : result_.contenders) {
      if (contender.effects.size() != static_cast<std::size_t>(size) || !contender.fit.Usable())
        continue;
      if (!best || contender.fit.bic < best->fit.bic) best = &contender;
    }
    return best;
  }
  std::size_t Best(int size) const {
    const Contender* best = BestOfSize(size);
    return best ? IndexOf(*best) : 0;
  }

  Contender* Find(const Set& set) {
    for (Contender& contender : result_.contenders)
      if (contender.effects == set) return &contender;
    return nullptr;
  }

  void FitBase() {
    Report(0.02, "base model");
    Contender base;
    FitOptions options = fit_options_;
    options.threads = options_.threads;
    base.fit = FitModel(result_.data, result_.data.forward->Declared(), options);
    base.starts = base.found_again = 1;
    result_.contenders.push_back(std::move(base));
  }

  void FitSingles() {
    std::vector<Job> jobs;
    for (const Spec spec : NamedEffects(result_.data)) AddJobs(Base(), spec, jobs);
    RunJobs(jobs, 0.05, 0.4, "single effects");
  }

  // The set of `from` with one more effect, from each of its starts; none if it has been fitted.
  void AddJobs(const Contender& from, Spec added, std::vector<Job>& jobs) {
    if (HoldsId(from.effects, added->id)) return;
    Set set = from.effects;
    set.push_back(added);
    set = Ordered(set);
    const auto planned = [&](const Job& job) { return job.set == set; };
    if (Find(set) || std::any_of(jobs.begin(), jobs.end(), planned)) return;
    for (const model::Effect& start : EffectStarts(*added, result_.data.sizes)) {
      Job job{set, from.fit.state, from.fit.bic};
      if (!PriorsHold(from.fit)) job.start.factor = result_.data.forward->Declared().factor;
      job.start.effects.push_back(start);
      std::sort(job.start.effects.begin(), job.start.effects.end(),
                [](const auto& a, const auto& b) { return Place(a.spec) < Place(b.spec); });
      jobs.push_back(std::move(job));
    }
  }

  // Fits all from their starts: a few steps each at first, and to the end what may matter.
  void RunJobs(std::vector<Job>& jobs, double from_share, double to_share,
               const std::string& what) {
    if (jobs.empty()) return;
    std::vector<Job*> all;
    for (Job& job : jobs) all.push_back(&job);
    const double middle = 0.5 * (from_share + to_share);
    FitOptions first = fit_options_;
    first.iterations_max = kFirstLook;
    Continue(all, first, from_share, middle, what);
    FitOptions rest = fit_options_;
    rest.iterations_max -= kFirstLook;
    Continue(Hopeful(all), rest, middle, to_share, what);
    const std::size_t size = jobs.front().set.size();
    for (Job& job : jobs) Take(std::move(job));
    Refine(size);
  }

  void Continue(const std::vector<Job*>& jobs, const FitOptions& options, double from_share,
                double to_share, const std::string& what) {
    std::atomic<std::size_t> done = 0;
    std::mutex reporting;
    ForAll(jobs.size(), options_.threads, [&](std::size_t i) {
      if (Cancelled()) return;
      Fit fit = FitModel(result_.data, jobs[i]->start, options);
      if (fit.Usable()) jobs[i]->start = fit.state;
      if (fit.Usable() || !jobs[i]->fit.Usable()) jobs[i]->fit = std::move(fit);
      const double share = static_cast<double>(++done) / static_cast<double>(jobs.size());
      const std::lock_guard lock(reporting);
      Report(from_share + share * (to_share - from_share), what);
    });
  }

  // Those that have not converged but may still matter.
  std::vector<Job*> Hopeful(std::vector<Job*> jobs) const {
    std::erase_if(jobs, [](const Job* job) { return !job->fit.Usable(); });
    if (jobs.empty()) return jobs;
    std::stable_sort(jobs.begin(), jobs.end(),
                     [](const Job* a, const Job* b) { return a->fit.bic < b->fit.bic; });
    const double best = jobs.front()->fit.bic;
    const double gain = std::max(0.0, jobs.front()->bic_before - best);
    std::vector<Job*> hopeful;
    for (std::size_t k = 0; k < jobs.size(); ++k) {
      const bool may_matter = k < kAlwaysOn || jobs[k]->fit.bic < best + kNear + kHopeful * gain;
      if (may_matter && jobs[k]->fit.status == FitStatus::kIterationsSpent)
        hopeful.push_back(jobs[k]);
    }
    return hopeful;
  }

  // Takes the fits of sets of a size further that come near the best one, or are among the best and
  // have not ended.
  void Refine(std::size_t size) {
    const Contender* best = BestOfSize(static_cast<int>(size));
    if (!best) return;
    const double reach =
        std::max(kNear, kNearShare * std::max(0.0, Base().fit.bic - best->fit.bic));
    std::vector<Contender*> sorted;
    for (Contender& contender : result_.contenders)
      if (contender.effects.size() == size && contender.fit.Usable()) sorted.push_back(&contender);
    std::sort(sorted.begin(), sorted.end(),
              [](const auto* a, const auto* b) { return a->fit.bic < b->fit.bic; });
    std::vector<Contender*> near;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
      const bool unfinished = k < kAlwaysOn && sorted[k]->fit.status == FitStatus::kIterationsSpent;
      const bool close = sorted[k]->fit.bic < best->fit.bic + reach;
      if (!sorted[k]->refined && (unfinished || close)) near.push_back(sorted[k]);
    }
    FitOptions further = fit_options_;
    further.function_tolerance = 0.01 * kScreening;
    further.iterations_max = 3 * kScreeningIterations;
    ForAll(near.size(), options_.threads, [&](std::size_t i) {
      Fit fit = FitModel(result_.data, near[i]->fit.state, further);
      near[i]->refined = fit.status != FitStatus::kIterationsSpent;
      if (fit.Usable() && fit.bic < near[i]->fit.bic) near[i]->fit = std::move(fit);
    });
  }

  void Take(Job job) {
    Contender* contender = Find(job.set);
    if (!contender) {
      result_.contenders.push_back({job.set, {}, 0, 0});
      contender = &result_.contenders.back();
    }
    ++contender->starts;
    if (!job.fit.Usable()) {
      if (contender->starts == 1) contender->fit = std::move(job.fit);
      return;
    }
    const auto chi2 = [](const Fit& fit) { return fit.chi2_data + fit.chi2_prior; };
    if (!contender->fit.Usable() || chi2(job.fit) < chi2(contender->fit) - kSameOptimum) {
      contender->fit = std::move(job.fit);
      contender->refined = false;
      contender->found_again = 1;
    } else if (chi2(job.fit) < chi2(contender->fit) + kSameOptimum) {
      ++contender->found_again;
      if (chi2(job.fit) < chi2(contender->fit)) contender->fit = std::move(job.fit);
    }
  }

  // The best sets of a size, of each id the best law alone.
  std::vector<Set> Seeds(int size) const {
    std::vector<const Contender*> sorted;
    for (const Contender& contender : result_.contenders)
      if (contender.effects.size() == static_cast<std::size_t>(size) && contender.fit.Usable())
        sorted.push_back(&contender);
    std::sort(sorted.begin(), sorted.end(),
              [](const auto* a, const auto* b) { return a->fit.bic < b->fit.bic; });
    std::vector<const Contender*> kept;
    for (const Contender* contender : sorted) {
      const bool known = std::any_of(kept.begin(), kept.end(), [&](const Contender* other) {
        return SameEffects(*contender, *other);
      });
      if (!known) kept.push_back(contender);
      if (static_cast<int>(kept.size()) == (size == 1 ? kSeeds : kTriplesFrom)) break;
    }
    std::vector<Set> seeds;
    for (const Contender* contender : kept) seeds.push_back(contender->effects);
    return seeds;
  }

  // Of an id with several laws the one whose single fit is best.
  std::vector<Spec> BestLaws() {
    std::vector<Spec> best;
    for (const Spec spec : NamedEffects(result_.data)) {
      const Contender* single = Find({spec});
      if (!single || !single->fit.Usable()) continue;
      const auto same =
          std::find_if(best.begin(), best.end(), [&](Spec other) { return other->id == spec->id; });
      if (same == best.end())
        best.push_back(spec);
      else if (single->fit.bic < Find({*same})->fit.bic)
        *same = spec;
    }
    return best;
  }

  void ExtendSets(const std::vector<Set>& seeds, int size) {
    std::vector<Job> jobs;
    for (const Set& seed : seeds)
      for (const Spec spec : BestLaws()) AddJobs(*Find(seed), spec, jobs);
    const double from = size == 2 ? 0.4 : 0.7;
    RunJobs(jobs, from, from + 0.2, size == 2 ? "pairs of effects" : "triples of effects");
  }

  // The other laws of each member of the best set of a size: which law stands shows only once the
  // other effects are there.
  void TryLaws(int size) {
    if (!BestOfSize(size)) return;
    const Contender best = *BestOfSize(size);
    std::vector<Job> jobs;
    for (const Spec member : best.effects) {
      Contender rest = best;
      std::erase(rest.effects, member);
      rest.fit.state = StateOf(best, rest.effects);
      for (const Spec spec : NamedEffects(result_.data))
        if (spec != member && spec->id == member->id) AddJobs(rest, spec, jobs);
    }
    RunJobs(jobs, 0.6, 0.7, "laws");
  }

  static Set Without(const Set& set, Spec out) {
    Set rest = set;
    std::erase(rest, out);
    return rest;
  }

  // Backwards: the sets with one member less, from where the larger set came to. A smaller set that
  // was cut short, or caught beside its optimum, must not make a member look needed. By value, here
  // and in Exchange: the contenders that the set comes from move.
  void Shrink(Set set) {
    std::vector<Job> jobs;
    for (const Spec out : set) {
      const Set rest = Without(set, out);
      jobs.push_back({rest, StateOf(*Find(set), rest), Base().fit.bic});
    }
    RunJobs(jobs, 0.85, 0.87, "smaller sets");
  }

  // Every set that differs from this one in one member.
  void Exchange(Set set) {
    std::vector<Job> jobs;
    for (const Spec out : set) {
      const Contender* from = Find(Without(set, out));
      if (!from->fit.Usable()) continue;
      const Contender seed = *from;
      for (const Spec spec : BestLaws()) AddJobs(seed, spec, jobs);
    }
    RunJobs(jobs, 0.87, 0.92, "sets alike");
  }

  // The fitted state with only the effects of `rest`.
  static ModelState StateOf(const Contender& contender, const Set& rest) {
    ModelState state = contender.fit.state;
    std::erase_if(state.effects, [&](const model::Effect& effect) {
      return std::find(rest.begin(), rest.end(), effect.spec) == rest.end();
    });
    return state;
  }

  // What the clocks cost in units of BIC: minus twice the logarithm of the share of their prior
  // that the data leave, which is their term of the marginal likelihood (Laplace).
  static double ClocksCost(const FitData& data, const Fit& fit, const FitOptions& options) {
    const Eigen::MatrixXd covariance = Covariance(data, fit, options);
    double cost = 0.0;
    for (std::size_t j = 0; j < fit.coordinates.size(); ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      if (fit.coordinates[j].parameter.kind == Parameter::Kind::kClock)
        cost -= std::log(covariance(at, at));
    }
    return cost;
  }

  // BIC of a set with the runs' clocks fitted. kClocksAreAll where that leaves nothing, and one
  // effect more that acts in time does not do as well: there is no need to try all effects.
  double WithClocks(std::size_t set) {
    if (result_.data.clocks || Cancelled() || !Of(set).fit.Usable()) return kNever;
    FitData data = result_.data;
    data.clocks = true;
    FitOptions options = fit_options_;
    options.function_tolerance = 0.01 * kScreening;
    options.iterations_max = 3 * kScreeningIterations;
    options.threads = options_.threads;
    const Fit with = FitModel(data, Of(set).fit.state, options);
    if (!with.Usable()) return kNever;
    const double bic = with.bic + ClocksCost(data, with, options);
    if (!(bic < Of(set).fit.bic) || !enough_(with)) return bic;
    std::vector<Job> jobs;
    const Contender from = Of(set);
    for (const Spec spec : NamedEffects(result_.data))
      if (ActsInTime(*spec)) AddJobs(from, spec, jobs);
    RunJobs(jobs, 0.05, 0.1, "clocks");
    const bool rivalled = std::any_of(
        result_.contenders.begin(), result_.contenders.end(), [&](const Contender& other) {
          return other.effects.size() == from.effects.size() + 1 && other.fit.Usable() &&
                 Contains(other, from) && other.fit.bic < bic;
        });
    return rivalled ? bic : kClocksAreAll;
  }

  FitOptions Tight() const {
    FitOptions tight = fit_options_;
    tight.noise_share = 1e-3;
    tight.steps_max = kFinalSteps;
    tight.function_tolerance = 1e-9;
    tight.iterations_max = 100;
    tight.threads = options_.threads;
    return tight;
  }

  // The best sets of each size up to the one that the search came to are fitted to the last digit;
  // then the choice is made again, because a fit cut short may have made a larger set look needed.
  void Finish(int size_max) {
    Report(0.92, "final fits");
    const FitOptions tight = Tight();
    for (int size = 0; size <= size_max; ++size) {
      const double best = Of(Best(size)).fit.bic;
      const double reach = size == size_max ? 2.0 * kTie : kSameOptimum;
      for (Contender& contender : result_.contenders) {
        if (contender.effects.size() != static_cast<std::size_t>(size)) continue;
        if (!contender.fit.Usable() || contender.fit.bic > best + reach) continue;
        Fit fit = FitModel(result_.data, contender.fit.state, tight);
        if (fit.Usable() && fit.bic < contender.fit.bic + kSameOptimum)
          contender.fit = std::move(fit);
      }
    }
    std::stable_sort(result_.contenders.begin(), result_.contenders.end(),
                     [](const Contender& a, const Contender& b) {
                       if (a.fit.Usable() != b.fit.Usable()) return a.fit.Usable();
                       return a.fit.bic < b.fit.bic;
                     });
    result_.complete = !Cancelled();
    for (std::size_t i = 0; i < result_.contenders.size(); ++i)
      if (result_.contenders[i].effects.empty()) result_.base = i;
    result_.chosen = result_.base;
    for (int size = 1; size <= size_max; ++size) {
      const Contender* best = BestOfSize(size);
      if (best && best->fit.bic < Of(result_.chosen).fit.bic - kAccept)
        result_.chosen = IndexOf(*best);
    }
  }

  const SearchOptions& options_;
  const std::function<bool(const Fit&)>& enough_;
  FitOptions fit_options_;
  SearchResult result_;
};

}  // namespace

bool Contains(const Contender& outer, const Contender& inner) {
  return std::all_of(inner.effects.begin(), inner.effects.end(),
                     [&](Spec spec) { return HoldsId(outer.effects, spec->id); });
}

bool SameEffects(const Contender& a, const Contender& b) {
  return a.effects.size() == b.effects.size() && Contains(a, b);
}

SearchResult SearchEffects(const FitData& data, const SearchOptions& options,
                           const std::function<bool(const Fit&)>& enough) {
  return Search(data, options, enough).Run();
}

}  // namespace plenum::calibration
