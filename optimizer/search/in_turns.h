// Designs of the same groups in turns, as a way to designs of groups at once on a pump's reservoir.
//
// Strokes that meet on one reservoir take a simulation for each look at a source, those of groups
// that take turns do not, nor those of one group whose actuators all begin at once. Parts that suit
// the groups in turns mostly suit them at once as well, or their lines or their source do.
#ifndef PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_
#define PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_

#include <functional>
#include <vector>

#include "optimizer/bounds/box.h"

namespace plenum::optimizer {

// Whether strokes meet on a reservoir that pumps keep, so that the same in turns is cheaper.
bool IsCheaperInTurns(const Problem& problem, Configuration configuration);
// The problem of this configuration alone, its groups in turns without gaits, and a short list. Of
// one group bursts of as many actuators as fill at once, the more often.
Problem InTurns(const Problem& problem, Configuration configuration);
// Boxes like its designs, as the search `list` has them, without a simulation of any; no boxes
// where it would not be cheaper.
using ListDesigns = std::function<std::vector<Variant>(const Problem&, const SearchOptions&)>;
std::vector<Box> LikeInTurns(const Problem& problem, const Bounds& bounds, SearchOptions options,
                             const ListDesigns& list);

// Boxes of a plan, not assessed, with the parts of each design: all but the battery, then its lines
// with any source, then its source with any lines. What the plan has left out stays open.
std::vector<Box> BoxesLike(const Problem& problem, const Bounds& bounds,
                           const std::vector<Variant>& designs);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_
