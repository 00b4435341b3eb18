// The exact Pareto front of a problem in two or three amounts: designs of which no other is as good
// in every amount and better in one.
#ifndef PLENUM_OPTIMIZER_FRONT_PARETO_H_
#define PLENUM_OPTIMIZER_FRONT_PARETO_H_

#include <vector>

#include "optimizer/problem/pareto_front.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// By the ε-constraint method: the least of one amount within limits on the others, by an exact
// search; then again in each of the regions where one of the others is lower than what was found,
// until every region is proved empty. A region's answer also serves any smaller region that holds
// it. Points that a later search finds to be matched or beaten in every amount are dropped, so that
// ties leave no weakly dominated point. (Kirlik and Sayın 2014, with overlapping regions in place
// of their partition.) With two amounts the regions are nested, and one search from each end goes
// through all of them (front_walk.h); each of its points counts as a search, and so does the last
// proof that there are no more.
//
// `optimal` only when every search was proved; a search that runs out of time leaves its region in
// `unexplored`. Where the volume of a made-to-measure reservoir trades against energy the front is
// a curve: it is sampled at a resolution of 1 %.
//
// `explain` is asked where there is no design at all; an empty one leaves the conflicts out.
Front ParetoFront(const Problem& problem, const std::vector<Amount>& amounts,
                  const SearchOptions& options, const FindConflictsFunction& explain = {});

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_PARETO_H_
