// Why a problem is infeasible.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_
#define PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_

#include <vector>

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// A smallest set of requirements that cannot be met together (each one dropped makes the rest
// feasible), found by dropping them one by one; and for each the best that the catalogue reaches
// while the others hold. `used_s` of the time limit are gone; when it ends the set may be larger
// than needed and bests may be missing.
std::vector<Conflict> FindConflict(const Problem& problem, const SearchOptions& options,
                                   double used_s);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_
