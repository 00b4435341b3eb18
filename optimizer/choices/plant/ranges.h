// What all choices of a layout can come to at most.
#ifndef PLENUM_OPTIMIZER_CHOICES_PLANT_RANGES_H_
#define PLENUM_OPTIMIZER_CHOICES_PLANT_RANGES_H_

#include "optimizer/choices/plan.h"
#include "optimizer/problem/own_regulators.h"

namespace plenum::optimizer {

// Of the objective per joule.
inline double EnergyWeight(const Problem& problem) {
  return problem.objective.energy_wh / kJoulePerWattHour;
}

// Objectives this close may tie: the tie of the largest objective there is.
double LargestTie(const Problem& problem, const Layout& layout);

// No source gives more, Pa absolute: ratings beyond it are all the same. `pump_pa`: of any pump.
double HighestUseful(const Problem& problem, Configuration configuration, double pump_pa);

BottleRange FindBottleRange(const Problem& problem, Configuration configuration);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_PLANT_RANGES_H_
