// The three parts of a box of lines of one group: tube, fitting and valve.
#ifndef PLENUM_OPTIMIZER_BOUNDS_LINE_PARTS_H_
#define PLENUM_OPTIMIZER_BOUNDS_LINE_PARTS_H_

#include <array>
#include <vector>

#include "optimizer/choices/known_lines.h"
#include "optimizer/choices/make_line.h"
#include "optimizer/choices/plan.h"

namespace plenum::optimizer {

struct LineParts {
  std::array<const BoxNode*, kSlotsPerGroup> nodes;
  LineCorners corners;
  const GroupTrees& trees;
  double objective() const;
  bool single() const;
  int widest() const;  // of a box that is not single: by the share of the objective
  std::array<int, kSlotsPerGroup> choices() const;  // indices of parts, of a single one
  std::array<int, kSlotsPerGroup> places() const;   // the same, as in LineChoice
  bool HoldAll(const std::vector<LineChoice>& choices) const;
};

LineParts PartsOf(const GroupTrees& trees, const KnownLines::Nodes& nodes);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_BOUNDS_LINE_PARTS_H_
