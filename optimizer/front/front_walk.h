// A front in energy and another amount from its least energy on.
//
// A walk is one search: the least of one amount within a limit on the other, then again within ever
// lower limits, with the boxes that are left. A box that a limit closes stays closed by a lower
// one, and bounds stay bounds. So the boxes wait in one queue, lowest bound first, a sized leaf by
// its objective: one that comes out within the limit is the next point. The limit then falls to
// that point's amount less the resolution, until the queue is empty.
#ifndef PLENUM_OPTIMIZER_FRONT_FRONT_WALK_H_
#define PLENUM_OPTIMIZER_FRONT_FRONT_WALK_H_

#include <array>
#include <vector>

#include "optimizer/problem/pareto_front.h"

namespace plenum::optimizer {

// What is found of a front in two amounts, the first of them minimised.
struct FrontPart {
  std::vector<Design> designs;
  // Where designs may be missing: those within both limits with at least `least` of the first.
  struct Open {
    std::array<double, 2> limits;
    double least;
  };
  std::vector<Open> open;
  bool cancelled = false;
};

// `problem`: with a finite limit on `limited` to begin with; its objective is the amount that is
// minimised. The designs hold all points of the front, in no order, and some that these beat.
FrontPart WalkFront(const Problem& problem, Amount limited, double resolution,
                    const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_FRONT_WALK_H_
