// A stroke out of a reservoir that pumps refill meanwhile, at its fastest: of a box of lines, of
// pumps and of volumes. Internal to verify*.cc.
//
// With p the chambers' pressure, D(p) their content above that at rest, m the air pumped since the
// stroke began (as content) and s the reservoir's pressure,
//   s = s_0 + (m − D(p))/V,   dD/dt = κ·n·q(s, p),   dm/dt = κ·Q(s).
// More m never makes p grow slower, more p never makes m grow slower. Panel by panel of p a step
// with the flow where it is largest (p where the panel begins, m where it ends) and the delivery
// where it is largest (the other way round) therefore leads to no less m and no more time than any
// choice of the box takes. Once closed, s follows m.
#ifndef PLENUM_VERIFY_CORNER_VERIFY_PUMPED_STROKE_H_
#define PLENUM_VERIFY_CORNER_VERIFY_PUMPED_STROKE_H_

#include "verify/corner/verify_pump_choices.h"

namespace plenum::verify {

struct Volumes {  // of a reservoir
  double low_m3, high_m3;
};

struct PumpedStroke {
  double rise_s = kUnlimited, inflate_s = kUnlimited;  // at least; +∞: more than the window
  double end_pa = 0.0;  // of the reservoir after the window, at most; where it inflates
};

// Of the most actuators of a group that fill at once, alone on a reservoir with `start_pa`; no pump
// stops.
PumpedStroke FastestStroke(const Problem& problem, const PumpChoices& choices,
                           const PumpCells& pumps, const BestLine& line, int group, Volumes volumes,
                           double start_pa);

// Whether its target comes by `rise_max_s` and its operating pressure within the window.
bool MayFill(const Problem& problem, const PumpChoices& choices, const PumpCells& pumps,
             const BestLine& line, int group, Volumes volumes, double start_pa, double rise_max_s);

}  // namespace plenum::verify

#endif  // PLENUM_VERIFY_CORNER_VERIFY_PUMPED_STROKE_H_
