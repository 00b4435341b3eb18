// The search, with the reason where there is no design.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_
#define PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// SearchTrees (tree_search.h). Where prices are needed and no design has all of them, parts without
// one count as free: a missing price never makes a problem infeasible. The answer to an infeasible
// problem has its conflicts (conflict.h), a list of kinds what else there is (variants.h).
Answer Search(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_EXPLAINED_SEARCH_H_
