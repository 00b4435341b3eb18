#include "calibration/search/effect_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

using Job = Contenders::Job;
using Spec = const model::EffectSpec*;

constexpr double kNever = std::numeric_limits<double>::infinity(), kClocksAreAll = -kNever;
constexpr std::size_t kTriplesFrom = 1;  // best pairs
constexpr std::size_t kMoreSeeds = 6;    // singles that pairs are built on before triples are
constexpr std::size_t kLeaders = 10;     // of each size

class Search {
 public:
  Search(const FitData& data, const SearchOptions& options,
         const std::function<bool(const Fit&)>& enough)
      : options_(options),
        enough_(enough),
        sets_(data, options),
        other_sets_(data, options),
        may_be_off_(options.clocks_may_be_off) {}

  SearchResult Run(const SearchResult& earlier) {
    SearchResult result = CompareAfter(earlier);
    if (sets_.data.clocks ? !ActsInTimeInstead(result) : !ClocksAreOff(result)) return result;
    may_be_off_ = !sets_.data.clocks;
    UseClocks(may_be_off_);
    SearchResult other = CompareAfter(result);
    if (!sets_.Cancelled()) return other;
    result.complete = false;
    return result;
  }

 private:
  SearchResult CompareAfter(const SearchResult& earlier) {
    sets_.earlier = earlier.contenders;
    if (earlier.complete && !earlier.enough) {
      SearchResult leaders = CompareLeaders();
      if (!leaders.enough || sets_.Cancelled()) return leaders;
    }
    return Compare();
  }

  // The leading sets of the search before, and the choice among them.
  SearchResult CompareLeaders() {
    if (sets_.list.empty()) sets_.FitBase();
    std::size_t chosen = 0;
    for (int size = 1; size <= kEffectsMax && !sets_.Cancelled(); ++size) {
      std::vector<Job> jobs = LeadersOf(size);
      sets_.RunJobs(jobs, 0.05, 0.9, "leading sets of effects");
      const std::optional<std::size_t> best = sets_.Best(size);
      if (!best || !(sets_[*best].fit.bic < sets_[chosen].fit.bic - kAccept)) break;
      chosen = *best;
    }
    return Finish(static_cast<int>(sets_[chosen].effects.size()));
  }

  std::vector<Job> LeadersOf(int size) const {
    std::vector<Job> jobs;
    for (const Contender& known : sets_.earlier) {  // by BIC
      if (known.effects.size() != static_cast<std::size_t>(size) || !known.fit.Usable()) continue;
      jobs.push_back({known.effects, known.fit.state, sets_.Base().fit.bic});
      jobs.back().start.clock_s = sets_.Base().fit.state.clock_s;
      if (jobs.size() == kLeaders) break;
    }
    return jobs;
  }

  // All sets as deep as need be, and the choice among them.
  SearchResult Compare() {
    std::optional<std::size_t> chosen = Grow();
    if (!chosen) {  // again, with each run's clock fitted
      UseClocks(true);
      sets_.earlier = other_sets_.list;
      chosen = Grow();
      if (sets_.Cancelled()) UseClocks(false), chosen = 0;
    }
    const EffectSet set = sets_[*chosen].effects;
    const int size = static_cast<int>(set.size());
    if (size > 1 && sets_.LeftShare(sets_[*chosen]) < kEstablished && !sets_.Cancelled()) {
      Shrink(set);
      Exchange(set);
      // An exchange may have come to an optimum that a smaller set missed, and that to one that a
      // still smaller set missed.
      const EffectSet better = LeaderOf(size, set);
      if (better != set) Shrink(better);
      for (int smaller = size - 1; smaller > 1; --smaller)
        if (const auto leader = sets_.Best(smaller)) Shrink(EffectSet(sets_[*leader].effects));
    }
    if (size > 1 && !sets_.Cancelled()) FitAlone(LeaderOf(size, set));
    if (size > 0) CarryNumbers(LeaderOf(size, set));
    return Finish(size);
  }

  // The best set of a size that may be named.
  EffectSet LeaderOf(int size, const EffectSet& otherwise) const {
    const std::optional<std::size_t> leader = sets_.Best(size);
    return leader ? sets_[*leader].effects : otherwise;
  }

  // A line of the wrong length leaves what other effects beside it may take up: before it is called
  // in need of them, its lengths are tried without.
  void FitAlone(const EffectSet& set) {
    const double goal = sets_.Find(set)->fit.bic;
    for (const Spec spec : set)
      if (Contender* alone = sets_.Find({spec})) sets_.FitInStep(*alone, goal);
  }

