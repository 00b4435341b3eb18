// How a candidate performs at an operating point: strokes, air, energy, objective, and its margins
// from each requirement (margins.cc).
#ifndef PLENUM_OPTIMIZER_EVALUATE_EVALUATE_H_
#define PLENUM_OPTIMIZER_EVALUATE_EVALUATE_H_

#include <vector>

#include "optimizer/evaluate/candidate.h"
#include "optimizer/evaluate/pumped_rail.h"

namespace plenum::optimizer {

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
  bool from_full = false;  // each stroke finds the reservoir full
  RailLoad rail = {};      // of the vacuum beside the source, where it has pumps
};
using Evaluation = EvaluationOf<double>;

struct EvaluateOptions {
  // Coils as if every stroke were as fast as on an unlimited source: a bound from below on their
  // energy that holds at every source pressure.
  bool least_coil_energy = false;
};

Evaluation Evaluate(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    const EvaluateOptions& options = {});
// The same with the fill of a tank that pumps go on filling, where it is not given: the point's is
// set.
Evaluation EvaluateFilled(const Problem& problem, const Candidate& candidate,
                          OperatingPoint& point);
// The same of strokes that are known (evaluate_strokes.h). T may be dual for a compressor's
// candidates: air on board is not differentiated.
template <class T>
struct StrokesOf;
template <class T>
EvaluationOf<T> EvaluateWith(const StrokesOf<T>& strokes, const Problem& problem,
                             const Candidate& candidate, const OperatingPointOf<T>& point,
                             const EvaluateOptions& options = {});

// The point with the pressure of a vacuum beside the source, and the tank's fill: its own, or the
// least that holds the air of the evaluation, or the best of one that pumps go on filling
// (refilled_tank.h), whose evaluation without a fill is that at the highest; of a candidate without
// a tank as it is.
template <class T>
OperatingPointOf<T> Filled(const Problem& problem, const Candidate& candidate,
                           OperatingPointOf<T> point, const EvaluationOf<T>& evaluation);

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
// keep their order (model/strokes/reservoir_stroke.h).
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

#endif  // PLENUM_OPTIMIZER_EVALUATE_EVALUATE_H_
