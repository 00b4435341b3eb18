#include "optimizer/sizing.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "model/storage.h"
#include "optimizer/evaluate_strokes.h"
#include "optimizer/nlp.h"
#include "optimizer/pump_slope.h"
#include "optimizer/root.h"
#include "optimizer/stroke_bound.h"

namespace plenum::optimizer {
namespace {

constexpr double kPressureTolerance = 1e-8;
constexpr double kBoundTolerance = 1e-4;
constexpr int kEvaluationsMax = 20000;
constexpr double kObjectiveTolerance = 4e-7;
constexpr double kVolumeTolerance = 1e-7;  // of the objective
constexpr int kStepsPerRefine = 8;
constexpr int kStepsMax = 400;
constexpr double kEnergySlack = 1e-2;  // per relative width of an interval of volumes

// Coils of all cycles at any source pressure, at least.
double LeastCoilEnergy(const Problem& problem, const Candidate& candidate) {
  double energy_j = 0.0;
  for (const Line* line : candidate.lines)
    energy_j += problem.actuations * CoilEnergyPerCycle(problem, *line, line->inflate_time_least_s);
  return energy_j;
}

// Whether no two groups draw at the same time, at the pressure of the evaluation and above.
bool OneAtATime(const Problem& problem, const Candidate& candidate, const Evaluation& evaluation) {
  const std::size_t groups = problem.groups.size();
  if (groups <= 2) return true;
  for (std::size_t g = 0; g < groups; ++g)
    if (!candidate.lines[g]->holds ||
        evaluation.groups[g].inflate_time_s * problem.frequency_hz * static_cast<double>(groups) >
            1.0)
      return false;
  return true;
}

SteepestFall PumpFall(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return {};
  return {problem.parts.compressors[candidate.compressor.index].curve, problem.ambient.pressure_pa,
          SourceWindow(problem, candidate).high_pa};
}

// Source pressures at a fixed volume, by branch and bound over intervals: an interval takes at
// least what its left end does, less what coils and pumps may save towards its right end
// (pump_slope.h).
class PressureSearch {
 public:
  PressureSearch(const Problem& problem, const Candidate& candidate, double reservoir_m3)
      : problem_(problem),
        candidate_(candidate),
        reservoir_m3_(reservoir_m3),
        rises_(PumpEnergyRises(problem, candidate)),
        pump_fall_(PumpFall(problem, candidate)),
        least_coils_j_(LeastCoilEnergy(problem, candidate)),
        parts_objective_(
            ObjectiveOf(problem.objective, TotalAmounts(problem, candidate, reservoir_m3))) {}

