// The two steps that every walk through boxes takes with one: divide it, or size it where it is a
// single combination.
#ifndef PLENUM_OPTIMIZER_BOUNDS_LEAF_SIZING_H_
#define PLENUM_OPTIMIZER_BOUNDS_LEAF_SIZING_H_

#include <array>
#include <memory>
#include <optional>

#include "optimizer/bounds/box.h"
#include "optimizer/sizing/custom_sizing.h"

namespace plenum::optimizer {

// Not assessed yet; the right one begins with choice `middle` of the slot.
struct Halves {
  int slot = 0, middle = 0;
  std::array<Box, 2> boxes;
};
Halves Divide(const Bounds& bounds, const Box& box, DivideFor divide_for);

// The leaf of a single combination. A made-to-measure reservoir takes a few steps at a time: until
// it is done there is none, and the box's bound rises. `sizing` is where it stands.
std::optional<Leaf> SizeLeaf(const Problem& problem, const Candidate& candidate, Box& box,
                             std::unique_ptr<CustomSizing>& sizing);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_LEAF_SIZING_H_
