#include "optimizer/search/ranking.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

// Id of a part of the family; empty for none.
std::string IdOf(const model::Parts& parts, Family family, int index) {
  if (index == kNone) return {};
  if (index == kCustom) return "custom";
  return BasicsOf(parts, family, index).id;
}

// The configuration and the series of the sources of all combinations in the box.
std::optional<Kind::Sources> SourceAt(const Plan& plan, const Box& box) {
  Kind::Sources sources{plan.configuration, {}};
  for (const int slot : {plan.bottle_slot, plan.compressor_slot, plan.rail.pump_slot}) {
    if (slot < 0) continue;
    const int series = (*plan.slots[slot].nodes)[box.nodes[slot]].series;
    if (series < 0) return std::nullopt;
    sources.second.push_back(series);
  }
  return sources;
}

}  // namespace

TieKey EarliestKey(const Problem& problem, const Plan& plan, const Box& box) {
  TieKey key;
  const auto add = [&](int s) {
    if (s < 0) return;
    const Slot& slot = plan.slots[s];
    const BoxNode& node = (*slot.nodes)[box.nodes[s]];
    const Option& option = (*slot.options)[node.earliest];
    std::string id = IdOf(problem.parts, slot.family, option.index);
    const int bought = option.quantity * FeedsOf(problem, slot.family);
    if (!id.empty()) key.ids.emplace_back(std::move(id), bought);
    key.share += node.tie;
  };
  for (int g = 0; g < static_cast<int>(plan.groups.size()); ++g)
    for (int s : {2, 1, 0}) add(kSlotsPerGroup * g + s);  // valve, fitting, tube
  for (int s : plan.regulator_slots) add(s);
  for (int s : {plan.bottle_slot, plan.compressor_slot, plan.rail.pump_slot, plan.battery_slot,
                plan.reservoir_slot, plan.rail.reservoir_slot})
    add(s);
  key.share += TieShareOf(problem.objective, {0.0, 0.0, PackSurplus(problem, plan, box)});
  return key;
}

std::optional<Kind> KindAt(const Plan& plan, const Box& box) {
  Kind kind{.configuration = plan.configuration};
  for (std::size_t s = 0; s < plan.slots.size(); ++s) {
    const KindRole role = SpecOf(plan.slots[s].family).kind_role;
    if (role == KindRole::kApart) continue;
    const int series = (*plan.slots[s].nodes)[box.nodes[s]].series;
    if (series < 0) return std::nullopt;
    kind.Add(role, series);
  }
  return kind;
}

void Ranking::Add(Found found) {
  if (ListsKinds()) {
    found.kind = *KindAt(found.bounds->plan(), found.box);
    const auto known = kinds_.find(found.kind);
    const double end = known == kinds_.end() ? run_end_ : known->second.end;
    const bool better = found.leaf.objective <= end;
    spare_.push_back(std::move(found));
    if (better) SortKinds();
    return;
  }
  if (found.leaf.objective > run_end_) {
    spare_.push_back(std::move(found));
    return;
  }
  list_.push_back(std::move(found));
  Sort();
}

void Ranking::Remove(std::size_t position) {
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(position));
  if (ListsKinds()) {
    SortKinds();
    return;
  }
  std::move(spare_.begin(), spare_.end(), std::back_inserter(list_));
  spare_.clear();
  Sort();
}

double Ranking::LeaveOutFrom(std::size_t position) {
  double bound = kUnlimited;
  for (std::size_t i = position; i < list_.size(); ++i)
    bound = std::min(bound, list_[i].leaf.lower_bound);
  list_.erase(list_.begin() + static_cast<std::ptrdiff_t>(position), list_.end());
  std::erase_if(source_end_, [&](const auto& source) {
    return std::count_if(list_.begin(), list_.end(), [&](const Found& found) {
             return found.kind.Source() == source.first;
           }) < problem_.limits.per_source;
  });
  return bound;
}

Found* Ranking::Find(const TieKey& key) {
  for (std::vector<Found>* group : {&list_, &spare_})
    for (Found& found : *group)
      if (found.key == key) return &found;
  return nullptr;
}

bool Ranking::IsSettled(const Plan& plan, const Box& box) const {
  if (!ListsKinds()) return false;
  if (const auto source = SourceAt(plan, box)) {
    const auto end = source_end_.find(*source);
    if (end != source_end_.end() && box.bound > end->second) return true;
  }
  const std::optional<Kind> kind = KindAt(plan, box);
  const auto known = kind ? kinds_.find(*kind) : kinds_.end();
  if (known == kinds_.end() || box.bound < known->second.begin) return false;
  const Run& run = known->second;
  if (box.bound > run.end) return true;
  const TieKey earliest = EarliestKey(problem_, plan, box);
  return run.key < earliest || (run.key == earliest && run.seen);
}

