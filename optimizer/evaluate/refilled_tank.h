// Tanks that pumps go on filling (configuration "tank_and_pump").
//
// The tank is filled before the mission. Pumps run below their stop pressure for as much of the
// time as their duty allows (model/strokes/refill.h), and the tank may fall over the mission. When
// the last period begins it must hold, above the regulators' inlet pressure, the air of that
// period, in which pumps need not run. Behind the regulators strokes are as those of any other
// source.
//
// The stop pressure is the lowest that does, unless it is given. A fuller tank asks less of pumps
// and battery and weighs more. Where it is not given, the fill is the least with which pumps and
// battery do, a ten-thousandth above what it must keep, or more as long as a weighted energy is
// worth the air: what the pumps save by the last bit of air, their energy per air at the stop
// pressure, falls with the fill, so that the sum of both has one least.
#ifndef PLENUM_OPTIMIZER_EVALUATE_REFILLED_TANK_H_
#define PLENUM_OPTIMIZER_EVALUATE_REFILLED_TANK_H_

#include "model/strokes/refill.h"
#include "optimizer/evaluate/candidate.h"

namespace plenum::optimizer {

// Whether there are a tank and pumps, both chosen.
bool RefillsTank(const Candidate& candidate);

// At a source pressure and a fill, with the air of a period.
model::Refill RefillOf(const Problem& problem, const Candidate& candidate,
                       const OperatingPoint& point, double air_per_cycle_m3);

// What a tank that is as full as may be asks of pumps and battery, with all else.
struct AtHighestFill {
  double air_per_cycle_m3 = 0.0, energy_total_j = 0.0, energy_available_j = 0.0,
         battery_current_a = 0.0;
};
// The fill where it is not given; the highest where none will do.
double BestFillPa(const Problem& problem, const Candidate& candidate, const OperatingPoint& point,
                  const AtHighestFill& at_highest);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_REFILLED_TANK_H_
