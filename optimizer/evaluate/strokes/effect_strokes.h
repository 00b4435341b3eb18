// The strokes of a candidate under a revised model: the effects of its groups act in every cycle.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_EFFECT_STROKES_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_EFFECT_STROKES_H_

#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {

// Worst strokes, air and highest pressures of the periodic state (model/simulate/periodic.h). Where
// the rig has none with the period of the duty, of the second half of forty cycles from rest.
Strokes SimulateWithEffects(const Problem& problem, const Candidate& candidate,
                            const OperatingPoint& point);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_EFFECT_STROKES_H_