BoxKind Ranking::EndOfSettled(const Plan& plan, const Box& box) const {
  const auto source = SourceAt(plan, box);
  const auto kind = KindAt(plan, box);
  const auto is_listed = [&](const Found& listed) { return kind && listed.kind == *kind; };
  return (source && source_end_.contains(*source)) ||
                 std::any_of(list_.begin(), list_.end(), is_listed)
             ? BoxKind::kKind
             : EndBehind(box.bound);
}

void Ranking::Place(Found& found, int record) {
  found.record = record;
  const auto run = kinds_.find(found.kind);
  if (ListsKinds() && run != kinds_.end() && run->second.key == found.key)
    run->second.seen = record >= 0;
}

double Ranking::BoundBehind() const {
  const auto is_listed = [&](const Found& found) {
    return source_end_.contains(found.kind.Source()) ||
           std::any_of(list_.begin(), list_.end(),
                       [&](const Found& listed) { return listed.kind == found.kind; });
  };
  double bound = kUnlimited;
  for (const Found& found : spare_)
    if (!ListsKinds() || !is_listed(found)) bound = std::min(bound, found.leaf.lower_bound);
  for (std::size_t i = wanted_; i < list_.size(); ++i)
    bound = std::min(bound, list_[i].leaf.lower_bound);
  return bound;
}

namespace {

bool ByObjective(const Found& a, const Found& b) {
  return a.leaf.objective != b.leaf.objective ? a.leaf.objective < b.leaf.objective : a.key < b.key;
}

double EndOfTies(double tie, double objective) { return objective + tie * std::abs(objective); }

// Orders the run of ties that begins at a place of designs in the order of objectives; its end.
std::size_t OrderRun(double tie, std::vector<Found>& designs, std::size_t first) {
  const double limit = EndOfTies(tie, designs[first].leaf.objective);
  std::size_t end = first;
  while (end < designs.size() && designs[end].leaf.objective <= limit) ++end;
  std::sort(designs.begin() + static_cast<std::ptrdiff_t>(first),
            designs.begin() + static_cast<std::ptrdiff_t>(end),
            [](const Found& a, const Found& b) { return a.key < b.key; });
  return end;
}

}  // namespace

void Ranking::Sort() {
  std::sort(list_.begin(), list_.end(), ByObjective);
  run_begin_ = run_end_ = kUnlimited;
  for (std::size_t first = 0; first < list_.size();) {
    const double objective = list_[first].leaf.objective;
    const std::size_t end = OrderRun(tie_, list_, first);
    if (end >= static_cast<std::size_t>(wanted_)) {
      run_begin_ = objective;
      run_end_ = EndOfTies(tie_, objective);
      const auto behind = list_.begin() + static_cast<std::ptrdiff_t>(end);
      std::move(behind, list_.end(), std::back_inserter(spare_));
      list_.erase(behind, list_.end());
      return;
    }
    first = end;
  }
}

// All others are left in spare_.
std::vector<Found> Ranking::TakeBestOfKinds() {
  std::move(list_.begin(), list_.end(), std::back_inserter(spare_));
  list_.clear();
  std::sort(spare_.begin(), spare_.end(), ByObjective);
  kinds_.clear();
  std::map<Kind, std::size_t> best;  // by place in spare_
  for (std::size_t i = 0; i < spare_.size(); ++i) {
    const Found& found = spare_[i];
    const double objective = found.leaf.objective;
    const auto [run, fresh] =
        kinds_.try_emplace(found.kind, Run{objective, EndOfTies(tie_, objective), {}, false});
    const auto [place, first] = best.try_emplace(found.kind, i);
    if (objective <= run->second.end && found.key < spare_[place->second].key) place->second = i;
  }
  std::vector<Found> taken;
  taken.reserve(best.size());
  std::vector<Found> others;
  for (std::size_t i = 0; i < spare_.size(); ++i) {
    Found& found = spare_[i];
    if (best.at(found.kind) != i) {
      others.push_back(std::move(found));
      continue;
    }
    Run& run = kinds_.at(found.kind);
    run.key = found.key;
    run.seen = found.record >= 0;
    taken.push_back(std::move(found));
  }
  spare_ = std::move(others);
  return taken;
}

void Ranking::SortKinds() {
  std::vector<Found> best = TakeBestOfKinds();
  source_end_.clear();
  run_begin_ = run_end_ = kUnlimited;
  std::map<Kind::Sources, int> listed;
  for (std::size_t first = 0; first < best.size();) {
    const double objective = best[first].leaf.objective;
    const std::size_t end = OrderRun(tie_, best, first);
    for (; first < end; ++first) {
      Found& found = best[first];
      int& of_source = listed[found.kind.Source()];
      const bool wanted = !full() && of_source < problem_.limits.per_source;
      if (wanted && ++of_source == problem_.limits.per_source)
        source_end_[found.kind.Source()] = EndOfTies(tie_, objective);
      (wanted ? list_ : spare_).push_back(std::move(found));
    }
    if (full() && !(run_end_ < kUnlimited)) {
      run_begin_ = objective;
      run_end_ = EndOfTies(tie_, objective);
    }
  }
}

}  // namespace plenum::optimizer
