// Why a problem is infeasible, and what would make it feasible.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_
#define PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Disjoint smallest sets of demands (demands.h) that cannot be met together: with only these in
// force no design is feasible, with any one of them dropped some is. And the relaxation: the fewest
// demands that have to give way, of these the ones with the least sum of relative changes, each
// loosened to the least that was found with the others as loose as they then are. `used_s` of the
// time limit are gone; when it ends sets may be larger than needed and bests may be missing, and
// the result is not `complete`.
Infeasibility FindConflicts(const Problem& problem, const SearchOptions& options, double used_s);

// One of these sets, with nothing of what its demands reach: in a small part of the time.
std::vector<Conflict> FindOneConflict(const Problem& problem, const SearchOptions& options,
                                      double used_s);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_CONFLICT_H_