  Leaf Run(double low_pa, double high_pa) {
    leaf_.objective = kUnlimited;
    const Evaluation low = Try(low_pa);
    // Without energy in the objective the lowest pressure that works is as good as any.
    if (std::isfinite(leaf_.objective) && problem_.objective.energy_wh == 0.0) return Done();
    if (high_pa > low_pa) Open(low_pa, low, high_pa, Try(high_pa));
    while (!open_.empty() && evaluations_ < kEvaluationsMax && !failed_ && !candidate_.stopped()) {
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

  OperatingPoint At(double source_pa) const { return {source_pa, reservoir_m3_, reservoir_m3_}; }

  Evaluation Try(double source_pa) {
    ++evaluations_;
    const OperatingPoint point = At(source_pa);
    Evaluation evaluation = Evaluate(problem_, candidate_, point);
    failed_ = failed_ || evaluation.failed;
    if (!(SmallestMargin(problem_, candidate_, point, evaluation) >= 0.0)) return evaluation;
    const double objective = ObjectiveValue(problem_, candidate_, point, evaluation);
    if (objective < leaf_.objective) {
      leaf_.objective = objective;
      leaf_.point = point;
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
    if (!problem_.simultaneous && problem_.groups.size() > 1 && !high.from_full) {
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
    if (problem_.objective.energy_wh == 0.0 || failed_) leaf_.lower_bound = parts_objective_;
    if (found) leaf_.lower_bound = std::min(leaf_.lower_bound, leaf_.objective);
    return leaf_;
  }

  const Problem& problem_;
  const Candidate& candidate_;
  double reservoir_m3_;
  bool rises_;  // so do duty and energy of the pumps
  SteepestFall pump_fall_;
  double least_coils_j_;
  double parts_objective_;
  std::priority_queue<Interval> open_;
  Leaf leaf_;
  int evaluations_ = 0;
  bool failed_ = false;
};

}  // namespace

double SmallestMargin(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, const Evaluation& evaluation) {
  return std::min(-StrokeExcess(problem, evaluation),
                  SupplyMargin(problem, candidate, point, evaluation));
}

std::vector<double> SolverMargins(const Problem& problem, const Candidate& candidate,
                                  const OperatingPoint& point, const Evaluation& evaluation) {
  std::vector<double> values;
  for (const GroupPerformance& group : evaluation.groups)
    values.push_back(1.0 - group.inflate_time_s / HalfPeriod(problem));
  for (const Margin& margin : Margins(problem, candidate, point, evaluation))
    values.push_back(std::min(margin.relative_margin, 1.0));
  if (candidate.battery.index != kNone)
    values.push_back(CurrentMargin(problem, candidate, evaluation));
  return values;
}

bool PumpEnergyRises(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return true;
  const model::CompressorCurve& curve = problem.parts.compressors[candidate.compressor.index].curve;
  const double low_pa = problem.ambient.pressure_pa;
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  if (problem.simultaneous || problem.groups.size() == 1)
    return EnergyPerAirRises(curve, low_pa, high_pa);
  return PowerRises(curve, low_pa, high_pa);
}

NeededPressure NeededSourcePressure(const Problem& problem, const Candidate& candidate,
                                    OperatingPoint point) {
  const Window window = SourceWindow(problem, candidate);
  if (window.empty()) return {LeafStatus::kInfeasible};
  bool failed = false;
  const auto excess = [&](double source_pa) {
    point.source_pa = source_pa;
    const Evaluation evaluation = Evaluate(problem, candidate, point);
    failed = failed || evaluation.failed;
    return StrokeExcess(problem, evaluation);
  };
  if (!(excess(window.high_pa) <= 0.0))
    return {failed ? LeafStatus::kUndecided : LeafStatus::kInfeasible};
  double low_pa = window.low_pa;
  if (candidate.compressor.index != kNone) {
    // A cheap bound from below brings the costly search close to its end.
    const PumpFacts pumps =
        MakePumpFacts(problem, problem.parts.compressors[candidate.compressor.index].curve,
                      candidate.compressor.quantity);
    const auto alone = [&](double source_pa) {
      return LeastStrokeExcess(
          problem, candidate.lines, pumps,
          {source_pa, source_pa, point.reservoir_rising_m3, point.reservoir_m3});
    };
    low_pa = FeasibleBracket(alone, low_pa, window.high_pa, kBoundTolerance).low;
  }
  const auto unless_failed = [&](double source_pa) { return failed ? 0.0 : excess(source_pa); };
  const double source_pa =
      SmallestFeasible(unless_failed, low_pa, window.high_pa, kPressureTolerance);
  return {failed ? LeafStatus::kUndecided : LeafStatus::kFeasible, source_pa};
}

Leaf SizeAtVolume(const Problem& problem, const Candidate& candidate, double reservoir_m3) {
  const NeededPressure needed =
      NeededSourcePressure(problem, candidate, {0.0, reservoir_m3, reservoir_m3});
  if (needed.status == LeafStatus::kFeasible)
    return PressureSearch(problem, candidate, reservoir_m3)
        .Run(needed.source_pa, SourceWindow(problem, candidate).high_pa);
  Leaf leaf;
  leaf.status = needed.status;
  leaf.lower_bound = ObjectiveOf(problem.objective, TotalAmounts(problem, candidate, reservoir_m3));
  return leaf;
}

CustomSizing::CustomSizing(const Problem& problem, Candidate candidate)
    : problem_(problem),
      candidate_(std::move(candidate)),
      facts_(MakePumpFacts(problem, problem.parts.compressors[candidate_.compressor.index].curve,
                           candidate_.compressor.quantity)) {
  leaf_.objective = kUnlimited;
  Open(model::kMadeReservoirSmallestM3, model::kMadeReservoirLargestM3, 0.0);
  leaf_.lower_bound = open_.empty() ? 0.0 : open_.top().bound;
}

std::vector<ReservoirNeed> CustomSizing::CheapBounds(double low_m3, double high_m3) const {
  const model::Battery& battery = problem_.parts.batteries[candidate_.battery.index];
  return ReservoirNeeds(problem_, facts_, candidate_,
                        candidate_.battery.quantity *
                            model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v),
                        low_m3, high_m3);
}

// Queues what the cheap bounds leave of an interval.
void CustomSizing::Open(double low_m3, double high_m3, double bound) {
  for (const ReservoirNeed& need : CheapBounds(low_m3, high_m3)) {
    Evaluation least;
    least.energy_total_j = need.energy_j;
    const double objective =
        ObjectiveValue(problem_, candidate_, {need.source_pa, need.low_m3, need.low_m3}, least);
    open_.push({need.low_m3, need.high_m3, std::max(bound, objective), need.source_pa,
                need.source_max_pa, false});
  }
}

bool CustomSizing::Refine() {
  for (int step = 0; step < kStepsPerRefine && !candidate_.stopped(); ++step) {
    const double good_enough = leaf_.objective - kVolumeTolerance * std::abs(leaf_.objective);
    if (open_.empty() || open_.top().bound >= good_enough) {
      const bool found = std::isfinite(leaf_.objective);
      leaf_.status = found ? LeafStatus::kFeasible : LeafStatus::kInfeasible;
      leaf_.lower_bound =
          open_.empty() ? leaf_.objective : std::min(leaf_.objective, open_.top().bound);
      return true;
    }
    Interval interval = open_.top();
    open_.pop();
    if (!interval.examined) {
      if (Examine(interval)) open_.push(interval);
    } else {
      Split(interval);
    }
    if (candidate_.stopped()) break;
    if (failed_ || ++steps_ >= kStepsMax) {
      // The bound stands, the leaf is as good as the incumbent, and the gap is reported.
      leaf_.status =
          std::isfinite(leaf_.objective) ? LeafStatus::kFeasible : LeafStatus::kUndecided;
      leaf_.lower_bound =
          open_.empty() ? leaf_.lower_bound : std::min(leaf_.objective, open_.top().bound);
      return true;
    }
  }
  leaf_.lower_bound = open_.empty() ? leaf_.objective : open_.top().bound;
  return false;
}

bool CustomSizing::Examine(Interval& interval) {
  interval.examined = true;
  Candidate candidate = candidate_;
  candidate.source_floor_pa = interval.source_floor_pa;
  candidate.source_cap_pa = interval.source_cap_pa;
  OperatingPoint point{0.0, interval.high_m3, interval.low_m3};
  const NeededPressure needed = NeededSourcePressure(problem_, candidate, point);
  if (needed.status == LeafStatus::kInfeasible) return false;
  failed_ = failed_ || needed.status == LeafStatus::kUndecided;
  if (failed_) return true;
  if (PumpEnergyRises(problem_, candidate)) {
    point.source_pa = needed.source_pa;
    Evaluation best = Evaluate(problem_, candidate, point, {.least_coil_energy = true});
    // Times over an interval of volumes are bounds; energy may pass that of a volume inside by a
    // few 1e-4 where the pump nearly refills within the stroke (model/reservoir_stroke.h).
    const double slack = kEnergySlack * (interval.high_m3 / interval.low_m3 - 1.0);
    best.energy_total_j *= 1.0 - slack;
    best.energy_per_cycle_j *= 1.0 - slack;
    const OperatingPoint smallest{needed.source_pa, interval.low_m3, interval.low_m3};
    if (best.failed) {
      failed_ = true;
      return true;
    }
    if (SupplyMargin(problem_, candidate, smallest, best) < 0.0) return false;
    interval.bound = std::max(interval.bound, ObjectiveValue(problem_, candidate, smallest, best));
  }
  Offer(interval.high_m3);
  return interval.bound < leaf_.objective;
}

void CustomSizing::Split(const Interval& interval) {
  const double middle_m3 = std::sqrt(interval.low_m3 * interval.high_m3);
  Offer(middle_m3);
  Open(interval.low_m3, middle_m3, interval.bound);
  Open(middle_m3, interval.high_m3, interval.bound);
}

void CustomSizing::Offer(double volume_m3) {
  if (ObjectiveOf(problem_.objective, TotalAmounts(problem_, candidate_, volume_m3)) >=
      leaf_.objective)
    return;
  const std::vector<ReservoirNeed> needs = CheapBounds(volume_m3, volume_m3);
  if (needs.empty()) return;
  Candidate candidate = candidate_;
  candidate.source_floor_pa = needs.front().source_pa;
  candidate.source_cap_pa = needs.front().source_max_pa;
  const Leaf leaf = SizeAtVolume(problem_, candidate, volume_m3);
  if (leaf.status != LeafStatus::kFeasible || leaf.objective >= leaf_.objective) return;
  leaf_.point = leaf.point;
  leaf_.objective = leaf.objective;
  if (!polished_) Polish();
}

// From the first feasible volume Ipopt finds the best pair of pressure and volume near it.
void CustomSizing::Polish() {
  polished_ = true;
  const Window window = SourceWindow(problem_, candidate_);
  const double volume_m3 = leaf_.point.reservoir_m3;
  const double scale = std::abs(leaf_.objective);
  const auto point_at = [&](const std::vector<double>& x) {
    const double volume = x[1] * volume_m3;
    return OperatingPoint{window.low_pa + x[0] * (window.high_pa - window.low_pa), volume, volume};
  };
  Nlp nlp;
  nlp.low = {0.0, std::max(0.3, model::kMadeReservoirSmallestM3 / volume_m3)};
  nlp.high = {1.0, 1.0};
  if (!(window.high_pa > window.low_pa) || !(nlp.low[1] < 1.0)) return;
  nlp.start = {(leaf_.point.source_pa - window.low_pa) / (window.high_pa - window.low_pa), 1.0};
  const Evaluation start = Evaluate(problem_, candidate_, leaf_.point);
  if (!start.works) return;  // the time is up: there are no margins to count
  nlp.constraints =
      static_cast<int>(SolverMargins(problem_, candidate_, leaf_.point, start).size());
  nlp.evaluate = [&](const std::vector<double>& x, NlpValues& values) {
    const OperatingPoint point = point_at(x);
    const Evaluation evaluation = Evaluate(problem_, candidate_, point);
    if (!evaluation.works) return false;
    values.objective = ObjectiveValue(problem_, candidate_, point, evaluation) / scale;
    values.constraints = SolverMargins(problem_, candidate_, point, evaluation);
    return true;
  };
  nlp.stop = [&] { return candidate_.stopped(); };
  const NlpResult result = SolveWithIpopt(nlp);
  if (result.status == NlpStatus::kSolved) {
    // The solver stops within its tolerance of the limits; a hair more volume is surely inside.
    Offer(point_at(result.x).reservoir_m3 * (1.0 + 1e-7));
  }
}

}  // namespace plenum::optimizer
