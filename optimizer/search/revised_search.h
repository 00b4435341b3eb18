// Exact best-k under a revised model: the base model enumerates, the revised one decides.
#ifndef PLENUM_OPTIMIZER_SEARCH_REVISED_SEARCH_H_
#define PLENUM_OPTIMIZER_SEARCH_REVISED_SEARCH_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Designs of the relaxed problem (relaxation.h) come in the order of its objective, which bounds
// the revised one from below. Each is sized again with the effects in the simulator. When the next
// cannot be better than the last place, the list is complete. `optimal` and `infeasible` are only
// said where the relaxation is proved; else the answer is `feasible` and bounds nothing. The record
// of a proof is not kept.
Answer SearchRevised(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_REVISED_SEARCH_H_
