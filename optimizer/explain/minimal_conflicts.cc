#include "optimizer/explain/minimal_conflicts.h"

#include <algorithm>

namespace plenum::optimizer {
namespace {

bool Holds(const DemandSet& all, const DemandSet& some) {
  return std::includes(all.begin(), all.end(), some.begin(), some.end());
}

bool Meet(const DemandSet& a, const DemandSet& b) {
  return std::any_of(a.begin(), a.end(), [&](int demand) { return b.contains(demand); });
}

DemandSet With(DemandSet set, int demand) {
  set.insert(demand);
  return set;
}

// Calls `visit` for each smallest set of `size` demands that meets every conflict, until it gives
// false; false then.
bool ForEachHittingSet(const std::vector<DemandSet>& conflicts, std::size_t size,
                       const DemandSet& chosen,
                       const std::function<bool(const DemandSet&)>& visit) {
  const auto missed =
      std::find_if(conflicts.begin(), conflicts.end(),
                   [&](const DemandSet& conflict) { return !Meet(conflict, chosen); });
  if (missed == conflicts.end()) return chosen.size() != size || visit(chosen);
  if (chosen.size() == size) return true;
  for (const int demand : *missed)
    if (!ForEachHittingSet(conflicts, size, With(chosen, demand), visit)) return false;
  return true;
}

}  // namespace

Met DropOracle::operator()(const DemandSet& dropped) {
  for (const DemandSet& met : met_)
    if (Holds(dropped, met)) return Met::kYes;
  for (const DemandSet& failed : not_met_)
    if (Holds(failed, dropped)) return Met::kNo;
  const Met met = ask_(dropped);
  if (met == Met::kYes) met_.push_back(dropped);
  if (met == Met::kNo) not_met_.push_back(dropped);
  return met;
}

MinimalConflict FindMinimalConflict(int count, const DemandSet& dropped, DropOracle& oracle) {
  MinimalConflict conflict;
  DemandSet out = dropped;
  for (int demand = count; demand-- > 0;) {
    if (out.contains(demand)) continue;
    const Met met = oracle(With(out, demand));
    if (met == Met::kNo) {
      out.insert(demand);
      continue;
    }
    conflict.demands.insert(demand);
    if (met == Met::kYes) conflict.proved.insert(demand);
  }
  return conflict;
}

std::vector<MinimalConflict> FindDisjointConflicts(int count, DropOracle& oracle) {
  std::vector<MinimalConflict> conflicts;
  DemandSet dropped;
  do {
    conflicts.push_back(FindMinimalConflict(count, dropped, oracle));
    const DemandSet& found = conflicts.back().demands;
    if (found.empty()) break;
    dropped.insert(found.begin(), found.end());
  } while (oracle(dropped) == Met::kNo);
  return conflicts;
}

std::vector<DemandSet> FindSmallestDrops(int count, const std::vector<MinimalConflict>& known,
                                         std::size_t most, DropOracle& oracle) {
  std::vector<DemandSet> conflicts;
  conflicts.reserve(known.size());
  for (const MinimalConflict& conflict : known) conflicts.push_back(conflict.demands);
  if (std::any_of(conflicts.begin(), conflicts.end(),
                  [](const DemandSet& conflict) { return conflict.empty(); }))
    return {};
  std::set<DemandSet> found;
  for (std::size_t size = 1; size <= static_cast<std::size_t>(count);) {
    bool unknown = false, another = false;
    ForEachHittingSet(conflicts, size, {}, [&](const DemandSet& dropped) {
      if (found.contains(dropped)) return true;
      const Met met = oracle(dropped);
      if (met == Met::kYes) found.insert(dropped);
      unknown = unknown || met == Met::kUnknown;
      if (met == Met::kNo) {
        conflicts.push_back(FindMinimalConflict(count, dropped, oracle).demands);
        another = true;
      }
      return !another && found.size() < most;
    });
    if (another && conflicts.back().empty()) return {};
    if (another) continue;
    if (!found.empty() || unknown) break;
    ++size;
  }
  return {found.begin(), found.end()};
}

}  // namespace plenum::optimizer
