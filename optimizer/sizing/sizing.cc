#include "optimizer/sizing/sizing.h"

#include <algorithm>
#include <cmath>
#include <queue>

#include "optimizer/evaluate/refilled_tank.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/evaluate/strokes/full_strokes.h"
#include "optimizer/pump/pump_bounds.h"
#include "optimizer/pump/pump_slope.h"
#include "optimizer/pump/stroke_bound.h"
#include "optimizer/sizing/group_pressures.h"

namespace plenum::optimizer {
namespace {

constexpr double kFirstStep = 1e-3, kStepGrowth = 8.0;  // of the source pressure
constexpr double kObjectiveTolerance = 4e-7;

// Coils of all cycles at any source pressure, at least.
double LeastCoilEnergy(const Problem& problem, const Candidate& candidate) {
  double energy_j = 0.0;
  for (int g = 0; g < static_cast<int>(candidate.lines.size()); ++g) {
    const Line& line = *candidate.lines[g];
    energy_j +=
        problem.actuations * CoilEnergyPerCycle(problem, g, line, line.inflate_time_least_s);
  }
  return energy_j;
}

// Whether no two squads draw at the same time, at the pressure of the evaluation and above.
bool OneAtATime(const Problem& problem, const Candidate& candidate, const Evaluation& evaluation) {
  if (!WindowsOverlap(problem)) return true;
  std::vector<double> inflate_s;
  inflate_s.reserve(evaluation.groups.size());
  for (const GroupPerformance& group : evaluation.groups) inflate_s.push_back(group.inflate_time_s);
  return EndInTurn(problem, inflate_s) && AllHold(candidate);
}

SteepestFall PumpFall(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return {};
  return {ChosenPump(problem, candidate).curve, problem.ambient.pressure_pa,
          SourceWindow(problem, candidate).high_pa};
}

// Source pressures at a fixed volume, by branch and bound over intervals: an interval takes at
// least what its left end does, less what coils and pumps may save towards its right end
// (pump_slope.h).
class PressureSearch {
 public:
  PressureSearch(const Problem& problem, const Candidate& candidate, double reservoir_m3,
                 int evaluations_max, const GroupPressures* groups = nullptr)
      : problem_(problem),
        candidate_(candidate),
        groups_(groups),
        reservoir_m3_(reservoir_m3),
        evaluations_max_(evaluations_max),
        rises_(PumpEnergyRises(problem, candidate)),
        pump_fall_(PumpFall(problem, candidate)),
        least_coils_j_(LeastCoilEnergy(problem, candidate)) {}

  Leaf Run(double low_pa, double high_pa) {
    leaf_.objective = kUnlimited;
    parts_objective_ =
        ObjectiveOf(problem_.objective, TotalAmounts(problem_, candidate_, At(low_pa)));
    const Evaluation low = Try(low_pa);
    // Without energy in the objective no pressure that works is better than the lowest.
    if (std::isfinite(leaf_.objective) && problem_.objective.energy_wh == 0.0) {
      parts_objective_ = leaf_.objective;
      return Done();
    }
    if (high_pa > low_pa) Open(low_pa, low, high_pa, Try(high_pa));
    while (!open_.empty() && evaluations_ < evaluations_max_ && !failed_ && !candidate_.stopped()) {
      if (open_.top().bound >= leaf_.objective * (1.0 - kObjectiveTolerance)) return Done();
      const Interval interval = open_.top();
      open_.pop();
      const double middle_pa = 0.5 * (interval.low_pa + interval.high_pa);
      const Evaluation middle = Try(middle_pa);
      Open(interval.low_pa, interval.low, middle_pa, middle);
      Open(middle_pa, middle, interval.high_pa, interval.high);
    }
    return Done();
  }

 private:
  struct Interval {
    double low_pa, high_pa, bound;
    double near;  // lowest objective at its ends: the order where no bound is known
    Evaluation low, high;
    bool operator<(const Interval& other) const {  // lowest on top
      return bound != other.bound ? bound > other.bound : near > other.near;
    }
  };

