// Whether cost is minimised or limited; and whether a part without a price is then no choice.
#ifndef PLENUM_OPTIMIZER_PROBLEM_COST_H_
#define PLENUM_OPTIMIZER_PROBLEM_COST_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

bool CostCounts(const Problem& problem);
bool PricesNeeded(const Problem& problem);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_COST_H_