  // Where runs confirm each other the clocks must do better than effects by kClock. In a single run
  // a clock that is off and a stroke that is late are one, and the effect claims more: there it
  // must do better by as much.
  double EffectAhead() const { return IsOneRecording(sets_.data) ? 2.0 * kClock : 0.0; }

  bool MaySeekClocks() const { return may_be_off_ && !sets_.data.clocks && !sets_.Cancelled(); }

  // Sets fitted the other way are kept: a search that comes back to it goes on from them.
  void UseClocks(bool use) {
    std::swap(sets_, other_sets_);
    sets_.data.clocks = use;
  }

  // Whether the chosen set, fitted to the end, gains by the runs' clocks what none of its own
  // numbers can take up: small errors of the clocks hide beside an effect that leaves little. Or
  // whether it leaves nothing, and does better with the clocks in the place of one of its effects.
  // Or whether the clocks do instead of its effects that act in time: those may have come to the
  // set before the clocks were tried beside the others.
  bool ClocksAreOff(const SearchResult& result) const {
    const Contender& chosen = result.contenders[result.chosen];
    if (!MaySeekClocks() || !chosen.fit.Usable()) return false;
    const double bic = chosen.fit.bic;
    if (BicByClocks(chosen, chosen.effects) < bic - kClock) return true;
    if (result.enough && ClocksReplaceOne(chosen)) return true;
    EffectSet timeless = chosen.effects;
    std::erase_if(timeless, [](Spec spec) { return ActsInTime(*spec); });
    if (timeless.empty() || timeless.size() == chosen.effects.size()) return false;
    const double ahead = AnyTimingDoes(result, timeless) ? kTie : EffectAhead() - kClock;
    return BicByClocks(chosen, timeless) < bic + ahead;
  }

  // While sets grew the clocks were compared by fits cut short.
  bool ClocksReplaceOne(const Contender& chosen) const {
    return std::any_of(chosen.effects.begin(), chosen.effects.end(), [&](Spec out) {
      return BicByClocks(chosen, Without(chosen.effects, out)) < chosen.fit.bic - kClock;
    });
  }

  // Of that part of a set, with the clocks fitted.
  double BicByClocks(const Contender& contender, const EffectSet& part) const {
    FitData data = sets_.data;
    data.clocks = true;
    Fit with = FitModel(data, StateOf(contender, part), sets_.Tight());
    Narrow(data, sets_.Tight(), with);
    return with.Usable() ? with.bic + ClocksCost(data, with, sets_.Tight()) : kNever;
  }

  // Whether several sets do as well that differ from the chosen one in effects that act in time
  // alone: then no more is seen of any of them than that strokes are late.
  static bool AnyTimingDoes(const SearchResult& result, const EffectSet& timeless) {
    const Contender& chosen = result.contenders[result.chosen];
    return std::any_of(
        result.contenders.begin(), result.contenders.end(), [&](const Contender& other) {
          EffectSet rest = other.effects;
          std::erase_if(rest, [](Spec spec) { return ActsInTime(*spec); });
          return other.effects.size() == chosen.effects.size() && !SameEffects(other, chosen) &&
                 rest == timeless && other.fit.Usable() && other.fit.bic < chosen.fit.bic + kTie;
        });
  }

  // Whether an effect that acts in time does better than the clocks beside the chosen set: clocks
  // may have been taken to be off while much else was still unexplained. What the search without
  // them has compared is not fitted anew.
  bool ActsInTimeInstead(const SearchResult& result) {
    const EffectSet& effects = result.contenders[result.chosen].effects;
    const Fit& chosen = result.contenders[result.chosen].fit;
    if (sets_.Cancelled() || !chosen.Usable()) return false;
    FitOptions look = sets_.Screening(), options = sets_.Further();
    look.threads = options.threads = options_.threads;
    FitData data = sets_.data;
    data.clocks = false;
    const double bic = chosen.bic + ClocksCost(sets_.data, chosen, options) - EffectAhead();
    ModelState start = chosen.state;
    std::fill(start.clock_s.begin(), start.clock_s.end(), 0.0);
    std::optional<Fit> without;
    for (const Spec spec : Named()) {
      if (!ActsInTime(*spec) || HoldsId(effects, spec->id)) continue;
      if (const Contender* known = other_sets_.Find(With(effects, spec))) {
        if (known->fit.Usable() && known->fit.bic < bic) return true;
        continue;
      }
      if (!without) without = FitModel(data, start, options);
      ModelState late = start;
      late.effects.push_back(EffectStarts(*spec, data.sizes).front());
      Fit fit = FitModel(data, late, look);
      if (!fit.Usable() || !MayComeTo(bic, fit, without->Usable() ? without->bic : kNever))
        continue;
      fit = FitModel(data, fit.state, options);
      Narrow(data, options, fit);
      if (fit.Usable() && fit.bic < bic) return true;
    }
    return false;
  }

