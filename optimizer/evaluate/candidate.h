// One combination of parts, its operating point, and what its parts weigh, take and stand.
#ifndef PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_
#define PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_

#include <vector>

#include "optimizer/evaluate/line.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Objectives within this relative distance are ties (tie_key.h).
inline constexpr double kTie = 1e-6;

inline constexpr int kNone = -1;
inline constexpr int kCustom = -2;  // made-to-measure reservoir

// A part of a source family, some pieces in parallel.
struct Option {
  int index = kNone;
  int quantity = 0;
  Amounts amounts;         // all pieces, gas charge included; zero for kCustom
  double objective = 0.0;  // their share of the objective
};

// How candidates are evaluated. A solver that gives up, or is told to stop, leaves an evaluation
// failed: nothing is known then.
struct Workbench {
  std::function<bool()> stop;  // may be empty
  PeriodicSolver periodic = model::FindPeriodicState;
  bool stopped() const { return stop && stop(); }
};

struct Candidate {
  Configuration configuration = Configuration::kMains;
  std::vector<const Line*> lines;  // one per group
  Option regulator, bottle, compressor, battery, reservoir;
  // Source pressures outside are known to be too slow, or more than the source bears.
  double source_floor_pa = 0.0;
  double source_cap_pa = kUnlimited;
  // Of a problem with a guarantee: valves that cannot hold as they are with these parts, which is
  // the best that may be said of them; else at their worst.
  bool at_best = false;
  const Workbench* bench = nullptr;  // null: the simulator of the model, never stopped
  bool stopped() const { return bench != nullptr && bench->stopped(); }
};

// Where a candidate is run. For the regulated configurations the source pressure is the regulator's
// outlet, for a compressor it is the pressure at which it stops.
template <class T>
struct OperatingPointOf {
  T source_pa = T(0.0);
  T reservoir_m3 = T(0.0);
  // Volume while the reservoir rises; equal to reservoir_m3 but for bounds over an interval of
  // volumes (model/strokes/reservoir_stroke.h).
  T reservoir_rising_m3 = T(0.0);
};
using OperatingPoint = OperatingPointOf<double>;

enum class LeafStatus { kFeasible, kInfeasible, kUndecided };

// Range of source pressures that the parts stand and that can drive the strokes at all; empty
// (low > high) if there is none.
struct Window {
  double low_pa, high_pa;
  bool empty() const { return !(low_pa <= high_pa); }
};
Window SourceWindow(const Problem& problem, const Candidate& candidate);

// Volume of a stock reservoir; 0 where there is none, or where it is made to measure.
double ReservoirVolume(const Problem& problem, const Candidate& candidate);
// The candidate run with such a volume, which a stock reservoir with tolerances has while it falls.
OperatingPoint PointAt(const Problem& problem, const Candidate& candidate, double source_pa,
                       double reservoir_m3);

// Parts of the candidate; a made-to-measure reservoir is built for its volume and stop pressure.
template <class T>
AmountsOf<T> TotalAmounts(const Problem& problem, const Candidate& candidate,
                          const OperatingPointOf<T>& point);
Amounts CustomReservoir(const Problem& problem, double volume_m3, double source_pa);
// Absolute: the highest pressure that a made-to-measure one may be built for, and one that no
// source drives the strokes without.
double CustomRatingPa(const Problem& problem);
double LeastSourcePa(const Problem& problem);
inline OperatingPoint LeastPoint(const Problem& problem, double reservoir_m3) {
  return {LeastSourcePa(problem), reservoir_m3, reservoir_m3};
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_CANDIDATE_H_
