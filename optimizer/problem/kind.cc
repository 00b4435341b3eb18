#include "optimizer/problem/kind.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace plenum::optimizer {

void Kind::Add(KindRole role, int number) {
  if (number == kNoPart) return;
  if (role == KindRole::kSource) sources.push_back(number);
  if (role != KindRole::kValve && role != KindRole::kRegulator) return;
  std::vector<int>& of_role = role == KindRole::kValve ? valves : regulators;
  const auto place = std::lower_bound(of_role.begin(), of_role.end(), number);
  if (place == of_role.end() || *place != number) of_role.insert(place, number);
}

std::vector<int> SeriesOf(const model::Parts& parts, Family family) {
  std::unordered_map<std::string_view, int> first;
  std::vector<int> series(static_cast<std::size_t>(FamilySize(parts, family)));
  for (int i = 0; i < static_cast<int>(series.size()); ++i) {
    const std::string& name = BasicsOf(parts, family, i).series;
    series[i] = name.empty() ? i : first.try_emplace(name, i).first->second;
  }
  return series;
}

DesignKinds::DesignKinds(const model::Parts& parts) {
  for (const FamilySpec& spec : Families()) {
    if (spec.kind_role == KindRole::kApart) continue;
    const std::vector<int>& series = series_[spec.family] = optimizer::SeriesOf(parts, spec.family);
    for (std::size_t i = 0; i < series.size(); ++i)
      of_id_[spec.family].emplace(BasicsOf(parts, spec.family, static_cast<int>(i)).id, series[i]);
  }
}

Kind DesignKinds::Of(Configuration configuration, const std::vector<Choice>& choices) const {
  Kind kind{.configuration = configuration};
  for (const Choice& choice : choices) {
    const auto family = of_id_.find(choice.family);
    if (family == of_id_.end()) continue;
    const auto found = family->second.find(choice.id);
    if (found != family->second.end()) kind.Add(SpecOf(choice.family).kind_role, found->second);
  }
  return kind;
}

int OtherSeriesNeeded(const Problem& problem, Family family, bool own_regulators) {
  const int of_source = std::min(problem.count, problem.limits.per_source);
  const int of_groups = of_source + static_cast<int>(problem.groups.size()) - 1;
  switch (SpecOf(family).kind_role) {
    case KindRole::kRegulator:
      return own_regulators ? of_groups : of_source;
    case KindRole::kValve:
      return of_groups;
    case KindRole::kSource:
    case KindRole::kApart:
      return problem.count;
  }
  return problem.count;
}

}  // namespace plenum::optimizer
