#include <algorithm>
#include <cmath>
#include <map>

#include "optimizer/evaluate/root.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"
#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr double kBalanceTolerance = 1e-4;
constexpr double kMoves = 1e-9;  // a margin that the pressure moves

// The highest that the parts stand; behind a tank's regulator no more than its inlet asks anyhow,
// so that the tank needs no more air.
double HighestFree(const Problem& problem, const Candidate& candidate) {
  const double high_pa = SourceWindow(problem, candidate).high_pa;
  if (candidate.configuration != Configuration::kTank) return high_pa;
  const bool hold = std::all_of(candidate.lines.begin(), candidate.lines.end(),
                                [](const Line* line) { return line->holds; });
  if (IsOpenTank(candidate) || !hold) return 0.0;
  return std::min(high_pa,
                  problem.parts.regulators[candidate.regulator.index].inlet_pressure_min_pa);
}

// Source pressures from that of a feasible leaf to the highest that is free, as a share.
class Freedom {
 public:
  Freedom(const Problem& problem, const Candidate& candidate, const Leaf& leaf)
      : problem_(problem),
        candidate_(candidate),
        leaf_(leaf),
        span_pa_(HighestFree(problem, candidate) - leaf.point.source_pa) {}

  bool empty() const { return !(span_pa_ > 0.0); }

  OperatingPoint At(double share) const {
    OperatingPoint point = leaf_.point;
    point.source_pa += share * span_pa_;
    return point;
  }

  double SmallestMarginAt(double share) {
    return SmallestMargin(problem_, candidate_, At(share), EvaluationAt(share));
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
    if (fresh) known->second = Evaluate(problem_, candidate_, At(share));
    return known->second;
  }

  std::vector<double> MarginsAt(double share) {
    const Evaluation& evaluation = EvaluationAt(share);
    return evaluation.works ? SolverMargins(problem_, candidate_, At(share), evaluation)
                            : std::vector<double>();
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const Leaf& leaf_;
  double span_pa_;
  std::map<double, Evaluation> evaluations_;
};

}  // namespace

OperatingPoint Settle(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  // An objective that the pressure moves leaves no freedom, nor does a made-to-measure reservoir at
  // its smallest volume. Pumps without a reservoir have no setting.
  if (problem.objective.energy_wh > 0.0 || candidate.reservoir.index == kCustom ||
      IsDirect(candidate.configuration))
    return leaf.point;
  Freedom freedom(problem, candidate, leaf);
  if (freedom.empty()) return leaf.point;
  const double share = freedom.Balance();
  return freedom.SmallestMarginAt(share) >= freedom.SmallestMarginAt(0.0) ? freedom.At(share)
                                                                          : leaf.point;
}

}  // namespace plenum::optimizer
