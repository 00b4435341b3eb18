#include "optimizer/search/recorder.h"

namespace plenum::optimizer {

int Recorder::Start(const Plan& plan) {
  if (!wanted_) return -1;
  entries_.push_back({});
  roots_.push_back({&plan, static_cast<int>(entries_.size()) - 1});
  return roots_.back().second;
}

std::pair<int, int> Recorder::Split(int box, int slot, int middle) {
  if (!wanted_) return {-1, -1};
  const int left = static_cast<int>(entries_.size());
  entries_.resize(entries_.size() + 2);
  Entry& entry = entries_[box];
  entry.box.kind = BoxKind::kSplit;
  entry.box.slot = static_cast<std::int16_t>(slot);
  entry.box.middle = middle;
  entry.left = left;
  entry.right = left + 1;
  return {left, left + 1};
}

void Recorder::Close(int box, const ProofBox& end) {
  if (wanted_) entries_[box].box = end;
}

void Recorder::Append(int root, std::vector<ProofBox>& boxes) const {
  std::vector<int> open{root};
  while (!open.empty()) {
    const Entry& entry = entries_[open.back()];
    open.pop_back();
    boxes.push_back(entry.box);
    if (entry.left < 0) continue;
    open.push_back(entry.right);
    open.push_back(entry.left);
  }
}

std::shared_ptr<const ProofRecord> Recorder::Finish(const Problem& problem) const {
  if (!wanted_) return nullptr;
  auto record = std::make_shared<ProofRecord>();
  record->count = problem.count;
  for (const auto& [plan, root] : roots_) {
    ProofPlan proof;
    proof.configuration = plan->configuration;
    proof.own_regulators = plan->own_regulators;
    proof.equal_flow = plan->equal_flow;
    proof.tie = plan->tie;
    for (const Slot& slot : plan->slots) {
      ProofSlot choices{slot.family, slot.group, {}, slot.dominated};
      for (const Option& option : *slot.options)
        choices.choices.push_back({option.index, option.quantity});
      proof.slots.push_back(std::move(choices));
    }
    Append(root, proof.boxes);
    record->plans.push_back(std::move(proof));
  }
  return record;
}

}  // namespace plenum::optimizer
