// The strokes of groups that fill at the same time behind one regulator, each chamber from ambient
// pressure: where groups meet, and no effect acts, this is all that a simulation of the whole cycle
// would tell of them, at a fiftieth of its cost.
//
//   dp_g/dt = (P0·T/T0)·F_g(p, p_g)/W_g(p_g),   min(F_r(p_s, p), F_max) = Σ count_g·F_g(p, p_g)
//
// p the pressure at the node, F flows (m³ ANR/s), W = d(pV)/dp, until a valve that holds closes at
// the operating pressure. Pressures only rise. A chamber that has come up to the node stays with it
// until a valve closes, and the node rises as fast as what is left of the flow fills such chambers.
#ifndef PLENUM_OPTIMIZER_EVALUATE_SHARED_FILLING_H_
#define PLENUM_OPTIMIZER_EVALUATE_SHARED_FILLING_H_

#include <optional>

#include "optimizer/evaluate/stroke_rig.h"

namespace plenum::optimizer {

// Rise and inflation times of all groups, to 1e-7, kNever beyond half of the period; none where an
// element's law is another than that of ISO 6358-1 with the exponent ½, which tables do not hold.
std::optional<Strokes> FillTogether(const Problem& problem, const Candidate& candidate,
                                    double source_pa);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_SHARED_FILLING_H_
