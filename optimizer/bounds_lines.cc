// What is known of boxes of lines, whatever the source: whether their strokes may be in time, their
// least objective, and the line of their corner, once for all boxes that share them.
#include <algorithm>
#include <queue>

#include "optimizer/box.h"
#include "optimizer/line.h"
#include "optimizer/make_line.h"

namespace plenum::optimizer {
namespace {

constexpr std::size_t kLinesKept = 400000;

}  // namespace

std::size_t Bounds::LineKey::Hash::operator()(const LineKey& key) const {
  std::size_t hash = static_cast<std::size_t>(key.group);
  for (int node : key.nodes) hash = (hash ^ static_cast<std::size_t>(node)) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 32);
}

Bounds::KnownLine& Bounds::KnowLine(const LineKey& key) {
  const auto [entry, fresh] = lines_.try_emplace(key);
  KnownLine& known = entry->second;
  if (!fresh && known.weights == weights_) return known;
  const LineParts parts = PartsOf(key);
  const auto& [tube, fitting, valve] = parts.corners;
  known.objective = tube.objective + valve.objective + fitting.objective;
  known.weights = weights_;
  known.least = false;
  if (known.line) known.line->objective = known.objective;
  if (!fresh) return known;
  known.missed = ScreenLine(problem_, key.group, gas_, parts.corners, parts.single());
  if (known.missed == Constraint::kNone && parts.single()) {
    const auto [tubing, fittings, valves] = parts.choices();
    if (!PartsMate(problem_, tubing, fittings, valves)) known.missed = Constraint::kMating;
  }
  return known;
}

bool Bounds::LineParts::single() const {
  return std::all_of(nodes.begin(), nodes.end(), [](const BoxNode* n) { return n->single(); });
}

int Bounds::LineParts::widest() const {
  const auto spread = [](const BoxNode* node) {
    return node->single() ? -1.0 : node->objective_high - node->objective_low;
  };
  return static_cast<int>(
      std::max_element(nodes.begin(), nodes.end(),
                       [&](const BoxNode* a, const BoxNode* b) { return spread(a) < spread(b); }) -
      nodes.begin());
}

std::array<int, kSlotsPerGroup> Bounds::LineParts::choices() const {
  return {trees.tubes.options[nodes[0]->first].index, trees.fittings.options[nodes[1]->first].index,
          trees.valves.options[nodes[2]->first].index};
}

Bounds::LineParts Bounds::PartsOf(const LineKey& key) const {
  const GroupTrees& trees = plan_.groups[key.group];
  const auto [tube, fitting, valve] = key.nodes;
  return {{&trees.tubes.nodes[tube], &trees.fittings.nodes[fitting], &trees.valves.nodes[valve]},
          {trees.tubes.corners[tube], trees.fittings.corners[fitting], trees.valves.corners[valve]},
          trees};
}

// The limits of fall and rise and what mates with what already rule out the lightest lines of a
// box, each slot's lightest choice put together. A box's least objective is that of the part that
// is looked at next when lines alone are searched best first; after so many divisions it mostly is
// the true one.
Constraint Bounds::FindLeastObjective(const LineKey& key, double& objective) {
  constexpr int kDivisions = 500;
  using Open = std::pair<double, LineKey>;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open;
  open.push({objective, key});
  Constraint missed = Constraint::kNone;
  for (int division = 0; division < kDivisions && !open.empty(); ++division) {
    const auto [above, lowest] = open.top();
    const LineParts parts = PartsOf(lowest);
    if (parts.single()) break;
    open.pop();
    const int widest = parts.widest();
    for (int child : {parts.nodes[widest]->left, parts.nodes[widest]->right}) {
      LineKey part = lowest;
      part.nodes[widest] = child;
      const KnownLine& known = KnowLine(part);
      if (known.missed == Constraint::kNone)
        open.push({std::max(above, known.objective), part});
      else if (missed == Constraint::kNone || missed == Constraint::kMating)
        missed = known.missed;
    }
  }
  if (open.empty()) return missed;
  objective = open.top().first;
  return Constraint::kNone;
}

Bounds::LineKey Bounds::KeyOf(const Box& box, int group) {
  const int first = kSlotsPerGroup * group;
  return {group, {box.nodes[first], box.nodes[first + 1], box.nodes[first + 2]}};
}

std::shared_ptr<Line> Bounds::Assemble(const LineKey& key) const {
  const LineParts parts = PartsOf(key);
  auto line = std::make_shared<Line>(AssembleLine(problem_, key.group, parts.corners));
  if (!parts.single()) return line;
  const auto [tubing, fitting, valve] = parts.choices();
  line->tubing = tubing;
  line->fitting = fitting;
  line->valve = valve;
  return line;
}

Constraint Bounds::RemakeLine(Box& box, int group) {
  if (lines_.size() > kLinesKept) lines_.clear();
  const LineKey key = KeyOf(box, group);
  KnownLine& known = KnowLine(key);
  if (known.missed == Constraint::kNone && !known.line) known.line = Assemble(key);
  box.lines[group] = known.line;
  box.lines_finished = false;
  return known.missed;
}

Constraint Bounds::FinishLines(Box& box) {
  box.lines_finished = true;
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const LineKey key = KeyOf(box, g);
    KnownLine& known = KnowLine(key);
    if (known.missed == Constraint::kNone && !known.finished) {
      known.finished = known.least = true;
      known.missed = FindLeastObjective(key, known.objective);
      const LineParts parts = PartsOf(key);
      if (known.missed == Constraint::kNone) {
        if (!known.line) known.line = Assemble(key);
        known.line->objective = known.objective;
        FinishLine(problem_, g, gas_, parts.corners.valve, parts.single(),
                   plan_.configuration == Configuration::kCompressor, *known.line);
      } else {
        known.line = nullptr;
      }
    }
    box.lines[g] = known.line;
    if (known.missed != Constraint::kNone) return known.missed;
  }
  return Constraint::kNone;
}

}  // namespace plenum::optimizer
