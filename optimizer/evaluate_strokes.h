// The strokes of a candidate in the periodic state, by the cheapest method that is exact for it.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_H_

#include <vector>

#include "model/simulate.h"
#include "optimizer/candidate.h"

namespace plenum::optimizer {

template <class T>
struct StrokesOf {
  bool works = false;
  bool failed = false;               // the simulator gave up or was stopped: nothing is known
  std::vector<T> rise_s, inflate_s;  // per group, worst of the cycle
  T pump_on_s = T(0.0);              // per cycle
  T pump_energy_j = T(0.0);          // per cycle, all pumps
  T pump_air_m3 = T(0.0);            // the same, ANR; not known with effects
  bool from_full = false;            // no two groups meet, and each finds the reservoir full
  // With effects only; without them the line knows.
  std::vector<double> fall_s, highest_pa;  // per group
  double air_m3 = 0.0;                     // ANR, per cycle, all actuators
};
using Strokes = StrokesOf<double>;

model::Gas GasOf(Configuration configuration);

// Adds what a valve that cannot hold lets through: its actuators stay on the source, which fills
// them from p_op up to the stop pressure. Counted as pumped at the stop pressure, the most that it
// can take.
template <class T>
void AddHeldAir(const Problem& problem, const Candidate& candidate, const T& stop_pa, int group,
                StrokesOf<T>& strokes);

// `works` is false where a pressure is never reached, and where a bound shows that a limit on a
// rise time is missed. One quadrature or one small integration per group where groups do not meet
// on the source (a single group, or staggered strokes that end before the next begins), else the
// simulator.
Strokes EvaluateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point);

// Largest relative excess of the strokes over their limits on a compressor's reservoir, each group
// as if it were alone and found the reservoir full: a bound from below, by one integration a group.
double AloneStrokeExcess(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point);

// The strokes by the simulator alone, in the periodic state; with effects by SimulateWithEffects
// (effect_strokes.h).
Strokes SimulateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point);

// The candidate as a rig for the simulator, with the commands of one cycle: actuators at rest and a
// full reservoir.
model::Rig MakeRig(const Problem& problem, const Candidate& candidate, const OperatingPoint& point);

// The same, where every stroke begins at ambient, as its rise time is defined, also where the fall
// only just meets its target within half of the period. How fast a chamber empties is nothing to
// the source.
model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point);
model::SimulateOptions StrokeOptions(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_H_
