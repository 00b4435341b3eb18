// Designs of the same groups in turns, as a way to designs of groups at once on a pump's reservoir.
//
// Strokes that meet on one reservoir take a simulation for each look at a source, those of groups
// that take turns do not. Parts that suit the groups in turns mostly suit them at once as well, or
// their lines or their source do.
#ifndef PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_
#define PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_

#include <functional>
#include <vector>

#include "optimizer/bounds/box.h"

namespace plenum::optimizer {

// Whether strokes meet on a reservoir that pumps keep, so that the same in turns is cheaper.
bool IsCheaperInTurns(const Problem& problem, Configuration configuration);
// The problem of this configuration alone, its groups in turns without gaits, and a short list.
Problem InTurns(const Problem& problem, Configuration configuration);
// Boxes like its designs, as the search `solve` finds them; none where it would not be cheaper.
using Solve = std::function<Answer(const Problem&, const SearchOptions&)>;
std::vector<Box> LikeInTurns(const Problem& problem, const Bounds& bounds, SearchOptions options,
                             const Solve& solve);

// Boxes of a plan, not assessed, with the parts of each design: all but the battery, then its lines
// with any source, then its source with any lines. What the plan has left out stays open.
std::vector<Box> BoxesLike(const Problem& problem, const Bounds& bounds,
                           const std::vector<Design>& designs);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SEARCH_IN_TURNS_H_
