// A tank that is full when a mission begins and that pumps go on filling while strokes draw from
// it. Strokes are many and small beside the tank, so that their mean counts:
//   C·dp/dt = q(p) − d,   C = V/P0·(T0/T),   q(p) = N·D·Q_c(p) below the stop pressure, else 0
// with d the mean draw, Q_c the delivery of one of N pumps and D the share of the time that they
// run, all m³/s ANR. Isothermal, ideal. Pressure falls from the fill to the stop pressure at d/C.
// There the pumps hold it, where they deliver as much as is drawn; else it falls on, slower.
//
// Power counts as the largest up to a pressure, so that a pump never saves by pumping higher. The
// lowest stop pressure p_s with which the tank is at p_k or above until a time t then takes the
// least energy. In air s that is pumped before that time, counted backwards from it,
//   dp/ds = (d/q(p) − 1)/C, p(0) = p_k,   p_s = p(A),   A = d·t − C·(p_fill − p_k)
// since what the tank does not give the pumps must. Every number that makes A or the slope smaller
// lowers the pressure at each s, and so energy and stop. It is integrated in time, which stays
// finite where the pumps deliver next to nothing.
// Source: balance of mass.
#ifndef PLENUM_MODEL_STROKES_REFILL_H_
#define PLENUM_MODEL_STROKES_REFILL_H_

#include "model/physics/compressor.h"

namespace plenum::model {

struct RefillInput {
  const CompressorCurve* compressor = nullptr;
  int compressors = 1;
  double duty = 1.0;                // D, of pumps below their stop pressure
  double capacity_m3_per_pa = 0.0;  // C, ANR
  double fill_pa = 0.0;
  double kept_pa = 0.0;  // p_k
  double draw_m3_per_s = 0.0;
  double seconds = 0.0;  // t
  double stop_pa = 0.0;  // 0: the lowest that does
};

// Where the tank does not last so long, `stop_pa` is the highest, and the pumps run until then.
struct Refill {
  double stop_pa = 0.0;
  // At p_k or above, with the stop pressure that is given, else the highest; +∞ where it never
  // falls to it, below 0 of a fill that is less.
  double lasts_s = 0.0;
  double on_s = 0.0;      // that each pump runs
  double energy_j = 0.0;  // all pumps, electrical
};

// Refill::lasts_s alone, at a quarter of the cost.
double LastingSeconds(const RefillInput& input);

// To 1e-8 of times, energy and pressure. No pump delivers above its table (compressor.h).
Refill RefillTank(const RefillInput& input);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_REFILL_H_
