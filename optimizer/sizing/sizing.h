// Continuous settings of one leaf of the search: is there a source pressure (and a volume of a
// made-to-measure reservoir) that meets every requirement, and which is best?
//
// Feasibility is decided by bracketing on quantities that keep their order, not by a solver that
// may fail: the strokes only get faster with the source pressure, and what the supply must bear
// (air, energy, duty, current) only grows with it, but for coils, which are bounded from below.
//
// settle.cc: the settings at which a listed design is run.
#ifndef PLENUM_OPTIMIZER_SIZING_SIZING_H_
#define PLENUM_OPTIMIZER_SIZING_SIZING_H_

#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/evaluate.h"

namespace plenum::optimizer {

struct Leaf {
  LeafStatus status = LeafStatus::kUndecided;
  OperatingPoint point;      // kFeasible: a point that meets every requirement
  double objective = 0.0;    // there
  double lower_bound = 0.0;  // of the objective over all settings
  bool lowest = true;        // no lower source pressure would do; false: that was not asked
};

// Settings with the volume given (stock reservoir; 0 where the configuration has none). Where the
// solver fails or is stopped, or after so many evaluations: the best so far with a bound that
// holds, or kUndecided.
inline constexpr int kSizingEvaluationsMax = 20000;
Leaf SizeAtVolume(const Problem& problem, const Candidate& candidate, double reservoir_m3,
                  int evaluations_max = kSizingEvaluationsMax);

// The same for a search, which asks whether and not where: where groups meet the highest pressure
// is tried first, and is enough where the objective does not depend on it.
Leaf SizeQuickly(const Problem& problem, const Candidate& candidate, double reservoir_m3);

// Whether the strokes of a regulated candidate are in time at the highest pressure of its window;
// true where that is not known.
bool FastAtHighest(const Problem& problem, const Candidate& candidate);

// All relative margins of an evaluation that works, strokes first and limited to 1: what a solver
// keeps ≥ 0. The smallest of them, or −∞ where nothing works.
template <class T>
std::vector<T> SolverMargins(const Problem& problem, const Candidate& candidate,
                             const OperatingPointOf<T>& point, const EvaluationOf<T>& evaluation) {
  std::vector<T> values;
  values.reserve(evaluation.groups.size());
  for (int g = 0; g < static_cast<int>(evaluation.groups.size()); ++g)
    values.push_back(1.0 - evaluation.groups[g].inflate_time_s / InflateWindow(problem, g));
  for (const MarginOf<T>& margin : Margins(problem, candidate, point, evaluation))
    values.push_back(margin.relative_margin > 1.0 ? T(1.0) : margin.relative_margin);
  if (candidate.battery.index != kNone)
    values.push_back(CurrentMargin(problem, candidate, evaluation));
  return values;
}
double SmallestMargin(const Problem& problem, const Candidate& candidate,
                      const OperatingPoint& point, const Evaluation& evaluation);

// Whether duty and energy of the pumps grow with the stop pressure (pump_slope.h). True without a
// compressor.
bool PumpEnergyRises(const Problem& problem, const Candidate& candidate);

// Lowest source pressure in the candidate's window at which the strokes meet their limits;
// kInfeasible where even the highest is too slow. `point` gives the reservoir; below `floor_pa`,
// which is within the tolerance of it, they do not.
inline constexpr double kPressureTolerance = 1e-9;
struct NeededPressure {
  LeafStatus status = LeafStatus::kUndecided;
  double source_pa = 0.0;
  double floor_pa = 0.0;
};
NeededPressure NeededSourcePressure(const Problem& problem, const Candidate& candidate,
                                    OperatingPoint point, double tolerance = kPressureTolerance);

// The settings that a listed design gets, from a feasible leaf. Where the objective leaves them
// free they make the smallest relative margin that they move as large as it can be; the point is
// taken only if it proves better when evaluated anew.
OperatingPoint Settle(const Problem& problem, const Candidate& candidate, const Leaf& leaf);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_SIZING_H_
