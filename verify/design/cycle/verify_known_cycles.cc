#include "verify/design/cycle/verify_known_cycles.h"

namespace plenum::verify {

KnownCycles::KnownCycles(const Problem& problem, const Assembly& assembly, const Stop& stop,
                         DirectFills* fills)
    : problem_(problem), assembly_(assembly), quick_(problem, assembly_, stop, fills) {
  for (int g = 0; assembly.owns() && g < static_cast<int>(assembly.lines.size()); ++g)
    groups_.push_back(std::make_shared<OfGroup>(AloneOf(problem, assembly, g), stop));
}

const std::optional<Cycle>& KnownCycles::AtGroups(const std::vector<double>& group_pressure_pa) {
  const auto [entry, fresh] = joined_.try_emplace(group_pressure_pa);
  if (!fresh) return entry->second;
  std::vector<std::optional<Cycle>> cycles;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    cycles.push_back(groups_[g]->cycles.At(AloneAt(group_pressure_pa[g]), 0.0));
  return entry->second = Joined(cycles, std::vector<int>(cycles.size(), 1));
}

}  // namespace plenum::verify
