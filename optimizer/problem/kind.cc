#include "optimizer/problem/kind.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace plenum::optimizer {

std::vector<int> SeriesOf(const model::Parts& parts, Family family) {
  std::unordered_map<std::string_view, int> first;
  std::vector<int> series(static_cast<std::size_t>(FamilySize(parts, family)));
  for (int i = 0; i < static_cast<int>(series.size()); ++i) {
    const std::string& name = BasicsOf(parts, family, i).series;
    series[i] = name.empty() ? i : first.try_emplace(name, i).first->second;
  }
  return series;
}

Kind KindOf(const model::Parts& parts, Configuration configuration,
            const std::vector<Choice>& choices) {
  Kind kind{.configuration = configuration};
  for (const Choice& choice : choices) {
    const KindRole role = SpecOf(choice.family).kind_role;
    if (role == KindRole::kApart) continue;
    const int part = FindPart(parts, choice.family, choice.id);
    if (part < 0) continue;
    const int series = SeriesOf(parts, choice.family)[part];
    if (role == KindRole::kSource) kind.source = series;
    if (role == KindRole::kRegulator) kind.regulator = series;
    if (role == KindRole::kValve) kind.valves.push_back(series);
  }
  std::sort(kind.valves.begin(), kind.valves.end());
  kind.valves.erase(std::unique(kind.valves.begin(), kind.valves.end()), kind.valves.end());
  return kind;
}

int OtherSeriesNeeded(const Problem& problem, Family family) {
  const int of_source = std::min(problem.count, problem.per_source);
  switch (SpecOf(family).kind_role) {
    case KindRole::kRegulator:
      return of_source;
    case KindRole::kValve:
      return of_source + static_cast<int>(problem.groups.size()) - 1;
    case KindRole::kSource:
    case KindRole::kApart:
      return problem.count;
  }
  return problem.count;
}

}  // namespace plenum::optimizer
