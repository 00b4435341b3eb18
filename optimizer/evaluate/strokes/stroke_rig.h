// A candidate as a rig for the simulator, and the strokes that an evaluation finds.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_STROKE_RIG_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_STROKE_RIG_H_

#include <algorithm>
#include <vector>

#include "model/simulate/simulate.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/gait.h"

namespace plenum::optimizer {

template <class T>
struct StrokesOf {
  bool works = false;
  bool failed = false;               // the simulator gave up or was stopped: nothing is known
  std::vector<T> rise_s, inflate_s;  // per group, worst of the cycle
  // Per group, when its valve closes, or where that cannot hold when its window is over; not known
  // with effects.
  std::vector<T> filled_pa;
  T pump_on_s = T(0.0);      // per cycle
  T pump_energy_j = T(0.0);  // per cycle, all pumps
  T pump_air_m3 = T(0.0);    // the same, ANR; not known with effects
  bool from_full = false;    // each stroke finds the reservoir full
  // With effects only; without them the line knows.
  std::vector<double> fall_s, highest_pa;  // per group
  double air_m3 = 0.0;                     // ANR, per cycle, all actuators
};
using Strokes = StrokesOf<double>;

// Of which nothing is known but that each valve closes at the operating pressure or above. Of a
// group's squads the slowest strokes and the highest pressure are kept.
Strokes ToBeKept(const Problem& problem);
inline void Keep(double& most, double value) { most = std::max(most, value); }
// Whether all groups come to their operating pressures.
bool AllReached(const Strokes& strokes);

model::Gas GasOf(Configuration configuration);

// Most that the regulator of a group of a candidate passes, m³ ANR/s.
double FlowMax(const Problem& problem, const Candidate& candidate, int group = 0);

// Whether any group's model is revised.
bool HasEffects(const Problem& problem);

// The effects of a group that act in a configuration: a droop measured behind a regulator is no
// property of a compressor with its own reservoir.
std::vector<model::Effect> ActingEffects(const ActuatorGroup& group, Configuration configuration);

// What is simulated together: all groups, or with regulators or pumps of their own one after
// another.
struct Together {
  int first = 0, last = 0;  // groups, half-open
  int feeds = 1;            // of pumps, of which one is simulated (pump_feed.h)
  bool Has(int group) const { return first <= group && group < last; }
};
std::vector<Together> TogetherOf(const Problem& problem, const Candidate& candidate);
// Their squads, in the order of SquadsOf().
std::vector<Squad> SquadsOf(const Problem& problem, const Together& together);

// Of all groups at once; not of candidates with regulators of their own.
model::Rig MakeRig(const Problem& problem, const Candidate& candidate, const OperatingPoint& point);

// The candidate as a rig for the simulator, one of its groups for each squad (gait.h), with the
// commands of one cycle: actuators at rest and a full reservoir. Of a tank without a regulator
// (candidate.h) the last cycle of the mission, with all strokes before it done; a group's commands
// are then in order and may reach beyond the period.
model::Rig MakeRig(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                   const Together& together);

// The same, where every stroke begins at ambient, as its rise time is defined, also where the fall
// only just meets its target within its window. How fast a chamber empties is nothing to
// the source.
model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point);
model::Rig MakePeriodicRig(const Problem& problem, const Candidate& candidate,
                           const OperatingPoint& point, const Together& together);

// A rig of one cycle as a cycle of it left it: pressures, and valves as the commands before told
// them. A tank without pumps keeps the pressure that it begins with.
void BeginWhereItEnded(const model::Response& ended, double period_s, model::Rig& rig);

model::SimulateOptions StrokeOptions(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_STROKE_RIG_H_
