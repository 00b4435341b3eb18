// The amounts of a design that can be traded against each other: mass, volume, cost, energy.
#ifndef PLENUM_OPTIMIZER_PROBLEM_AMOUNT_H_
#define PLENUM_OPTIMIZER_PROBLEM_AMOUNT_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

enum class Amount { kMass, kVolume, kCost, kEnergy };
const char* Name(Amount amount);  // "mass_kg", "volume_l", "cost_eur", "energy_wh"

Objective ObjectiveOn(Amount amount);  // that amount alone

// In the unit of its name; NaN for the cost of parts without a price.
double Of(Amount amount, const Totals& totals);

// The problem's limit on an amount, in the same unit; energy has none.
double& LimitOn(Amount amount, Problem& problem);

// Packs that hold so many pieces of a part, or metres of a tube; 0 where any number is sold. And
// what these packs cost, 0 without a price.
double PacksFor(double quantity, const model::PartBasics& basics);
double PackCost(double quantity, const model::PartBasics& basics);

// Whether cost is minimised or limited; and whether a part without a price is then no choice.
bool CostCounts(const Problem& problem);
bool PricesNeeded(const Problem& problem);

// Lets parts without a price count as free. Where cost alone is minimised most designs then tie,
// and a kilogram counts as much as a tenth of a cent, so that the lightest of the same price is
// first: designs whose known prices differ by less than that may change places.
void AllowUnpriced(Problem& problem);

// Objectives within this relative distance are ties: 1e-6; 1e-9 where a kilogram counts as a tenth
// of a cent, as a millionth of a price is many grams, and no reservoir is made to measure, whose
// volume is not found as finely.
double TieOf(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_AMOUNT_H_
