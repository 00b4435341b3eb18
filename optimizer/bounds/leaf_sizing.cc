#include "optimizer/bounds/leaf_sizing.h"

#include <algorithm>

#include "optimizer/bounds/core_sizing.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"

namespace plenum::optimizer {

Halves Divide(const Bounds& bounds, const Box& box, DivideFor divide_for) {
  Halves halves;
  halves.slot = bounds.WidestSlot(box, divide_for);
  const std::vector<BoxNode>& tree = *bounds.plan().slots[halves.slot].nodes;
  const BoxNode& divided = tree[box.nodes[halves.slot]];
  halves.middle = tree[divided.right].first;
  halves.boxes = {box, box};
  halves.boxes[0].nodes[halves.slot] = divided.left;
  halves.boxes[1].nodes[halves.slot] = divided.right;
  return halves;
}

namespace {

// What no settings are known to meet at the worst of the tolerances, where that worst is enclosed,
// is infeasible only if no settings meet it at the best that may be said, either.
Leaf UnlessEnclosed(const Problem& problem, const Candidate& candidate, Leaf leaf) {
  if (leaf.status != LeafStatus::kInfeasible || !WorstIsEnclosed(problem, candidate)) return leaf;
  Candidate at_best = candidate;
  at_best.at_best = true;
  LeafStatus status = LeafStatus::kUndecided;
  if (candidate.reservoir.index == kCustom) {
    CustomSizing sizing(problem, at_best);
    while (!sizing.Refine() && !candidate.stopped()) {
    }
    status = sizing.leaf().status;
  } else {
    status = SizeQuickly(problem, at_best, ReservoirVolume(problem, candidate)).status;
  }
  if (status != LeafStatus::kInfeasible) leaf.status = LeafStatus::kUndecided;
  return leaf;
}

}  // namespace

std::optional<Leaf> SizeLeaf(const Problem& problem, const Candidate& candidate, Box& box,
                             std::unique_ptr<CustomSizing>& sizing) {
  if (candidate.reservoir.index != kCustom)
    return UnlessEnclosed(problem, candidate,
                          SizeQuickly(problem, candidate, ReservoirVolume(problem, candidate)));
  if (!sizing && box.core)
    if (const std::optional<Leaf> leaf = LeafOfCore(problem, candidate, *box.core)) return leaf;
  if (!sizing) sizing = std::make_unique<CustomSizing>(problem, candidate, NeedsOf(box));
  if (sizing->Refine()) return UnlessEnclosed(problem, candidate, sizing->leaf());
  box.bound = std::max(box.bound, sizing->leaf().lower_bound);
  return std::nullopt;
}

}  // namespace plenum::optimizer
