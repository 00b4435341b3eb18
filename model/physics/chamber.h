// The expanding actuator: how its volume follows its pressure.
#ifndef PLENUM_MODEL_PHYSICS_CHAMBER_H_
#define PLENUM_MODEL_PHYSICS_CHAMBER_H_

#include <string>

#include "model/physics/air.h"
#include "model/physics/monotone_curve.h"

namespace plenum::model {

// Quasi-static actuator with the rigid dead volume of its tube.
//   linear law: V(p) = V0·[1 + (ε−1)·x],  x = (p − p_a)/(p_op − p_a), on both sides of [p_a, p_op]
//   table:      monotone cubic through the points (PCHIP), straight on with the end slope outside
// ε = 1 is a rigid or blocked actuator. Valid: V0 > 0, ε ≥ 1, p_op > p_a; a table starts at or
// below p_a, ends at or above p_op, pressures strictly rising, volumes > 0 and not falling (so that
// d(pV)/dp > 0 and the pressure is a function of the gas inside). With p_op < p_a the same linear
// law is that of an actuator that shrinks as it is evacuated, at pressures as they are: 0 < ε ≤ 1
// then.
//
// Instead, of an evacuated actuator all pressures, here and of whatever empties it, are told as
// their mirror images at ambient, P = 2·p_a − p: the deeper the vacuum the higher P, "to inflate"
// is to evacuate, and a vacuum pump is a compressor that delivers what it takes in. What is filled
// is then the lack of gas; every order of pressures, volumes and flows is that of pressure, and
// only two laws change: the gas inside, (2·p_a − P)·V, and the flow (MirrorPa below). Valid: 0 < ε
// ≤ 1, the linear law, p_a < P_op < 2·p_a.
struct Chamber {
  double rest_volume_m3 = 0.0;
  double expansion_ratio = 1.0;
  double operating_pressure_pa = 0.0;  // absolute
  double ambient_pressure_pa = kReferencePressurePa;
  double dead_volume_m3 = 0.0;  // rigid, at the actuator
  MonotoneCurve volume_curve;   // absolute Pa → m³; empty: the linear law
  bool evacuated = false;
  // Of an actuator under pressure that is pulled below ambient: where it rests, and what it empties
  // into; 0: ambient pressure. Its volume follows the law below ambient, too, and must stay above
  // 0.
  double low_pressure_pa = 0.0;
  double exhaust_pressure_pa = 0.0;
  bool operator==(const Chamber&) const = default;
};

// The first reason why the chamber is outside the valid range, or empty.
std::string WhyInvalid(const Chamber& chamber);

// Where strokes begin, and what they empty into.
inline double RestPa(const Chamber& chamber) {
  return chamber.low_pressure_pa > 0.0 ? chamber.low_pressure_pa : chamber.ambient_pressure_pa;
}
inline double ExhaustPa(const Chamber& chamber) {
  return chamber.exhaust_pressure_pa > 0.0 ? chamber.exhaust_pressure_pa
                                           : chamber.ambient_pressure_pa;
}

// Volume of actuator and dead volume, m³, at absolute pressure.
double Volume(const Chamber& chamber, double pressure_pa);
double VolumeSlope(const Chamber& chamber, double pressure_pa);  // dV/dp, m³/Pa

// 2·p_a, what pressures are mirrored at, or 0. An element that passes q(p_1, p_2) from p_1 down to
// p_2 passes q(M − P_2, M − P_1) from the image P_1 down to P_2.
inline double MirrorPa(const Chamber& chamber) {
  return chamber.evacuated ? 2.0 * chamber.ambient_pressure_pa : 0.0;
}
// By how much the operating pressure is from ambient, above 0.
inline double Span(const Chamber& chamber) {
  const double span_pa = chamber.operating_pressure_pa - chamber.ambient_pressure_pa;
  return span_pa < 0.0 ? -span_pa : span_pa;
}
// Whether it is full below ambient, with its pressures as they are.
inline bool Shrinks(const Chamber& chamber) {
  return !chamber.evacuated && chamber.operating_pressure_pa < chamber.ambient_pressure_pa;
}
// The same chamber with its pressures as they are.
Chamber Unmirrored(Chamber chamber);

// p·V(p) in Pa·m³, what the mass balance counts, and its slope W(p) = V + p·dV/dp in m³. Of an
// evacuated one −(M − P)·V(P) and W(P) = V − (M − P)·dV/dP.
double Content(const Chamber& chamber, double pressure_pa);
double ContentSlope(const Chamber& chamber, double pressure_pa);

// W(p) = a + b·p of the linear law.
struct LinearContent {
  double a = 0.0, b = 0.0;  // m³, m³/Pa
};
LinearContent LinearContentSlope(const Chamber& chamber);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_PHYSICS_CHAMBER_H_
