#include "optimizer/explain/conflict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "optimizer/explain/demands.h"
#include "optimizer/explain/minimal_conflicts.h"
#include "optimizer/explain/reach.h"

namespace plenum::optimizer {
namespace {

constexpr double kLimitS = 12.0;        // for the whole analysis
constexpr std::size_t kDropsMost = 12;  // smallest sets of demands that are compared

class Analysis {
 public:
  Analysis(const Problem& problem, const SearchOptions& options, double used_s)
      : problem_(problem),
        demands_(Demands(problem, options)),
        search_(options, std::min(kLimitS, options.time_limit_s - used_s)),
        oracle_([this](const DemandSet& dropped) { return Ask(dropped); }) {}

  Infeasibility Run() {
    const int count = static_cast<int>(demands_.size());
    const auto conflicts = FindDisjointConflicts(count, oracle_);
    if (conflicts.size() == 1 && conflicts.front().demands.empty())
      return {{PressuresThemselves()}, {}, true};
    relaxation_ = Relax(FindSmallestDrops(count, conflicts, kDropsMost, oracle_));
    Infeasibility result;
    for (const MinimalConflict& conflict : conflicts)
      if (!conflict.demands.empty()) result.conflicts.push_back(Describe(conflict));
    for (const auto& [demand, value] : relaxation_)
      result.relaxation.push_back(AsConcession(demand));
    result.complete = !unknown_ && !search_.OutOfTime();
    return result;
  }

  std::vector<Conflict> FindOne() {
    const auto minimal = FindMinimalConflict(static_cast<int>(demands_.size()), {}, oracle_);
    return minimal.demands.empty() ? PressuresThemselves() : Describe(minimal, false);
  }

 private:
  using Values = std::map<int, std::optional<double>>;  // of demands that give way; none: dropped

  static Values Dropped(const DemandSet& demands) {
    Values values;
    for (const int demand : demands) values[demand] = std::nullopt;
    return values;
  }

  // Parts are selected anew before their prices are looked at, so the later fields come first.
  Problem With(const Values& values) const {
    Problem trial = problem_;
    for (auto entry = values.rbegin(); entry != values.rend(); ++entry) {
      const Demand& demand = demands_[entry->first];
      entry->second ? demand.number->set(trial, *entry->second) : demand.drop(trial);
    }
    return trial;
  }

  Met Ask(const DemandSet& dropped) {
    if (search_.OutOfTime()) {
      unknown_ = true;
      return Met::kUnknown;
    }
    const Answer answer = search_.Any(With(Dropped(dropped)));
    if (!answer.designs.empty()) return Met::kYes;
    if (answer.status == Status::kInfeasible) return Met::kNo;
    unknown_ = true;
    return Met::kUnknown;
  }

  // With `others` as they are; a demand that is no number has nothing to reach.
  Reach ReachOf(int demand, const Values& others) {
    if (!demands_[demand].number || search_.OutOfTime()) return {};
    return FindReach(With(others), demands_[demand], search_);
  }

  double ChangeOf(int demand, const std::optional<double>& value) const {
    if (!value || demands_[demand].pointer.starts_with("/limits/")) return 1.0;
    const double required = demands_[demand].number->required;
    return required != 0.0 ? std::abs(*value / required - 1.0) : 1.0;
  }

  double ChangeOf(const Values& values) const {
    double sum = 0.0;
    for (const auto& [demand, value] : values) sum += ChangeOf(demand, value);
    return sum;
  }

  // Tightened one after the other, from the first on or from the last.
  Values Tighten(const DemandSet& dropped, bool from_last) {
    Values values = Dropped(dropped);
    std::vector<int> order(dropped.begin(), dropped.end());
    if (from_last) std::reverse(order.begin(), order.end());
    for (const int demand : order) {
      Values others = values;
      others.erase(demand);
      if (const Reach reach = ReachOf(demand, others); reach.best) values[demand] = reach.best;
    }
    return values;
  }

  Values Relax(const std::vector<DemandSet>& drops) {
    Values least;
    for (const DemandSet& dropped : drops)
      for (const bool from_last : {false, true}) {
        if (from_last && dropped.size() == 1) continue;
        if (!least.empty() && search_.OutOfTime()) return least;
        Values values = Tighten(dropped, from_last);
        if (least.empty() || ChangeOf(values) < ChangeOf(least)) least = std::move(values);
      }
    return least;
  }

  std::vector<Conflict> Describe(const MinimalConflict& minimal, bool reached = true) {
    Values others = relaxation_;
    for (const int demand : minimal.demands) others.erase(demand);
    std::vector<Conflict> conflict;
    for (const int demand : minimal.demands) {
      const std::optional<Requirement>& number = demands_[demand].number;
      Conflict entry;
      entry.requirement = demands_[demand].pointer;
      entry.proved = minimal.proved.contains(demand);
      if (number) entry.required = number->required;
      if (number && reached) {
        const Reach reach = ReachOf(demand, others);
        const auto given = relaxation_.find(demand);
        entry.best = given != relaxation_.end() && given->second ? given->second : reach.best;
        if (entry.best) entry.bound = reach.bound;
      }
      conflict.push_back(std::move(entry));
    }
    return conflict;
  }

  Concession AsConcession(int demand) const {
    const std::optional<Requirement>& number = demands_[demand].number;
    const std::optional<double>& value = relaxation_.at(demand);
    return {demands_[demand].pointer, number ? std::optional(number->required) : std::nullopt,
            value, ChangeOf(demand, value)};
  }

  // Nothing that can be dropped helps.
  std::vector<Conflict> PressuresThemselves() const {
    std::vector<Conflict> conflict;
    for (std::size_t g = 0; g < problem_.groups.size(); ++g)
      conflict.push_back(
          {GroupPointer(problem_, static_cast<int>(g)) + "/operating_pressure_kpa_gauge",
           KpaGauge(problem_, problem_.groups[g].chamber.operating_pressure_pa), std::nullopt,
           std::nullopt, true});
    return conflict;
  }

  const Problem& problem_;
  const std::vector<Demand> demands_;
  TrialSearch search_;
  DropOracle oracle_;
  Values relaxation_;
  bool unknown_ = false;  // some search ran out of time
};

}  // namespace

Infeasibility FindConflicts(const Problem& problem, const SearchOptions& options, double used_s) {
  return Analysis(problem, options, used_s).Run();
}

std::vector<Conflict> FindOneConflict(const Problem& problem, const SearchOptions& options,
                                      double used_s) {
  return Analysis(problem, options, used_s).FindOne();
}

}  // namespace plenum::optimizer
