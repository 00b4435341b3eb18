// What the catalogue reaches of one demand while the others stand as they are.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_REACH_H_
#define PLENUM_OPTIMIZER_EXPLAIN_REACH_H_

#include <chrono>
#include <optional>

#include "optimizer/explain/demands.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Searches of an analysis within one time limit.
class TrialSearch {
 public:
  TrialSearch(const SearchOptions& options, double limit_s);

  // Some design that meets the problem, or the proof that there is none, or neither in time.
  Answer Any(const Problem& problem) { return Run(ForAnyDesign(problem), true); }
  // The best design by an objective of its own.
  Answer Best(Problem problem, const Objective& objective);

  bool OutOfTime() const;

 private:
  double Left() const;
  Answer Run(const Problem& problem, bool any_design);

  SearchOptions options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double limit_s_;
};

struct Reach {
  std::optional<double> best;  // a design was found with this; none: with no value
  double bound = 0.0;          // proved: with this, and all that is harder, there is none
};

// The least loosening of a number: `problem` is infeasible with the value required. By halving on a
// log scale, to 0.2 %; a feasible search moves to what its design achieves. Rounded to five digits
// to the easy side.
Reach FindReach(const Problem& problem, const Demand& demand, TrialSearch& search);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_REACH_H_