  OperatingPoint At(double source_pa) const {
    if (groups_) return PointAtHighest(candidate_, *groups_, source_pa, reservoir_m3_);
    return PointAt(problem_, candidate_, source_pa, reservoir_m3_);
  }

  Evaluation Try(double source_pa) {
    ++evaluations_;
    const OperatingPoint point = At(source_pa);
    Evaluation evaluation = Evaluate(problem_, candidate_, point);
    failed_ = failed_ || evaluation.failed;
    if (!(SmallestMargin(problem_, candidate_, point, evaluation) >= 0.0)) return evaluation;
    const OperatingPoint filled = Filled(problem_, candidate_, point, evaluation);
    const Evaluation at =
        RefillsTank(candidate_) ? Evaluate(problem_, candidate_, filled) : evaluation;
    failed_ = failed_ || at.failed;
    if (!at.works) return evaluation;
    const double objective = ObjectiveValue(problem_, candidate_, filled, at);
    if (objective < leaf_.objective) {
      leaf_.objective = objective;
      leaf_.point = filled;
    }
    return evaluation;
  }

  void Open(double low_pa, const Evaluation& low, double high_pa, const Evaluation& high) {
    double bound = parts_objective_;
    const double fall_j = low.works ? EnergyFall(low_pa, low, high_pa, high) : kUnlimited;
    if (std::isfinite(fall_j)) {
      const Evaluation least = LeastBetween(low, high, fall_j);
      if (SupplyMargin(problem_, candidate_, At(low_pa), least) < 0.0) return;
      bound = ObjectiveValue(problem_, candidate_, At(low_pa), least);
    }
    const double near = std::min(ObjectiveValue(problem_, candidate_, At(low_pa), low),
                                 ObjectiveValue(problem_, candidate_, At(high_pa), high));
    open_.push({low_pa, high_pa, bound, near, low, high});
  }

  // Most of it grows with the pressure and is least at the left end. Coils fall with it, and pumps
  // may by `fall_j` a cycle.
  Evaluation LeastBetween(Evaluation low, const Evaluation& high, double fall_j) const {
    const double coils_j = high.works ? high.energy_coils_j : least_coils_j_;
    const double change_j =
        std::min(0.0, coils_j - low.energy_coils_j) - problem_.actuations * fall_j;
    low.energy_total_j += change_j;
    low.energy_per_cycle_j += change_j / problem_.actuations;
    return low;
  }

  // Most that the pumps save in a cycle by stopping higher than at `low_pa`, J.
  double EnergyFall(double low_pa, const Evaluation& low, double high_pa,
                    const Evaluation& high) const {
    if (rises_) return 0.0;
    double fall_j_per_pa = low.air_per_cycle_m3 * pump_fall_.EnergyPerAir(high_pa);
    // Where groups take turns and the reservoir does not always become full.
    if (!IsBurst(problem_) && !high.from_full) {
      if (!OneAtATime(problem_, candidate_, low)) return kUnlimited;
      fall_j_per_pa +=
          candidate_.compressor.quantity * pump_fall_.Power(high_pa) / problem_.frequency_hz;
    }
    return fall_j_per_pa * (high_pa - low_pa);
  }

