#include "optimizer/explain/explained_search.h"

#include <chrono>

#include "optimizer/explain/conflict.h"
#include "optimizer/search/tree_search.h"

namespace plenum::optimizer {

Answer Search(const Problem& problem, const SearchOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Answer answer = SearchTrees(problem, options);
  if (answer.status == Status::kInfeasible)
    answer.infeasibility = FindConflicts(problem, options, answer.seconds);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return answer;
}

}  // namespace plenum::optimizer
