// The strokes of squads that may fill at the same time behind one regulator, each chamber from
// ambient pressure: where no effect acts this is all that a simulation of the whole cycle would
// tell of them, at a fiftieth of its cost.
//
//   dp_g/dt = (P0·T/T0)·F_g(p, p_g)/W_g(p_g),   min(F_r(p_s, p), F_max) = Σ count_g·F_g(p, p_g)
//
// p the pressure at the node, F flows (m³ ANR/s), W = d(pV)/dp, until a valve that holds closes at
// the operating pressure, or its window is over. A chamber's pressure only rises: nothing flows
// back where the node falls below it. A chamber that has come up to the node stays with it until a
// valve opens or closes, and the node rises as fast as what is left of the flow fills such
// chambers. All that one period leaves to the next are strokes that go on: periods are computed
// until one is as the one before.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_SHARED_FILLING_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_SHARED_FILLING_H_

#include <optional>

#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {

// Slowest rise and inflation of each group, to 1e-5 of them, kNever beyond their window; none where
// an element's law is another than that of ISO 6358-1 with the exponent ½, which tables do not
// hold.
std::optional<Strokes> FillTogether(const Problem& problem, const Candidate& candidate,
                                    double source_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_SHARED_FILLING_H_