  Leaf Done() {
    const bool found = std::isfinite(leaf_.objective);
    leaf_.status = found                       ? LeafStatus::kFeasible
                   : open_.empty() && !failed_ ? LeafStatus::kInfeasible
                                               : LeafStatus::kUndecided;
    leaf_.lower_bound = open_.empty() ? leaf_.objective : open_.top().bound;
    if (failed_) leaf_.lower_bound = parts_objective_;
    if (found) leaf_.lower_bound = std::min(leaf_.lower_bound, leaf_.objective);
    return leaf_;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const GroupPressures* groups_;  // with regulators of their own: by the highest pressure
  double reservoir_m3_;
  int evaluations_max_;
  bool rises_;  // so do duty and energy of the pumps
  SteepestFall pump_fall_;
  double least_coils_j_;
  double parts_objective_ = 0.0;  // at the lowest pressure, at least
  std::priority_queue<Interval> open_;
  Leaf leaf_;
  int evaluations_ = 0;
  bool failed_ = false;
};

// Pumps without a reservoir have no settings: they are feasible or not.
Leaf SizeDirect(const Problem& problem, const Candidate& candidate) {
  Leaf leaf;
  leaf.status = LeafStatus::kInfeasible;
  leaf.point = DirectPoint(problem, candidate);
  if (!(leaf.point.source_pa <= SourceWindow(problem, candidate).high_pa)) return leaf;
  const Evaluation evaluation = Evaluate(problem, candidate, leaf.point);
  if (!(SmallestMargin(problem, candidate, leaf.point, evaluation) >= 0.0)) return leaf;
  leaf.status = LeafStatus::kFeasible;
  leaf.objective = leaf.lower_bound = ObjectiveValue(problem, candidate, leaf.point, evaluation);
  return leaf;
}

// Each group's pressure behind its own regulator (group_pressures.h).
Leaf SizeGroups(const Problem& problem, const Candidate& candidate, double tank_m3,
                int evaluations_max) {
  const GroupPressures pressures = NeededGroupPressures(problem, candidate);
  if (pressures.status == LeafStatus::kFeasible)
    return PressureSearch(problem, candidate, tank_m3, evaluations_max, &pressures)
        .Run(pressures.least_pa(), pressures.most_pa());
  Leaf leaf;
  leaf.status = pressures.status;
  leaf.lower_bound = ObjectiveOf(problem.objective,
                                 TotalAmounts(problem, candidate, LeastPoint(problem, tank_m3)));
  return leaf;
}

// The same on the weakest vacuum that does, where pumps keep one beside the source.
bool LacksRail(const Candidate& candidate) {
  return candidate.rail.pump.index != kNone && candidate.rail.weakest_pa == 0.0;
}
template <typename Size>
Leaf OnItsRail(const Problem& problem, const Candidate& candidate, const Size& size) {
  Candidate on_rail = candidate;
  const std::optional<double> rail_pa = WeakestRailPa(
      problem, RailSourceOf(problem, candidate), candidate.lines, GasOf(candidate.configuration));
  on_rail.rail.weakest_pa = rail_pa.value_or(0.0);
  if (rail_pa) return size(on_rail);
  Leaf leaf;
  leaf.status = LeafStatus::kInfeasible;
  leaf.lower_bound =
      ObjectiveOf(problem.objective, TotalAmounts(problem, candidate, LeastPoint(problem, 0.0)));
  return leaf;
}

}  // namespace

double SmallestMargin(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, const Evaluation& evaluation) {
  return std::min(-StrokeExcess(problem, evaluation),
                  SupplyMargin(problem, candidate, point, evaluation));
}

bool PumpEnergyRises(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return true;
  const model::CompressorCurve& curve = ChosenPump(problem, candidate).curve;
  const double low_pa = problem.ambient.pressure_pa;
  if (HasTank(candidate.configuration)) return true;  // as their energy is counted
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  if (IsBurst(problem)) return EnergyPerAirRises(curve, low_pa, high_pa);
  return PowerRises(curve, low_pa, high_pa);
}

NeededPressure NeededSourcePressure(const Problem& problem, const Candidate& candidate,
                                    OperatingPoint point, double tolerance) {
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return {LeafStatus::kInfeasible};
  point.source_pa = window.high_pa;
  if (TooSlowWhenFull(problem, candidate, point)) return {LeafStatus::kInfeasible};
  bool failed = false;
  const auto excess = [&](double source_pa) {
    point.source_pa = source_pa;
    const Evaluation evaluation = Evaluate(problem, candidate, point);
    failed = failed || evaluation.failed;
    return StrokeExcess(problem, evaluation);
  };
  double low_pa = window.low_pa, high_pa = window.high_pa;
  double f_low = excess(low_pa);
  if (f_low <= 0.0) return {LeafStatus::kFeasible, low_pa, low_pa};
  const auto unless_failed = [&](double source_pa) { return failed ? 0.0 : excess(source_pa); };
  // A window often begins a little below what is needed.
  double f_high = kUnlimited;
  for (double step = kFirstStep; f_high > 0.0; step *= kStepGrowth) {
    high_pa = std::min(window.low_pa * (1.0 + step), window.high_pa);
    f_high = unless_failed(high_pa);
    if (f_high > 0.0 && high_pa == window.high_pa) return {LeafStatus::kInfeasible};
    if (f_high > 0.0) {
      low_pa = high_pa;
      f_low = f_high;
    }
  }
  if (failed) return {LeafStatus::kUndecided};
  const Bracket needed = NarrowBracket(unless_failed, low_pa, f_low, high_pa, f_high, tolerance);
  return {failed ? LeafStatus::kUndecided : LeafStatus::kFeasible, needed.high, needed.low};
}

Leaf SizeAtVolume(const Problem& problem, const Candidate& candidate, double reservoir_m3,
                  int evaluations_max) {
  if (IsDirect(candidate.configuration)) return SizeDirect(problem, candidate);
  if (LacksRail(candidate))
    return OnItsRail(problem, candidate, [&](const Candidate& on_rail) {
      return SizeAtVolume(problem, on_rail, reservoir_m3, evaluations_max);
    });
  if (HasOwnRegulators(candidate))
    return SizeGroups(problem, candidate, reservoir_m3, evaluations_max);
  const NeededPressure needed =
      NeededSourcePressure(problem, candidate, PointAt(problem, candidate, 0.0, reservoir_m3));
  if (needed.status == LeafStatus::kFeasible)
    return PressureSearch(problem, candidate, reservoir_m3, evaluations_max)
        .Run(needed.source_pa, SourceWindow(problem, candidate).high_pa);
  Leaf leaf;
  leaf.status = needed.status;
  leaf.lower_bound = ObjectiveOf(
      problem.objective, TotalAmounts(problem, candidate, LeastPoint(problem, reservoir_m3)));
  return leaf;
}

bool FastAtHighest(const Problem& problem, const Candidate& candidate) {
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return true;
  const Evaluation evaluation =
      Evaluate(problem, candidate, PointAt(problem, candidate, window.high_pa, 0.0));
  return evaluation.failed || StrokeExcess(problem, evaluation) <= 0.0;
}

Leaf SizeQuickly(const Problem& problem, const Candidate& candidate, double reservoir_m3) {
  if (IsDirect(candidate.configuration)) return SizeDirect(problem, candidate);
  if (LacksRail(candidate))
    return OnItsRail(problem, candidate, [&](const Candidate& on_rail) {
      return SizeQuickly(problem, on_rail, reservoir_m3);
    });
  const OperatingPoint highest =
      PointAt(problem, candidate, SourceWindow(problem, candidate).high_pa, reservoir_m3);
  // The lowest pressure is the best for a tank, which weighs least then.
  if (HasOwnRegulators(candidate) || !StrokesMeet(problem) || problem.objective.energy_wh > 0.0 ||
      HasTank(candidate.configuration) || SourceWindow(problem, candidate).empty())
    return SizeAtVolume(problem, candidate, reservoir_m3);
  const Evaluation evaluation = Evaluate(problem, candidate, highest);
  const double parts = ObjectiveOf(problem.objective, TotalAmounts(problem, candidate, highest));
  if (!evaluation.failed && StrokeExcess(problem, evaluation) > 0.0)
    return {LeafStatus::kInfeasible, {}, 0.0, parts};
  if (evaluation.failed || SmallestMargin(problem, candidate, highest, evaluation) < 0.0)
    return SizeAtVolume(problem, candidate, reservoir_m3);
  return {LeafStatus::kFeasible, highest, parts, parts, false};
}

}  // namespace plenum::optimizer
