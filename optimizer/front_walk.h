// A front in two amounts from both of its ends.
//
// A walk is one search: the least of one amount within a limit on the other, then again within ever
// lower limits, with the boxes that are left. A box that a limit closes stays closed by a lower
// one, and bounds stay bounds. So the boxes wait in one queue, lowest bound first, a sized leaf by
// its objective: one that comes out within the limit is the next point. The limit then falls to
// that point's amount less the resolution, until the queue is empty.
//
// A walk is slow where its limit is close to the least that there is, since only real combinations
// show that nothing meets it. A second walk, with the amounts the other way round, begins there.
// What no walk has found lies at or above the lowest bound of each in the amount that it minimises,
// and within the limit that the other has come to: they have met when these exclude each other.
// The second begins where the first is long, and they take steps in turn, so that the result does
// not depend on the clock. Energy cannot be limited: a front with it is walked from one end.
#ifndef PLENUM_OPTIMIZER_FRONT_WALK_H_
#define PLENUM_OPTIMIZER_FRONT_WALK_H_

#include <vector>

#include "optimizer/pareto.h"

namespace plenum::optimizer {

struct FrontWalk {
  std::vector<Design> designs;
  // Where designs may be missing: those within the limit with at least `least` of the other amount.
  struct Open {
    Amount limited;
    double limit, least;
  };
  std::vector<Open> open;
  bool cancelled = false;
};

// Steps of the first walk before the second begins.
inline constexpr int kStepsAlone = 20000;

// `problem`: with a finite limit on `limited` to begin with; `minimised` is its objective. The
// designs hold all points of the front, in no order, and some that these beat.
FrontWalk WalkFront(const Problem& problem, Amount minimised, Amount limited, double resolution,
                    const SearchOptions& options, int steps_alone = kStepsAlone);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_WALK_H_
