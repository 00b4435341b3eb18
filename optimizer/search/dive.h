// Depth first into one configuration: good designs soon, and nothing proved.
#ifndef PLENUM_OPTIMIZER_SEARCH_DIVE_H_
#define PLENUM_OPTIMIZER_SEARCH_DIVE_H_

#include <functional>

#include "optimizer/search/ranking.h"
#include "optimizer/search/search_node.h"

namespace plenum::optimizer {

// Adds what it finds to the ranking until `stop` says so; the first design is enough if `any`.
void Dive(const Problem& problem, Bounds& bounds, bool any, const std::function<bool()>& stop,
          Ranking& ranking);

// Work of a dive: a look at a box is one step, a step of sizing a design as many as take its time.
struct DiveSteps {
  long long left;       // are taken off
  long long of_design;  // at most; one that is harder to size is left to the search
};

// The same from a box on: along the lower bounds but for so many turns, until no steps are left.
void DiveFrom(Box box, int turns, const Problem& problem, Bounds& bounds,
              const std::function<bool()>& stop, DiveSteps& steps, Ranking& ranking);

// From the boxes that come out of a search's queue next, which stay in it, then off the way from
// those that led to better designs; not for longer than a share of what the search has done.
void DiveFromNext(Queue<NodePtr, LowestBound>& open, const Problem& problem,
                  const std::function<bool()>& stop, long long boxes_done, Ranking& ranking);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_DIVE_H_
