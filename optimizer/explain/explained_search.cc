#include "optimizer/explain/explained_search.h"

#include <algorithm>
#include <chrono>

#include "optimizer/evaluate/line.h"
#include "optimizer/explain/conflict.h"
#include "optimizer/explain/variants.h"
#include "optimizer/problem/amount.h"
#include "optimizer/search/tree_search.h"

namespace plenum::optimizer {
namespace {

// Of the time limit, that a list of kinds leaves for the best of each configuration and of
// products.
constexpr double kBestsShare = 0.1;

}  // namespace

Answer Search(const Problem& problem, const SearchOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Problem searched = problem;
  SearchOptions of_list = options;
  if (problem.list == ListOf::kKinds) of_list.time_limit_s *= 1.0 - kBestsShare;
  Answer answer = SearchTrees(searched, of_list);
  if (answer.status == Status::kInfeasible && PricesNeeded(problem)) {
    AllowUnpriced(searched);
    SearchOptions left = options;
    left.time_limit_s = std::max(0.0, of_list.time_limit_s - seconds());
    answer = SearchTrees(searched, left);
  }
  answer.lower_bound_prices = searched.unpriced_allowed;
  if (answer.status == Status::kInfeasible && options.progress)
    options.progress({.seconds = seconds(),
                      .evaluated = static_cast<long long>(answer.proof.evaluated.ToDouble()),
                      .best = {},
                      .infeasible = true});
  if (answer.status == Status::kInfeasible)
    answer.infeasibility = FindConflicts(searched, options, seconds());
  if (searched.list == ListOf::kKinds && !answer.designs.empty()) {
    AddBests(searched, options, seconds(), answer);
    AddVariants(searched, options, seconds(), answer);
  }
  answer.seconds = seconds();
  return answer;
}

}  // namespace plenum::optimizer
