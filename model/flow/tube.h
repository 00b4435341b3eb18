// Tubes as ISO 6358 elements.
#ifndef PLENUM_MODEL_FLOW_TUBE_H_
#define PLENUM_MODEL_FLOW_TUBE_H_

#include "model/flow/iso6358.h"

namespace plenum::model {

// C = 0.029·d² / √(L/d^1.25 + 510),  b = 474·C/d²   (SI: d and L in m, C in m³/(s·Pa)).
// Agrees with adiabatic friction flow (Fanno, entry loss 0.5) within 3.5 % in C for bores of 1.2 to
// 5 mm and lengths of 0.5 to 3 m; b is uncertain by ±0.15. b is limited to [0, 0.528]: a tube does
// not recover more pressure than an ideal nozzle.
// Valid: 0.3 mm ≤ d ≤ 30 mm, 0 < L ≤ 100 m. Below Re ≈ 2300 the flow is laminar and the law is
// wrong.
FlowElement TubeElement(double inner_diameter_m, double length_m);

// π·d²·L/4
double BoreVolume(double inner_diameter_m, double length_m);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_TUBE_H_
