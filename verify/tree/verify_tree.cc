#include "verify/tree/verify_tree.h"

#include <set>

#include "verify/corner/verify_dominance.h"
#include "verify/design/verify_kinds.h"

namespace plenum::verify {
namespace {

std::string In(const ProofPlan& plan) { return std::string(" (") + Name(plan.configuration) + ")"; }

using Key = std::pair<int, int>;
Key KeyOf(const ProofItem& item) { return {item.part, item.part == -1 ? 0 : item.quantity}; }

void CheckSlot(const Problem& problem, const ProofPlan& plan, const ProofSlot& slot,
               const std::vector<ProofItem>& entries, Findings& findings) {
  const std::string where = std::string(Name(slot.family)) + In(plan);
  std::multiset<Key> expected, found;
  for (const ProofItem& item : entries) expected.insert(KeyOf(item));
  std::set<Key> choices;
  for (const ProofItem& item : slot.choices) {
    found.insert(KeyOf(item));
    choices.insert(KeyOf(item));
  }
  for (const ProofDominated& dominated : slot.dominated) found.insert(KeyOf(dominated.item));
  if (found != expected) {
    findings.push_back({"choices", where + ": the choices and those left out are not the family"});
    return;
  }
  for (const ProofDominated& dominated : slot.dominated) {
    std::set<Key> different;
    std::set<std::string> series;
    const std::string own = SeriesName(problem, slot.family, dominated.item.part);
    bool same = false;
    for (const ProofItem& dominator : dominated.dominators) {
      different.insert(KeyOf(dominator));
      const std::string name = SeriesName(problem, slot.family, dominator.part);
      same = same || name == own;
      series.insert(name);
      if (!choices.contains(KeyOf(dominator)) ||
          !Dominates(problem, plan, slot, dominator, dominated.item))
        findings.push_back({"dominance", where + ": a choice left out is not dominated"});
    }
    const bool enough = ListsKinds(problem) ? same || AreEnough(problem, slot, series.size())
                                            : static_cast<int>(different.size()) >= problem.count;
    if (!enough)
      findings.push_back({"dominance", where + ": a choice left out has too few dominators"});
  }
}

class Walk {
 public:
  Walk(const ProofPlan& plan, Findings& findings) : plan_(plan), findings_(findings) {}

  std::vector<ClosedBox> Run() {
    Ranges all;
    for (const ProofSlot& slot : plan_.slots)
      all.emplace_back(0, static_cast<int>(slot.choices.size()));
    std::vector<Ranges> open{all};
    for (const ProofBox& box : plan_.boxes) {
      if (open.empty()) return Fail("more boxes than the tree has");
      const Ranges ranges = std::move(open.back());
      open.pop_back();
      if (box.kind != BoxKind::kSplit) {
        closed_.push_back({box, ranges});
        continue;
      }
      if (box.slot < 0 || box.slot >= static_cast<int>(ranges.size()))
        return Fail("a split of a slot that is not there");
      const auto [first, last] = ranges[box.slot];
      if (box.middle <= first || box.middle >= last) return Fail("a split outside its box");
      Ranges left = ranges, right = ranges;
      left[box.slot].second = right[box.slot].first = box.middle;
      open.push_back(std::move(right));
      open.push_back(std::move(left));
    }
    if (!open.empty()) return Fail("boxes are missing");
    return std::move(closed_);
  }

 private:
  std::vector<ClosedBox> Fail(const std::string& why) {
    findings_.push_back({"boxes", why + In(plan_)});
    return {};
  }

  const ProofPlan& plan_;
  Findings& findings_;
  std::vector<ClosedBox> closed_;
};

}  // namespace

BigCount CountOf(const Ranges& ranges) {
  BigCount count = 1;
  for (const auto& [first, last] : ranges) count *= last - first;
  return count;
}

std::vector<ClosedBox> Replay(const ProofPlan& plan, Findings& findings) {
  return Walk(plan, findings).Run();
}

void CheckSlots(const Problem& problem, const ProofPlan& plan, Pruned& counts, Findings& findings) {
  std::set<std::pair<Family, int>> expected, found;
  for (const ProofSlot& slot : EmptyPlan(problem, LayoutOf(plan)).slots)
    expected.insert({slot.family, slot.group});
  for (const ProofSlot& slot : plan.slots) found.insert({slot.family, slot.group});
  if (found != expected || found.size() != plan.slots.size()) {
    findings.push_back({"choices", "the slots are not one for each family" + In(plan)});
    return;
  }
  BigCount priced = 1, kept = 1;
  for (const ProofSlot& slot : plan.slots) {
    const std::vector<ProofItem> entries = EntriesOf(problem, LayoutOf(plan), slot);
    CheckSlot(problem, plan, slot, entries, findings);
    priced *= entries.size();
    kept *= slot.choices.size();
  }
  counts.unpriced += Combinations(problem, LayoutOf(plan)) - priced;
  counts.dominated += priced - kept;
}

}  // namespace plenum::verify
