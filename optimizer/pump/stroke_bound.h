// Bound from below on the times of a stroke out of a reservoir that pumps refill meanwhile, for a
// line or the best corner of a box of lines, an interval of reservoir volumes and the most that any
// of some pumps deliver.
//
// With p the chambers' pressure, s the reservoir's, m the air pumped since the stroke began at s_0
// (as content), c(p) the content of a chamber and n chambers,
//   s = s_0 + (m − n·Δc(p))/V,  dc/dt = κ·q(s, p),  dm/dt = κ·Q(s),  κ = P0·T/T0.
// Q falls with s and q grows with it, so that more m never makes p grow slower and more p never
// makes m grow slower: the system keeps order. A larger flow function lifts p and m, less dead
// volume p and s, other groups' draw lowers both. Panel by panel of p, a step that takes q at its
// greatest (p where the panel begins, m where it ends) and Q at its greatest (the other way round)
// ends no lower, so its duration is at most the true one.
#ifndef PLENUM_OPTIMIZER_PUMP_STROKE_BOUND_H_
#define PLENUM_OPTIMIZER_PUMP_STROKE_BOUND_H_

#include <array>
#include <vector>

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

struct PumpFacts;

// The reservoir when a stroke begins, at most.
struct StrokeStart {
  double start_pa = 0.0;
  double stop_pa = 0.0;  // the pumps bring it no higher
  double low_m3 = 0.0, high_m3 = 0.0;
};

// Largest relative excess over the limits of the group: rise time, half of the period for
// inflating. Where it is positive the strokes are too slow, by about that much.
double LeastStrokeExcess(const Problem& problem, int group, const Line& line,
                         const PumpFacts& pumps, const StrokeStart& start);
// Of all groups, each as if it were alone.
double LeastStrokeExcess(const Problem& problem, const std::vector<const Line*>& lines,
                         const PumpFacts& pumps, const StrokeStart& start);

// Time to the rise target, at least; no more than the limit on it.
double LeastRiseTime(const Problem& problem, int group, const Line& line, const PumpFacts& pumps,
                     const StrokeStart& start);

// Time to inflate to the operating pressure, at least; no more than half of the period.
double LeastInflateTime(const Problem& problem, int group, const Line& line, const PumpFacts& pumps,
                        const StrokeStart& start);

// Two groups that take turns each find what the other leaves when half of the period is over.
// Raises what the reservoir at least holds when each begins: enough for its own stroke and to leave
// enough for the other. False where the stop pressure is not enough. `tolerance`: relative; the
// pressures stay on the safe side.
bool RaiseStarts(const Problem& problem, const std::vector<const Line*>& lines,
                 const PumpFacts& pumps, double stop_pa, double low_m3, double high_m3,
                 double tolerance, std::array<double, 2>& start_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_STROKE_BOUND_H_
