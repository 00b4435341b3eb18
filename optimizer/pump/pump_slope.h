// How power and energy per air of a pump change with pressure.
//
// Let m be the air pumped since the reservoir was full at the stop pressure, as content. In m the
// pressures of reservoir and chambers keep order (dp/dm = q/Q and ds/dm = (1 − Σq/Q)/V, each
// non-falling in the other pressures). Two stop pressures Δ apart that start with equal chambers
// have V·(s₂ − s₁) + Σ(c₂ − c₁) = V·Δ at every m, with c₂ ≥ c₁: every bit of air is pumped at no
// lower a pressure, and at most Δ higher. So a higher stop takes no less time, since Q falls with
// pressure, and its energy falls by at most Δ times the air of a cycle times the steepest fall of
// P/Q. Groups that take turns, one at a time, start by the clock: a phase in which the reservoir
// becomes full goes as above, and in one in which it does not the pumps run all the time at no
// lower a pressure and at most Δ higher, so that energy falls by at most Δ times the phase times
// the steepest fall of P.
//
// A chamber whose valve cannot hold draws until half of the period is over, not until it is full to
// the same pressure. Pressures keep order in time, too: with the higher stop it ends fuller, and
// since Q falls with pressure less was pumped by then. From there on it is c₂ that stays, above
// all that c₁ comes to, so that what is said above holds for the air that the lower stop takes, and
// the higher one takes more on top.
#ifndef PLENUM_OPTIMIZER_PUMP_PUMP_SLOPE_H_
#define PLENUM_OPTIMIZER_PUMP_PUMP_SLOPE_H_

#include <vector>

#include "model/physics/compressor.h"

namespace plenum::optimizer {

// Whether electrical power, and power over delivery, do not fall with pressure in between. Between
// the points of the pump's tables both are cubics, so that the sign of (P/Q)' is that of the
// polynomial P'·Q − P·Q' of degree 5, decided by its Bézier points; where they do not decide after
// many halvings, it counts as falling.
bool PowerRises(const model::CompressorCurve& curve, double low_pa, double high_pa);
bool EnergyPerAirRises(const model::CompressorCurve& curve, double low_pa, double high_pa);

// Bounds from above on how steeply P (W/Pa) and P/Q (J/(m³·Pa), one pump) fall anywhere between
// `low_pa` and a pressure; 0 where they do not.
class SteepestFall {
 public:
  SteepestFall() = default;  // nothing falls
  SteepestFall(const model::CompressorCurve& curve, double low_pa, double high_pa);
  double Power(double to_pa) const;
  double EnergyPerAir(double to_pa) const;

 private:
  struct Cell {
    double begin_pa, power, energy_per_air;  // the steepest up to the end of the cell
  };
  const Cell* At(double to_pa) const;
  std::vector<Cell> cells_;
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PUMP_PUMP_SLOPE_H_
