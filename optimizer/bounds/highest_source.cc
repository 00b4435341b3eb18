#include "optimizer/bounds/highest_source.h"

#include <algorithm>
#include <queue>

#include "optimizer/bounds/line_parts.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/evaluate/strokes/stroke_rig.h"

namespace plenum::optimizer {
namespace {

constexpr int kBoxesMax = 5000;

struct Open {
  double source_pa;
  KnownLines::Nodes nodes;
  bool operator<(const Open& other) const { return source_pa < other.source_pa; }
};

bool MayConflict(const Problem& problem, int group) {
  return std::any_of(problem.groups.begin(), problem.groups.end(), [&](const ActuatorGroup& other) {
    return other.chamber.operating_pressure_pa > problem.groups[group].pressure_max_pa;
  });
}

}  // namespace

double HighestSource(const Problem& problem, const Plan& plan, int g) {
  const GroupTrees& trees = plan.groups[g];
  const bool none =
      trees.tubes.nodes.empty() || trees.fittings.nodes.empty() || trees.valves.nodes.empty();
  if (none || IsDirect(plan.configuration) || !MayConflict(problem, g)) return kUnlimited;
  const model::Gas gas = GasOf(plan.configuration);
  std::priority_queue<Open> open;
  const auto look = [&](const KnownLines::Nodes& nodes) {
    const LineParts parts = PartsOf(trees, nodes);
    const bool single = parts.single();
    if (single) {
      const std::array<int, kSlotsPerGroup> choices = parts.choices();
      if (!PartsMate(problem, choices[0], choices[1], choices[2])) return;
    }
    if (ScreenLine(problem, g, gas, parts.corners, single) == Constraint::kNone)
      open.push({AssembleLine(problem, g, gas, parts.corners, single).source_max_pa, nodes});
  };
  look({0, 0, 0});
  for (int boxes = 0; !open.empty(); ++boxes) {
    const Open most = open.top();
    const LineParts parts = PartsOf(trees, most.nodes);
    if (parts.single()) return most.source_pa;
    if (boxes > kBoxesMax) return kUnlimited;
    open.pop();
    const auto size = [&](int s) { return parts.nodes[s]->size(); };
    int widest = 0;
    for (int s = 1; s < kSlotsPerGroup; ++s)
      if (size(s) > size(widest)) widest = s;
    for (const int child : {parts.nodes[widest]->left, parts.nodes[widest]->right}) {
      KnownLines::Nodes nodes = most.nodes;
      nodes[widest] = child;
      look(nodes);
    }
  }
  return 0.0;
}

double HighestSource(const Problem& problem, const Plan& plan) {
  double least_pa = kUnlimited;
  for (int g = 0; g < static_cast<int>(plan.groups.size()); ++g)
    least_pa = std::min(least_pa, HighestSource(problem, plan, g));
  return least_pa;
}

}  // namespace plenum::optimizer
