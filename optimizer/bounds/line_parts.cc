#include "optimizer/bounds/line_parts.h"

#include <algorithm>

namespace plenum::optimizer {

double LineParts::objective() const {
  return nodes[0]->objective_low + nodes[2]->objective_low + nodes[1]->objective_low;
}

bool LineParts::single() const {
  return std::all_of(nodes.begin(), nodes.end(), [](const BoxNode* n) { return n->single(); });
}

int LineParts::widest() const {
  const auto spread = [](const BoxNode* node) {
    return node->single() ? -1.0 : node->objective_high - node->objective_low;
  };
  return static_cast<int>(
      std::max_element(nodes.begin(), nodes.end(),
                       [&](const BoxNode* a, const BoxNode* b) { return spread(a) < spread(b); }) -
      nodes.begin());
}

std::array<int, kSlotsPerGroup> LineParts::places() const {
  return {nodes[0]->first, nodes[1]->first, nodes[2]->first};
}

bool LineParts::HoldAll(const std::vector<LineChoice>& choices) const {
  return std::all_of(choices.begin(), choices.end(), [&](const LineChoice& choice) {
    for (int s = 0; s < kSlotsPerGroup; ++s)
      if (choice.places[s] < nodes[s]->first || choice.places[s] >= nodes[s]->last) return false;
    return true;
  });
}

std::array<int, kSlotsPerGroup> LineParts::choices() const {
  return {trees.tubes.options[nodes[0]->first].index, trees.fittings.options[nodes[1]->first].index,
          trees.valves.options[nodes[2]->first].index};
}

LineParts PartsOf(const GroupTrees& trees, const KnownLines::Nodes& nodes) {
  const auto [tube, fitting, valve] = nodes;
  return {{&trees.tubes.nodes[tube], &trees.fittings.nodes[fitting], &trees.valves.nodes[valve]},
          {trees.tubes.corners[tube], trees.fittings.corners[fitting], trees.valves.corners[valve]},
          trees};
}

}  // namespace plenum::optimizer
