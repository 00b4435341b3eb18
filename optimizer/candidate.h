// One combination of parts, and how it performs at an operating point.
#ifndef PLENUM_OPTIMIZER_CANDIDATE_H_
#define PLENUM_OPTIMIZER_CANDIDATE_H_

#include <vector>

#include "optimizer/line.h"
#include "optimizer/problem.h"

namespace plenum::optimizer {

// Objectives within this relative distance are ties, ordered by part ids.
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
  // volumes (model/reservoir_stroke.h).
  T reservoir_rising_m3 = T(0.0);
};
using OperatingPoint = OperatingPointOf<double>;

enum class LeafStatus { kFeasible, kInfeasible, kUndecided };

template <class T>
struct EvaluationOf {
  // False: a pressure is never reached, or surely too late, or the solver failed; nothing below is
  // valid then.
  bool works = false;
  bool failed = false;
  std::vector<GroupPerformanceOf<T>> groups;
  T air_per_cycle_m3 = T(0.0);    // ANR, all actuators
  T air_total_m3 = T(0.0);        // all cycles, first fill included
  double air_available_m3 = 0.0;  // ANR on board; +∞ for pump and mains
  T energy_first_fill_j = T(0.0);
  T energy_per_cycle_j = T(0.0);  // pumps, coils and regulator
  T energy_coils_j = T(0.0);      // all cycles; the only part that falls with the source pressure
  T energy_total_j = T(0.0);
  double energy_available_j = 0.0;  // +∞ on mains
  T battery_current_a = T(0.0);
  T compressor_duty = T(0.0);
  T frequency_sustained_hz = T(0.0);
  bool from_full = false;  // no two groups meet, and each finds the reservoir full
};
using Evaluation = EvaluationOf<double>;

struct EvaluateOptions {
  // Coils as if every stroke were as fast as on an unlimited source: a bound from below on their
  // energy that holds at every source pressure.
  bool least_coil_energy = false;
};

Evaluation Evaluate(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const EvaluateOptions& options = {});
// The same of strokes that are known (evaluate_strokes.h). T may be dual for a compressor's
// candidates: air on board is not differentiated.
template <class T>
struct StrokesOf;
template <class T>
EvaluationOf<T> EvaluateWith(const StrokesOf<T>& strokes, const Problem& problem,
                             const Candidate& candidate, const OperatingPointOf<T>& point,
                             const EvaluateOptions& options = {});

// Range of source pressures that the parts stand and that can drive the strokes at all; empty
// (low > high) if there is none.
struct Window {
  double low_pa, high_pa;
  bool empty() const { return !(low_pa <= high_pa); }
};
Window SourceWindow(const Problem& problem, const Candidate& candidate);

// Volume of a stock reservoir; 0 where there is none, or where it is made to measure.
double ReservoirVolume(const Problem& problem, const Candidate& candidate);

// Parts of the candidate with a made-to-measure reservoir of the given volume.
template <class T>
AmountsOf<T> TotalAmounts(const Problem& problem, const Candidate& candidate,
                          const T& reservoir_m3);
Amounts CustomReservoir(const Problem& problem, double volume_m3);
double CustomRatingPa(const Problem& problem);  // absolute: what a made-to-measure one is built for

// Objective at an operating point.
template <class T>
T ObjectiveValue(const Problem& problem, const Candidate& candidate,
                 const OperatingPointOf<T>& point, const EvaluationOf<T>& evaluation);

// Each requirement as a margin. Those that depend on the source pressure so that more is better
// (`strokes`: rise times, half of the period) come from Shortfall; all others fall with it.
template <class T>
std::vector<MarginOf<T>> Margins(const Problem& problem, const Candidate& candidate,
                                 const OperatingPointOf<T>& point,
                                 const EvaluationOf<T>& evaluation);

// Largest relative excess of a rise time over its limit, or of the inflation over half of the
// period; ≤ 0 where the strokes are fast enough. Does not rise with the source pressure: pressures
// keep their order (model/reservoir_stroke.h).
double StrokeExcess(const Problem& problem, const Evaluation& evaluation);

// Relative margin of the batteries' current limit; +∞ without a battery.
template <class T>
T CurrentMargin(const Problem& problem, const Candidate& candidate,
                const EvaluationOf<T>& evaluation);

// Smallest relative margin of all that the contract asks and that the parts stand (battery
// current), except the strokes; ≥ 0: met.
double SupplyMargin(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const Evaluation& evaluation);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CANDIDATE_H_
