// The search without the analysis of conflicts that follows an infeasible one.
#ifndef PLENUM_OPTIMIZER_TREE_SEARCH_H_
#define PLENUM_OPTIMIZER_TREE_SEARCH_H_

#include "optimizer/problem.h"

namespace plenum::optimizer {

Answer SearchTrees(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_TREE_SEARCH_H_
