#include "optimizer/search/in_turns.h"

#include <algorithm>
#include <iterator>

#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/gait.h"

namespace plenum::optimizer {
namespace {

constexpr int kListed = 5;  // designs in turns

bool IsOf(const Problem& problem, const Slot& slot, const Option& option, const Choice& row) {
  if (row.family != slot.family || row.group != slot.group) return false;
  const int part = row.id == "custom" ? kCustom : FindPart(problem.parts, row.family, row.id);
  return option.index == part && (slot.group >= 0 || option.quantity == row.quantity);
}

// The leaf of the slot's tree that the design has chosen; the root where the plan lacks it.
int LeafLike(const Problem& problem, const Slot& slot, const Variant& design) {
  const std::vector<Option>& options = *slot.options;
  const auto chosen = std::find_if(options.begin(), options.end(), [&](const Option& option) {
    return std::any_of(design.parts.begin(), design.parts.end(),
                       [&](const Choice& row) { return IsOf(problem, slot, option, row); });
  });
  if (chosen == options.end()) return 0;
  return LeafOf(*slot.nodes, static_cast<int>(chosen - options.begin()));
}

}  // namespace

bool IsCheaperInTurns(const Problem& problem, Configuration configuration) {
  if (!KeepsReservoir(configuration)) return false;
  const bool phases =
      std::any_of(problem.groups.begin(), problem.groups.end(),
                  [](const ActuatorGroup& group) { return !group.gait.phases.empty(); });
  const Meeting meeting = MeetingOf(problem);
  return meeting == Meeting::kTogether || meeting == Meeting::kMixed ||
         (phases && WindowsOverlap(problem));
}

Problem InTurns(const Problem& problem, Configuration configuration) {
  Problem turns = problem;
  turns.configurations = {configuration};
  turns.simultaneous = false;
  turns.count = std::min(problem.count, kListed);
  double bursts = 1.0;
  for (ActuatorGroup& group : turns.groups)
    bursts = std::max<double>(bursts, group.gait.strokes_per_period);
  if (turns.groups.size() == 1) {
    ActuatorGroup& group = turns.groups.front();
    const int at_once = BegunAtOnce(problem);
    bursts *= static_cast<double>(group.count) / at_once;
    group.count = at_once;
    turns.actuations *= bursts;
  }
  for (ActuatorGroup& group : turns.groups) group.gait = {};
  turns.frequency_hz *= bursts;
  return turns;
}

std::vector<Box> BoxesLike(const Problem& problem, const Bounds& bounds,
                           const std::vector<Variant>& designs) {
  const std::vector<Slot>& slots = bounds.plan().slots;
  std::vector<Box> all, lines, sources;
  for (const Variant& design : designs) {
    for (std::vector<Box>* boxes : {&all, &lines, &sources}) boxes->push_back(bounds.Root());
    for (std::size_t s = 0; s < slots.size(); ++s) {
      if (static_cast<int>(s) == bounds.plan().battery_slot) continue;
      const int leaf = LeafLike(problem, slots[s], design);
      all.back().nodes[s] = leaf;
      (slots[s].group < 0 ? sources : lines).back().nodes[s] = leaf;
    }
  }
  for (std::vector<Box>* boxes : {&lines, &sources})
    std::move(boxes->begin(), boxes->end(), std::back_inserter(all));
  return all;
}

std::vector<Box> LikeInTurns(const Problem& problem, const Bounds& bounds, SearchOptions options,
                             const ListDesigns& list) {
  const Configuration configuration = bounds.plan().configuration;
  if (!IsCheaperInTurns(problem, configuration)) return {};
  options.record = false;
  options.progress = {};
  return BoxesLike(problem, bounds, list(InTurns(problem, configuration), options));
}

}  // namespace plenum::optimizer