  // Sets forwards from the base model, and the best of them; none where the clocks are found off.
  std::optional<std::size_t> Grow() {
    if (sets_.list.empty()) sets_.FitBase();
    std::size_t chosen = 0;
    for (int size = 1; size <= kEffectsMax && !sets_.Cancelled(); ++size) {
      // The clocks before more pairs: they are one fit, those are many.
      const std::size_t before = chosen;
      const double bic_before = sets_[chosen].fit.bic;
      const bool done = size > 1 && enough_(sets_[chosen].fit);
      double clocks_bic = done ? kNever : WithClocks(chosen);
      if (clocks_bic == kClocksAreAll) return {};
      if (size > 2 && !done) chosen = OfMorePairs(chosen);
      const bool better = chosen != before || sets_[chosen].fit.bic < bic_before;
      if (done || (better && enough_(sets_[chosen].fit))) {
        TryMoreOfFewerNumbers(sets_[chosen].effects);
        if (sets_.data.clocks) TryTiming(chosen, sets_[chosen].fit.bic - kAccept);
        const std::size_t other = sets_.Best(size).value_or(chosen);
        if (sets_[other].fit.bic < sets_[chosen].fit.bic - kAccept) chosen = other;
        break;
      }
      if (better) clocks_bic = WithClocks(chosen);
      if (clocks_bic == kClocksAreAll) return {};
      if (size > 2 && sets_.LeftShare(sets_[chosen]) > kEstablished) break;
      if (size == 1) {
        FitSingles();
      } else {
        ExtendSets(size, SeedsOf(size - 1));
        TryLaws(size);
      }
      const std::optional<std::size_t> best = sets_.Best(size);
      const double best_bic = best ? sets_[*best].fit.bic : kNever;
      const double chosen_bic = sets_[chosen].fit.bic;
      if (clocks_bic < std::min(best_bic + EffectAhead(), chosen_bic) - kClock) return {};
      if (!(best_bic < chosen_bic - kAccept)) break;
      chosen = *best;
    }
    return chosen;
  }

  EffectSet Named() const { return Nameable(sets_.data.forward->dataset()); }

  void FitSingles() {
    std::vector<Job> jobs;
    for (const Spec spec : Named()) sets_.AddJobs(sets_.Base(), spec, jobs);
    sets_.RunJobs(jobs, 0.05, 0.4, "single effects");
  }

  // The best pair, where it leaves structure after pairs with further singles: an effect that other
  // effects imitate better than it does alone may do with the right one beside it.
  std::size_t OfMorePairs(std::size_t pair) {
    if (sets_.LeftShare(sets_[pair]) > kEstablished) return pair;
    ExtendSets(2, kMoreSeeds);
    return sets_.Best(2).value_or(pair);
  }

  static std::size_t SeedsOf(int size) { return size == 1 ? kSeeds : kTriplesFrom; }

  // The best sets of a size, of each id the best law alone.
  std::vector<EffectSet> Seeds(int size, std::size_t count) const {
    std::vector<std::size_t> kept;
    for (const std::size_t i : sets_.Sorted(size)) {
      const bool known = std::any_of(kept.begin(), kept.end(), [&](std::size_t other) {
        return SameEffects(sets_[i], sets_[other]);
      });
      if (!known) kept.push_back(i);
      if (kept.size() == count) break;
    }
    std::vector<EffectSet> seeds(kept.size());
    for (std::size_t i = 0; i < kept.size(); ++i) seeds[i] = sets_[kept[i]].effects;
    return seeds;
  }

