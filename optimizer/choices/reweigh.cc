#include "optimizer/choices/reweigh.h"

#include <algorithm>

#include "optimizer/evaluate/line.h"

namespace plenum::optimizer {
namespace {

Amounts Most(const Amounts& a, const Amounts& b) {
  return {std::max(a.mass_kg, b.mass_kg), std::max(a.volume_m3, b.volume_m3),
          std::max(a.cost_eur, b.cost_eur)};
}

// Nodes come before those below them.
template <typename Corner>
void ReweighTree(const Objective& objective, BoxTree<Corner>& tree) {
  std::vector<Amounts> most(tree.nodes.size());
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    BoxNode& node = tree.nodes[i];
    Corner& corner = tree.corners[i];
    if (node.single()) {
      corner.objective = ObjectiveOf(objective, corner.amounts);
      node.objective_low = node.objective_high = corner.objective;
      most[i] = corner.amounts;
      continue;
    }
    const BoxNode &left = tree.nodes[node.left], &right = tree.nodes[node.right];
    node.objective_low = std::min(left.objective_low, right.objective_low);
    most[i] = Most(most[node.left], most[node.right]);
    node.objective_high = node.objective_low + ObjectiveOf(objective, most[i]) -
                          ObjectiveOf(objective, corner.amounts);
    corner.objective = node.objective_low;
  }
}

}  // namespace

void Reweigh(const Problem& problem, Plan& plan) {
  const Objective& objective = problem.objective;
  for (GroupTrees& group : plan.groups) {
    ReweighTree(objective, group.tubes);
    ReweighTree(objective, group.fittings);
    ReweighTree(objective, group.valves);
  }
  for (BoxTree<RegulatorCorner>& regulators : plan.regulators) ReweighTree(objective, regulators);
  ReweighTree(objective, plan.bottles);
  ReweighTree(objective, plan.compressors);
  ReweighTree(objective, plan.reservoirs);
  ReweighTree(objective, plan.batteries);
  ReweighTree(objective, plan.rail.pumps);
  ReweighTree(objective, plan.rail.reservoirs);
}

}  // namespace plenum::optimizer
