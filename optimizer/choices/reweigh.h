// A plan of the same choices under another objective.
#ifndef PLENUM_OPTIMIZER_CHOICES_REWEIGH_H_
#define PLENUM_OPTIMIZER_CHOICES_REWEIGH_H_

#include "optimizer/choices/plan.h"

namespace plenum::optimizer {

// Gives the choices and boxes of the plan the shares of problem.objective, which must not count
// energy. The plan leaves out only what is dominated in every limited amount (dominance.h), so it
// serves all objectives that are sums of those.
void Reweigh(const Problem& problem, Plan& plan);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_CHOICES_REWEIGH_H_
