// The first strokes of groups at once out of a full reservoir: no others are faster.
//
// With x the pressures of reservoir and chambers, dx/dt = f(x) has no falling dependence of one on
// another: a fuller chamber draws less from the reservoir, and a fuller reservoir fills chambers
// sooner. So of two courses of the same rig the one that begins higher stays higher, and strokes
// that begin with a reservoir at its stop pressure are the fastest there are from empty chambers.
// One integration, or where that does not serve (turn_strokes.h) one simulation up to the limits on
// rise times, where the periodic state takes several periods.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_FULL_STROKES_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_FULL_STROKES_H_

#include <optional>

#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// By how much even those exceed a limit at most, relative, and +∞ where they never get there; none
// where the strokes of a candidate do not meet on the reservoir of pumps or one integration does
// not serve. Falls with the stop pressure and with the volume, as far as the point has the most of
// it while the reservoir falls and the least while it rises.
std::optional<double> ExcessWhenFull(const Problem& problem, const Candidate& candidate,
                                     const OperatingPoint& point);
// Whether even those miss a limit. False where the strokes of a candidate do not meet on the
// reservoir of pumps, and where the simulator does not say.
bool TooSlowWhenFull(const Problem& problem, const Candidate& candidate,
                     const OperatingPoint& point);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_FULL_STROKES_H_
