// A front in two amounts by one search: the least of the objective within a limit on the other
// amount, then again within ever lower limits, with the boxes that are left.
//
// A box that a limit closes stays closed by a lower one, and bounds stay bounds. So the boxes wait
// in one queue, lowest bound first, a sized leaf by its objective: one that comes out within the
// limit is the next point. The limit then falls to that point's amount less the resolution, until
// the queue is empty.
#ifndef PLENUM_OPTIMIZER_FRONT_WALK_H_
#define PLENUM_OPTIMIZER_FRONT_WALK_H_

#include <vector>

#include "optimizer/pareto.h"

namespace plenum::optimizer {

struct FrontWalk {
  std::vector<Design> designs;  // by rising objective
  // Where designs may be missing: those within the limit whose objective is at least `least`.
  struct Open {
    double limit, least;
  };
  std::vector<Open> open;
  bool cancelled = false;
};

// `problem`: with a finite limit on `limited` to begin with; the objective is the other amount.
FrontWalk WalkFront(Problem problem, Amount limited, double resolution,
                    const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_WALK_H_
