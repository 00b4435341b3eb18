// Exact best-k by branch and bound over boxes.
//
// All configurations' boxes wait in one queue, the one with the lowest bound first, and so does a
// configuration that is not planted yet (configurations.h). A box that comes out is divided, and
// the corner of each part is assessed; a single combination is sized. When the lowest bound lies
// above the last place of the list no box can improve it, and the list is complete. Boxes that only
// tie with the last place are searched in the order of ties instead (tie_key.h): that ends as soon
// as no box can hold an earlier combination.
#ifndef PLENUM_OPTIMIZER_SEARCH_BOX_SEARCH_H_
#define PLENUM_OPTIMIZER_SEARCH_BOX_SEARCH_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Of a problem without effects.
Answer SearchBoxes(const Problem& problem, const SearchOptions& options);

// The best combinations as they were sized, in order, without what the simulator says of them.
struct Listed {
  std::vector<Variant> combinations;
  bool complete = false;  // the search came to its end, and no combination stayed undecided
  long long steps = 0;    // that it took
};
Listed ListCombinations(const Problem& problem, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_BOX_SEARCH_H_
