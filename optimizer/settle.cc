#include <algorithm>
#include <cmath>

#include "optimizer/evaluate_strokes.h"
#include "optimizer/nlp.h"
#include "optimizer/root.h"
#include "optimizer/sizing.h"

namespace plenum::optimizer {
namespace {

constexpr int kScanPoints = 8;
constexpr double kBalanceTolerance = 1e-6;
constexpr double kMoves = 1e-9;  // a margin that the pressure moves

// Source pressures from that of a feasible leaf to the highest that the parts stand, as a share.
class Freedom {
 public:
  Freedom(const Problem& problem, const Candidate& candidate, const Leaf& leaf)
      : problem_(problem),
        candidate_(candidate),
        leaf_(leaf),
        span_pa_(SourceWindow(problem, candidate).high_pa - leaf.point.source_pa),
        by_energy_(problem.objective.energy_wh > 0.0) {}

  bool empty() const { return !(span_pa_ > 0.0); }

  OperatingPoint At(double share) const {
    OperatingPoint point = leaf_.point;
    point.source_pa += share * span_pa_;
    return point;
  }

  // What settling makes small: the objective if the pressure moves it, else the margin's negative;
  // +∞ where a requirement is missed.
  double Cost(double share) const {
    const Evaluation evaluation = Evaluate(problem_, candidate_, At(share));
    const double margin = SmallestMargin(problem_, candidate_, At(share), evaluation);
    if (!(margin >= 0.0)) return kUnlimited;
    return by_energy_ ? ObjectiveValue(problem_, candidate_, At(share), evaluation) : -margin;
  }

  double BestByScan() const {
    double best = 0.0, best_cost = Cost(0.0);
    for (int i = 1; i <= kScanPoints; ++i) {
      const double share = static_cast<double>(i) / kScanPoints;
      if (const double cost = Cost(share); cost < best_cost) {
        best = share;
        best_cost = cost;
      }
    }
    return best;
  }

  // Strokes gain by pressure and the supply loses: of the margins that the pressure moves the
  // smallest is largest where those that rise meet those that fall.
  double BestByBalance() const {
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

  // Where the pressure moves the objective.
  double BestByIpopt() const {
    const std::vector<double> low = MarginsAt(0.0), high = MarginsAt(1.0);
    if (low.empty() || low.size() != high.size()) return 0.0;
    std::vector<std::size_t> moving;  // margins that the source pressure moves
    for (std::size_t i = 0; i < low.size(); ++i)
      if (std::abs(high[i] - low[i]) > kMoves) moving.push_back(i);
    if (moving.empty()) return 0.0;

    Nlp nlp;
    nlp.low = {0.0};
    nlp.high = {1.0};
    nlp.start = {0.0};
    nlp.constraints = static_cast<int>(moving.size());
    const double scale = std::max(std::abs(leaf_.objective), 1e-9);
    nlp.evaluate = [&](const std::vector<double>& x, NlpValues& values) {
      const Evaluation evaluation = Evaluate(problem_, candidate_, At(x[0]));
      if (!evaluation.works) return false;
      const std::vector<double> margins = SolverMargins(problem_, candidate_, At(x[0]), evaluation);
      values.objective = ObjectiveValue(problem_, candidate_, At(x[0]), evaluation) / scale;
      values.constraints.clear();
      for (std::size_t i : moving) values.constraints.push_back(margins[i]);
      return true;
    };
    const NlpResult result = SolveWithIpopt(nlp);
    return result.x.empty() ? 0.0 : std::clamp(result.x[0], 0.0, 1.0);
  }

 private:
  std::vector<double> MarginsAt(double share) const {
    const Evaluation evaluation = Evaluate(problem_, candidate_, At(share));
    return evaluation.works ? SolverMargins(problem_, candidate_, At(share), evaluation)
                            : std::vector<double>();
  }

  const Problem& problem_;
  const Candidate& candidate_;
  const Leaf& leaf_;
  double span_pa_;
  bool by_energy_;
};

}  // namespace

OperatingPoint Settle(const Problem& problem, const Candidate& candidate, const Leaf& leaf) {
  // At its smallest volume a made-to-measure reservoir leaves no freedom.
  if (candidate.reservoir.index == kCustom && problem.objective.energy_wh == 0.0) return leaf.point;
  const Freedom freedom(problem, candidate, leaf);
  if (freedom.empty()) return leaf.point;
  const bool quick = problem.groups.size() == 1 || !problem.simultaneous;
  const double share = problem.objective.energy_wh == 0.0 ? freedom.BestByBalance()
                       : quick                            ? freedom.BestByIpopt()
                                                          : freedom.BestByScan();
  return freedom.Cost(share) <= freedom.Cost(0.0) ? freedom.At(share) : leaf.point;
}

}  // namespace plenum::optimizer
