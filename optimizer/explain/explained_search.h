// The search, with the reason where there is no design.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_
#define PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// SearchTrees (tree_search.h); the answer to an infeasible problem has its conflicts (conflict.h).
Answer Search(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_
