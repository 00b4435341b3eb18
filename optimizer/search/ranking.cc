#include "optimizer/search/ranking.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "optimizer/problem/family_specs.h"

namespace plenum::optimizer {
namespace {

// Id of a part of the family; empty for none.
std::string IdOf(const model::Parts& parts, Family family, int index) {
  if (index == kNone) return {};
  if (index == kCustom) return "custom";
  return BasicsOf(parts, family, index).id;
}

}  // namespace

PartIds EarliestIds(const Problem& problem, const Plan& plan, const Box& box) {
  PartIds ids;
  const auto add = [&](int s) {
    if (s < 0) return;
    const Slot& slot = plan.slots[s];
    const Option& option = (*slot.options)[(*slot.nodes)[box.nodes[s]].earliest];
    std::string id = IdOf(problem.parts, slot.family, option.index);
    if (!id.empty()) ids.emplace_back(std::move(id), option.quantity);
  };
  for (int g = 0; g < static_cast<int>(plan.groups.size()); ++g)
    for (int s : {2, 1, 0}) add(kSlotsPerGroup * g + s);  // valve, fitting, tube
  for (int s : {plan.regulator_slot, plan.bottle_slot, plan.compressor_slot, plan.battery_slot,
                plan.reservoir_slot})
    add(s);
  return ids;
}

void Ranking::Add(Found found) {
  if (found.leaf.objective > run_end_) {
    spare_.push_back(std::move(found));
    return;
  }
  list_.push_back(std::move(found));
  Sort();
}

void Ranking::Remove(std::size_t position) {
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(position));
  std::move(spare_.begin(), spare_.end(), std::back_inserter(list_));
  spare_.clear();
  Sort();
}

Found* Ranking::Find(const PartIds& ids) {
  for (std::vector<Found>* group : {&list_, &spare_})
    for (Found& found : *group)
      if (found.ids == ids) return &found;
  return nullptr;
}

double Ranking::BoundBehind() const {
  double bound = kUnlimited;
  for (const Found& found : spare_) bound = std::min(bound, found.leaf.lower_bound);
  for (std::size_t i = wanted_; i < list_.size(); ++i)
    bound = std::min(bound, list_[i].leaf.lower_bound);
  return bound;
}

void Ranking::Sort() {
  std::sort(list_.begin(), list_.end(), [](const Found& a, const Found& b) {
    return a.leaf.objective != b.leaf.objective ? a.leaf.objective < b.leaf.objective
                                                : a.ids < b.ids;
  });
  run_begin_ = run_end_ = kUnlimited;
  const std::size_t wanted = static_cast<std::size_t>(wanted_);
  for (std::size_t first = 0; first < list_.size();) {
    const double objective = list_[first].leaf.objective;
    const double limit = objective + kTie * std::abs(objective);
    std::size_t end = first;
    while (end < list_.size() && list_[end].leaf.objective <= limit) ++end;
    const auto begin = list_.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(end),
              [](const Found& a, const Found& b) { return a.ids < b.ids; });
    if (end >= wanted) {
      run_begin_ = objective;
      run_end_ = limit;
      std::move(begin + static_cast<std::ptrdiff_t>(end), list_.end(), std::back_inserter(spare_));
      list_.erase(begin + static_cast<std::ptrdiff_t>(end), list_.end());
      return;
    }
    first = end;
  }
}

}  // namespace plenum::optimizer