  // Of an id with several laws the one whose single fit is best.
  EffectSet BestLaws() {
    EffectSet best;
    for (const Spec spec : Named()) {
      const Contender* single = sets_.Find({spec});
      if (!single || !single->fit.Usable()) continue;
      const auto same =
          std::find_if(best.begin(), best.end(), [&](Spec other) { return other->id == spec->id; });
      if (same == best.end())
        best.push_back(spec);
      else if (single->fit.bic < sets_.Find({*same})->fit.bic)
        *same = spec;
    }
    return best;
  }

  void ExtendSets(int size, std::size_t seeds) {
    std::vector<Job> jobs;
    for (const EffectSet& seed : Seeds(size - 1, seeds))
      for (const Spec spec : BestLaws()) sets_.AddJobs(*sets_.Find(seed), spec, jobs);
    const double from = size == 2 ? 0.4 : 0.7;
    sets_.RunJobs(jobs, from, from + 0.2, size == 2 ? "pairs of effects" : "triples of effects");
  }

  // One effect of several numbers imitates two of fewer: where a set leaves nothing, those of one
  // effect more but no more numbers must not do better. They are grown from the others that explain
  // most.
  void TryMoreOfFewerNumbers(const EffectSet& set) {
    const int size = static_cast<int>(set.size());
    std::vector<Job> jobs;
    for (const EffectSet& seed : Seeds(size, SeedsOf(size))) {
      if (seed == set || sets_.LeftShare(*sets_.Find(seed)) > kEstablished) continue;
      for (const Spec spec : BestLaws())
        if (NumbersOf(With(seed, spec)) <= NumbersOf(set))
          sets_.AddJobs(*sets_.Find(seed), spec, jobs);
    }
    sets_.RunJobs(jobs, 0.4, 0.6, "more effects of fewer numbers");
  }

  // Clocks take up most of what effects do that act in time: what these leave are a few readings at
  // the start of each stroke, too few to show among all.
  void TryTiming(std::size_t set, double goal) {
    std::vector<Job> jobs;
    const Contender from = sets_[set];
    for (const Spec spec : Named())
      if (ActsInTime(*spec)) sets_.AddJobs(from, spec, jobs);
    const double share = from.effects.empty() ? 0.05 : 0.6;
    sets_.RunJobs(jobs, share, share, "clocks", goal);
  }

  // The other laws of each member of the best set of a size: which law stands shows only once the
  // other effects are there.
  void TryLaws(int size) {
    if (!sets_.Best(size)) return;
    const Contender best = sets_[*sets_.Best(size)];
    std::vector<Job> jobs;
    for (const Spec member : best.effects) {
      Contender rest = best;
      std::erase(rest.effects, member);
      rest.fit.state = StateOf(best, rest.effects);
      for (const Spec spec : Named())
        if (spec != member && spec->id == member->id) sets_.AddJobs(rest, spec, jobs);
    }
    sets_.RunJobs(jobs, 0.6, 0.7, "laws");
  }

  // Backwards: the sets with one member less, from where the larger set came to. A smaller set that
  // was cut short, or caught beside its optimum, must not make a member look needed.
  void Shrink(const EffectSet& set) {
    std::vector<Job> jobs;
    for (const Spec out : set) {
      const EffectSet rest = Without(set, out);
      jobs.push_back({rest, StateOf(*sets_.Find(set), rest), sets_.Base().fit.bic});
    }
    sets_.RunJobs(jobs, 0.85, 0.87, "smaller sets");
  }

  // Every set that differs from this one in one member.
  void Exchange(const EffectSet& set) {
    std::vector<Job> jobs;
    for (const Spec out : set) {
      const Contender* from = sets_.Find(Without(set, out));
      if (!from->fit.Usable()) continue;
      for (const Spec spec : BestLaws()) sets_.AddJobs(*from, spec, jobs);
    }
    sets_.RunJobs(jobs, 0.87, 0.92, "sets alike");
  }

  // Sets with an effect of fewer numbers in the place of one with which it shares some, from those:
  // where it is a limit of the other, as heat to a wall that stays warm is of heat to any wall, it
  // must not seem to do worse only because its own starts led elsewhere.
  void CarryNumbers(const EffectSet& set) {
    std::vector<Job> jobs;
    const Contender from = *sets_.Find(set);
    for (std::size_t k = 0; k < from.fit.state.effects.size(); ++k) {
      const EffectSet rest = Without(set, set[k]);
      for (const Spec spec : EffectsAlone(Named())) {
        const bool fewer = spec->parameters.size() < set[k]->parameters.size();
        if (!fewer || HoldsId(rest, spec->id)) continue;
        const std::optional<model::Effect> carried =
            Carried(from.fit.state.effects[k], EffectStarts(*spec, sets_.data.sizes).front());
        if (!carried) continue;
        const EffectSet exchanged = With(rest, spec);
        ModelState start = StateOf(from, rest);
        const auto at = std::find(exchanged.begin(), exchanged.end(), spec) - exchanged.begin();
        start.effects.insert(start.effects.begin() + at, *carried);
        jobs.push_back({exchanged, std::move(start), sets_.Base().fit.bic});
      }
    }
    sets_.RunJobs(jobs, 0.92, 0.92, "sets alike");
  }

