// Continuous settings of given parts under a revised model.
#ifndef PLENUM_OPTIMIZER_SIZING_EFFECT_SIZING_H_
#define PLENUM_OPTIMIZER_SIZING_EFFECT_SIZING_H_

#include <functional>

#include "optimizer/sizing/sizing.h"

namespace plenum::optimizer {

// The lowest source pressure at which the strokes meet their limits and, for a made-to-measure
// reservoir, the least volume at which the supply bears them, sought from `start_m3` on. Both by
// bracketing on simulated cycles: kInfeasible where the highest pressure, or the largest volume,
// does not do. With energy in the objective a higher pressure or a larger volume may be better
// still. No bound on the objective is given. kUndecided where `stop` says so.
Leaf SizeWithEffects(const Problem& problem, const Candidate& candidate, double start_m3,
                     const std::function<bool()>& stop);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_EFFECT_SIZING_H_
