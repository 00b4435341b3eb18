// The strokes of a candidate in the periodic state, by the cheapest method that is exact for it.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_EVALUATE_STROKES_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_EVALUATE_STROKES_H_

#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {

// Whether strokes of several squads meet on the source for sure, so that each evaluation integrates
// them together.
inline bool StrokesMeet(const Problem& problem) {
  const Meeting meeting = MeetingOf(problem);
  return meeting == Meeting::kTogether || meeting == Meeting::kMixed;
}

// `works` is false where a pressure is never reached, and where a bound shows that a limit on a
// rise time is missed. One quadrature or one small integration per group where groups do not meet
// on the source (a single group, or staggered strokes that end before the next begins), and one for
// all that fill alike from a reservoir; FillTogether() behind a regulator and StrokesInTurns() out
// of a reservoir, where they serve; else the simulator. Of a group with several squads the slowest
// strokes and the highest pressure count. Of a tank without a regulator those of the last period,
// which is the slowest; of pumps without a reservoir `works` is false, too, where a squad is not
// full when its turn is over (candidate.h).
Strokes EvaluateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point);

// The strokes of a group on its own regulator, kept in `strokes`; false where the simulator did not
// get there.
bool StrokesOfGroup(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                    int group, Strokes& strokes);

// Whether the worst of a guarantee is enclosed for this candidate: it is then no combination of its
// parts' worst numbers, and Candidate::at_best makes a difference.
bool WorstIsEnclosed(const Problem& problem, const Candidate& candidate);

// Largest relative excess of the strokes over their limits on a compressor's reservoir, each group
// as if it were alone and found the reservoir full: a bound from below, by one integration a group.
double AloneStrokeExcess(const Problem& problem, const Candidate& candidate,
                         const OperatingPoint& point);

// The strokes by the simulator alone, in the periodic state; with effects by SimulateWithEffects
// (effect_strokes.h).
Strokes SimulateStrokes(const Problem& problem, const Candidate& candidate,
                        const OperatingPoint& point);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_EVALUATE_STROKES_H_
