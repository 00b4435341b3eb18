// The search: exact best-k over all compatible combinations.
#ifndef PLENUM_OPTIMIZER_SEARCH_TREE_SEARCH_H_
#define PLENUM_OPTIMIZER_SEARCH_TREE_SEARCH_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Same problem, same answer. Without the conflicts of an infeasible problem (explained_search.h).
Answer SearchTrees(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_TREE_SEARCH_H_
