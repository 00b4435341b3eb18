#include "optimizer/problem/cost.h"

#include <cmath>

namespace plenum::optimizer {

bool CostCounts(const Problem& problem) {
  return problem.objective.cost_eur > 0.0 || std::isfinite(problem.cost_max_eur);
}

bool PricesNeeded(const Problem& problem) {
  return CostCounts(problem) && !problem.unpriced_allowed;
}

}  // namespace plenum::optimizer
