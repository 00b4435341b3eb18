// What a design takes from outside and has no part for: power from the wall or the robot (power.h),
// and a vacuum from the wall. Neither stands in a parts list; to the search the one is a battery
// and the other a regulator that the catalogue does not have.
//
// The wall's vacuum has one pressure, whatever is drawn up to its flow, so that its port is a
// regulator at that pressure alone, without mass and price, that passes a thousand times what lines
// do (an error of 1e-6 of the pressure).
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_OUTSIDE_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_OUTSIDE_H_

#include <string>

#include "optimizer/problem/problem.h"

namespace plenum::api {

// Whether actuators may be evacuated by the wall.
bool HasWallVacuum(const optimizer::Problem& problem);

// Puts what is outside in the place of the parts that the problem has no choice of.
void ReplaceOutside(const optimizer::Problem& problem, model::Parts& parts);

// Whether the row stands for it.
bool IsOutside(const optimizer::Choice& choice, const optimizer::Problem& problem);
// Why such a row is none that the problem has; empty: it is one.
std::string WhyNotOutside(const optimizer::Choice& choice, const optimizer::Problem& problem);

// Adds these rows to a design as the user sees it.
void AddOutside(const optimizer::Problem& problem, optimizer::Design& design);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_OUTSIDE_H_
