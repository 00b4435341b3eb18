// Bounds of tanks that pumps go on filling (evaluate/refilled_tank.h), from the fullest tank and
// the best pumps of a box.
#ifndef PLENUM_OPTIMIZER_BOUNDS_REFILL_BOUND_H_
#define PLENUM_OPTIMIZER_BOUNDS_REFILL_BOUND_H_

#include "optimizer/choices/corner.h"

namespace plenum::optimizer {

// A tank before an inlet, filled as far as all may be.
struct TankAt {
  const Problem& problem;
  const BottleCorner& tank;
  double fill_max_pa = 0.0, inlet_pa = 0.0;
};

// What it gives down to the inlet pressure, m³ ANR.
double GivenM3(const TankAt& at);
// Whether that is so much, and so much of it, with no regulator behind it, down to the least
// pressure of any source.
bool Gives(const TankAt& at, double air_m3, double open_m3);
// What is left in it then, beyond the least that any tank keeps.
double LeftM3(const TankAt& at);

// The most that is left of its pressure once so much air has been taken.
double LeftPa(const TankAt& at, double air_m3);

// What pumps do for a tank that is the fullest of a box, until the last period begins: all that
// they deliver, they do above the pressure at which it keeps the air of that period. Of pumps that
// are chosen the stop pressure, energy and current are those with this tank, none of which falls
// with a smaller or emptier one. `works`: false where they do not last the mission.
struct Refilling {
  bool works = true;
  double most_m3 = 0.0;                    // ANR, over the mission
  double energy_j = 0.0, current_a = 0.0;  // at least
};
Refilling LeastRefilling(const TankAt& at, double cycle_m3, const CompressorCorner& pumps,
                         const PumpRates& rates, const Option* chosen);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_REFILL_BOUND_H_