  // `to` with the numbers that `from` has by the same name; none where it has none.
  static std::optional<model::Effect> Carried(const model::Effect& from, model::Effect to) {
    bool any = false;
    for (std::size_t i = 0; i < from.parameters.size(); ++i) {
      for (std::size_t j = 0; j < to.parameters.size(); ++j) {
        if (from.spec->parameters[i].name != to.spec->parameters[j].name) continue;
        to.parameters[j] = from.parameters[i];
        any = true;
      }
    }
    return any ? std::optional(to) : std::nullopt;
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
    if (!MaySeekClocks() || !sets_[set].fit.Usable()) return kNever;
    FitData data = sets_.data;
    data.clocks = true;
    FitOptions options = sets_.Further();
    options.threads = options_.threads;
    Fit with = FitModel(data, sets_[set].fit.state, options);
    Narrow(data, options, with);
    if (!with.Usable()) return kNever;
    const double bic = with.bic + ClocksCost(data, with, options);
    if (!(bic < sets_[set].fit.bic) || !enough_(with)) return bic;
    TryTiming(set, bic - EffectAhead());
    const Contender from = sets_[set];
    const bool rivalled =
        std::any_of(sets_.list.begin(), sets_.list.end(), [&](const Contender& other) {
          return other.effects.size() == from.effects.size() + 1 && other.fit.Usable() &&
                 Contains(other, from) && other.fit.bic < bic - EffectAhead();
        });
    return rivalled ? bic : kClocksAreAll;
  }

  // The best sets of each size up to the one that the search came to are fitted to the last digit;
  // then the choice is made again, because a fit cut short may have made a larger set look needed.
  SearchResult Finish(int size_max) {
    sets_.Report(0.92, "final fits");
    std::vector<Contender*> leading, standing;
    for (int size = 0; size <= size_max; ++size) {
      const double reach = size == size_max ? 1.5 * kTie : kSameOptimum;
      const std::vector<std::size_t> sorted = sets_.Sorted(size);
      for (const std::size_t i : sorted) {
        if (sets_[i].fit.bic > sets_[sorted.front()].fit.bic + reach) break;
        leading.push_back(&sets_.list[i]);
        if (size == size_max) standing.push_back(leading.back());
      }
    }
    sets_.FitTight(leading);
    for (Contender* contender : standing)
      if (sets_.LeftShare(*contender) <= kEstablished) sets_.FitInStep(*contender);
    std::stable_sort(sets_.list.begin(), sets_.list.end(),
                     [](const Contender& a, const Contender& b) {
                       if (a.fit.Usable() != b.fit.Usable()) return a.fit.Usable();
                       return a.fit.bic < b.fit.bic;
                     });
    SearchResult result{sets_.data, {}, 0, 0, !sets_.Cancelled(), false};
    for (std::size_t i = 0; i < sets_.list.size(); ++i)
      if (sets_[i].effects.empty()) result.base = i;
    result.chosen = result.base;
    for (int size = 1; size <= size_max; ++size) {
      const std::optional<std::size_t> best = sets_.Best(size);
      if (best && sets_[*best].fit.bic < sets_[result.chosen].fit.bic - kAccept)
        result.chosen = *best;
    }
    result.enough = enough_(sets_[result.chosen].fit);
    result.contenders = std::move(sets_.list);
    return result;
  }

  const SearchOptions& options_;
  const std::function<bool(const Fit&)>& enough_;
  Contenders sets_, other_sets_;  // as the clocks are taken, and the other way
  bool may_be_off_;               // the clocks, as far as is known
};

}  // namespace

SearchResult SearchEffects(const FitData& data, const SearchOptions& options,
                           const std::function<bool(const Fit&)>& enough,
                           const SearchResult& earlier) {
  return Search(data, options, enough).Run(earlier);
}

}  // namespace plenum::calibration
