// A Pareto front as a value: its designs, and which regions of the amounts may hide more.
#ifndef PLENUM_OPTIMIZER_PROBLEM_PARETO_FRONT_H_
#define PLENUM_OPTIMIZER_PROBLEM_PARETO_FRONT_H_

#include <vector>

#include "optimizer/problem/amount.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// A region that may hide points of the front: designs within all `limits` (per amount of the front,
// +∞ where none) whose amount `least_of` is at least `least`.
struct Unexplored {
  std::vector<double> limits;
  Amount least_of;
  double least = 0.0;
};

struct Front {
  // Status, designs of the front by rising Problem::objective, conflicts if there are none. The
  // proof's counts and bound are those of the first search, which has no limits but the problem's.
  Answer answer;
  std::vector<Amount> amounts;
  // A design whose amounts, but for a minimised one, all lie above those of a point of the front by
  // less than this share may be missing.
  double resolution = 0.0;
  int searches = 0, proved = 0;
  std::vector<Unexplored> unexplored;  // empty: the front is whole
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_PROBLEM_PARETO_FRONT_H_
