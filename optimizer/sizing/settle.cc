#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "optimizer/evaluate/closing.h"
#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/sizing/group_pressures.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr double kBalanceTolerance = 1e-4;
constexpr double kMoves = 1e-9;  // a margin that the pressure moves

// The highest that the parts stand; behind a tank's regulator no more than its inlet asks anyhow,
// so that the tank needs no more air.
double HighestFree(const Problem& problem, const Candidate& candidate) {
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  if (!HasTank(candidate.configuration)) return high_pa;
  if (IsOpenTank(candidate) || !AllHold(candidate)) return 0.0;
  return std::min(high_pa, InletMinPa(problem, candidate));
}

// Settings from those of a feasible leaf to the highest pressure that is free, as a share.
class Freedom {
 public:
  using At = std::function<OperatingPoint(double share)>;
  Freedom(const Problem& problem, const Candidate& candidate, At at)
      : problem_(problem), candidate_(candidate), at_(std::move(at)) {}

  OperatingPoint PointAt(double share) const { return at_(share); }

  double SmallestMarginAt(double share) {
    return SmallestMargin(problem_, candidate_, at_(share), EvaluationAt(share));
  }

  // Strokes gain by pressure and the supply loses: of the margins that the pressure moves the
  // smallest is largest where those that rise meet those that fall.
  double Balance() {
    const std::vector<double> low = MarginsAt(0.0), high = MarginsAt(1.0);
    if (low.empty() || low.size() != high.size()) return 0.0;
    const auto excess = [&](double share) {
      const std::vector<double> margins = MarginsAt(share);
      if (margins.empty()) return kUnlimited;
      double rising = kUnlimited, falling = kUnlimited;
      for (std::size_t i = 0; i < margins.size(); ++i) {
        if (high[i] > low[i] + kMoves) rising = std::min(rising, margins[i]);
        if (high[i] < low[i] - kMoves) falling = std::min(falling, margins[i]);
      }
      if (std::isinf(rising)) return 0.0;
      return std::min(falling, 2.0) - rising;
    };
    return SmallestFeasible(excess, 0.0, 1.0, kBalanceTolerance);
  }

 private:
  // Each share is evaluated once.
  const Evaluation& EvaluationAt(double share) {
    const auto [known, fresh] = evaluations_.try_emplace(share);
    if (fresh) known->second = Evaluate(problem_, candidate_, at_(share));
    return known->second;
  }

  std::vector<double> MarginsAt(double share) {
    const Evaluation& evaluation = EvaluationAt(share);
    return evaluation.works ? SolverMargins(problem_, candidate_, at_(share), evaluation)
                            : std::vector<double>();
  }

  const Problem& problem_;
  const Candidate& candidate_;
  At at_;
  std::map<double, Evaluation> evaluations_;
};

// Of a holding group that is not the highest: where its rise and its peak have the same to spare.
// Up to `free_pa` that costs nothing.
double Balanced(const Problem& problem, const Candidate& candidate, const Window& window, int g,
                double free_pa) {
  const ActuatorGroup& group = problem.groups[g];
  const double ambient_pa = problem.ambient.pressure_pa;
  const auto excess = [&](double pa) {
    const std::optional<double> slow = GroupExcess(problem, candidate, g, pa);
    if (!slow) return 0.0;
    return 1.0 + *slow -
           (PeakOf(problem, candidate, g, pa) - ambient_pa) / (group.pressure_max_pa - ambient_pa);
  };
  return SmallestFeasible(excess, window.low_pa, std::min(window.high_pa, free_pa),
                          kBalanceTolerance);
}

// Behind regulators of their own the groups that the highest pressure asks nothing of are balanced
// each by itself. The others go from the least that they need to the highest, in step.
OperatingPoint SettleGroups(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  const GroupPressures pressures = NeededGroupPressures(problem, candidate);
  if (pressures.status != LeafStatus::kFeasible) return leaf.point;
  const double free_pa = std::max(pressures.least_pa(), InletMinPa(problem, candidate));
  double most_pa = pressures.most_pa();
  if (HasTank(candidate.configuration))
    most_pa = AllHold(candidate) ? free_pa : pressures.least_pa();
  std::vector<Window> windows = pressures.windows;
  for (int g = 0; g < static_cast<int>(windows.size()); ++g) {
    auto& [low_pa, high_pa] = windows[g];
    if (candidate.lines[g]->holds && low_pa < pressures.least_pa())
      low_pa = high_pa = Balanced(problem, candidate, windows[g], g, free_pa);
    else
      high_pa = std::max(low_pa, std::min(high_pa, most_pa));
  }
  Freedom freedom(problem, candidate, [&](double share) {
    return PointAtShare(windows, share, leaf.point.reservoir_m3);
  });
  if (!(freedom.SmallestMarginAt(0.0) >= 0.0)) return leaf.point;
  const double share = freedom.Balance();
  return freedom.PointAt(freedom.SmallestMarginAt(share) >= freedom.SmallestMarginAt(0.0) ? share
                                                                                          : 0.0);
}

OperatingPoint SettleSource(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  // An objective that the pressure moves leaves no freedom, nor does a made-to-measure reservoir at
  // its smallest volume. Pumps without a reservoir have no setting.
  if (problem.objective.energy_wh > 0.0 || candidate.reservoir.index == kCustom ||
      IsDirect(candidate.configuration))
    return leaf.point;
  if (HasOwnRegulators(candidate)) return SettleGroups(problem, candidate, leaf);
  const double span_pa = HighestFree(problem, candidate) - leaf.point.source_pa;
  if (!(span_pa > 0.0)) return leaf.point;
  Freedom freedom(problem, candidate, [&](double share) {
    OperatingPoint point = leaf.point;
    point.source_pa += share * span_pa;
    return point;
  });
  const double share = freedom.Balance();
  return freedom.SmallestMarginAt(share) >= freedom.SmallestMarginAt(0.0) ? freedom.PointAt(share)
                                                                          : leaf.point;
}

// A vacuum beside the source is halfway from the weakest that does to the deepest that its pumps
// keep, or as near to that as all requirements let it be; the weakest where energy counts.
OperatingPoint SettleRail(const Problem& problem, const Candidate& candidate,
                          const OperatingPoint& point) {
  constexpr double kHalf = 0.5, kLeast = 0.01;  // of the way
  const RailSource source = RailSourceOf(problem, candidate);
  if (!source.curve || problem.objective.energy_wh > 0.0) return point;
  const std::optional<double> deepest_pa = DeepestRailPa(problem, source, candidate.lines);
  const Evaluation weakest = Evaluate(problem, candidate, point);
  if (!deepest_pa || !weakest.works) return point;
  for (double share = kHalf; share > kLeast; share *= kHalf) {
    OperatingPoint deeper = point;
    deeper.rail_pa = weakest.rail.weakest_pa + share * (*deepest_pa - weakest.rail.weakest_pa);
    if (SmallestMargin(problem, candidate, deeper, Evaluate(problem, candidate, deeper)) >= 0.0)
      return deeper;
  }
  return point;
}

}  // namespace

OperatingPoint Settle(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  return SettleRail(problem, candidate, SettleSource(problem, candidate, leaf));
}

}  // namespace plenum::optimizer
