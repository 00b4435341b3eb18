// What drives pumps, valves and regulators: batteries of the catalogue, a supply from the wall, or
// the robot's. The latter two weigh and cost nothing and stand in no parts list; to the search they
// are a battery that the catalogue does not have.
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_POWER_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_POWER_H_

#include "api/json/json.h"
#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// "power" of the requirements' supply.
void ReadPower(Reader& supply, optimizer::Problem& problem);

// In place of the batteries: the robot's supply; or of the wall one for each voltage that a pump of
// `parts` asks for.
void ReplaceBatteries(const optimizer::Problem& problem, model::Parts& parts);

// Whether the problem has no batteries to choose from; and whether the row stands for what it has
// in their place.
bool HasOutsidePower(const optimizer::Problem& problem);
bool IsOutsidePower(const optimizer::Choice& choice, const optimizer::Problem& problem);

// Adds the row to a design as the user sees it, where its configuration has one.
void AddOutsidePower(const optimizer::Problem& problem, optimizer::Design& design);

// What the design takes from there: null with batteries, else the kind, and the voltage of its
// pump.
Json RenderPower(const optimizer::Design& design, const optimizer::Problem& problem);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_POWER_H_
