#include "optimizer/problem/own_regulators.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "optimizer/problem/gait.h"

namespace plenum::optimizer {
namespace {

bool OneGroupAnEntry(const Problem& problem) {
  std::set<int> entries;
  return std::all_of(problem.groups.begin(), problem.groups.end(), [&](const ActuatorGroup& group) {
    return group.entry < 0 || entries.insert(group.entry).second;
  });
}

}  // namespace

bool MayOwnRegulators(const Problem& problem, Configuration configuration) {
  if (IsPumped(configuration) || Evacuated(problem) || problem.groups.size() < 2 ||
      !OneGroupAnEntry(problem))
    return false;
  for (const ActuatorGroup& group : problem.groups)
    if (!group.effects.empty()) return false;
  return configuration != Configuration::kMains || std::isinf(problem.mains.flow_max_m3_per_s) ||
         !WindowsOverlap(problem);
}

std::vector<Layout> LayoutsOf(const Problem& problem, Configuration configuration) {
  const bool may = MayOwnRegulators(problem, configuration);
  std::vector<Layout> layouts;
  if (!may || problem.regulation != Regulation::kPerGroup)
    layouts.push_back({configuration, false});
  if (may && problem.regulation != Regulation::kShared) layouts.push_back({configuration, true});
  return layouts;
}

std::vector<Layout> LayoutsOf(const Problem& problem) {
  std::vector<Layout> all;
  for (const Configuration configuration : problem.configurations)
    for (const Layout& layout : LayoutsOf(problem, configuration)) all.push_back(layout);
  return all;
}

bool HasOwnRegulators(const std::vector<Choice>& rows) {
  return std::any_of(rows.begin(), rows.end(), [](const Choice& row) {
    return row.family == Family::kRegulator && row.group >= 0;
  });
}

}  // namespace plenum::optimizer
