// A front in two amounts of parts (mass, volume, cost), from one tree of boxes.
//
// Each box has the least that it may take of either amount, and a bound on any weighted sum of the
// two. It is worth a look as long as its corner lies below some gap of the stairs that the points
// found so far make, in both amounts and in the weighted sum. The weighted sum counts most: it
// takes all that is known of a box's needs, and where the weights are those of the line through two
// neighbouring points of the front's convex hull, few boxes lie below that line.
//
// So the front is found region by region, from one between its two ends: the search goes by the sum
// with the weights of the line through the region's ends, lowest bound first. The first point that
// comes out lies on the hull; where it lies well below the line it divides the region, else the
// search goes on to the points above the hull until no box is left that any gap admits. A sized
// leaf that comes out and lies in a gap is a point of the front, since what would beat it has a
// lower sum. The boxes go from region to region, and what is known of a box but for its bound
// (strokes, needs, source pressures) serves all weights. A box that no gap of a region admits
// belongs to no part of it.
#ifndef PLENUM_OPTIMIZER_FRONT_FRONT_TREE_H_
#define PLENUM_OPTIMIZER_FRONT_FRONT_TREE_H_

#include <array>

#include "optimizer/front/front_walk.h"

namespace plenum::optimizer {

// All points with less than `first`, a point with the least of amounts[0], has of amounts[1]; in no
// order, with some that others beat within a tie. Neither amount may be energy, which depends on
// the settings.
FrontPart GrowFront(const Problem& problem, std::array<Amount, 2> amounts,
                    std::array<double, 2> first, const SearchOptions& options);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_FRONT_FRONT_TREE_H_
