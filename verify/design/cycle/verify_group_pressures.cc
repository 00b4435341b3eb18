#include "verify/design/cycle/verify_group_pressures.h"

#include <algorithm>

#include "verify/design/cycle/verify_gait.h"

namespace plenum::verify {
namespace {

constexpr double kNarrow = 1e-9;  // of a pressure

// Largest share by which the group's strokes miss a limit; none where that is not known.
std::optional<double> Missing(KnownCycles::OfGroup& group, double pa) {
  const Problem& problem = group.alone.problem;
  const std::optional<Cycle>& cycle = group.cycles.At(AloneAt(pa), 0.0);
  if (!cycle) return std::nullopt;
  const ActuatorGroup& asked = problem.groups.front();
  return std::max({cycle->inflate_s[0] / FillWindow(problem, 0),
                   cycle->rise_s[0] / asked.rise_time_max_s,
                   cycle->fall_s[0] / VentWindow(problem, 0),
                   cycle->fall_s[0] / asked.fall_time_max_s}) -
         1.0;
}

// Raises the lower end to where strokes are fast enough; false where that is nowhere known.
bool Raise(KnownCycles::OfGroup& group, double slack, Pressures& range, bool& feasible) {
  feasible = range.low_pa <= range.high_pa;
  if (!feasible) return true;
  const std::optional<double> high = Missing(group, range.high_pa);
  const std::optional<double> low = Missing(group, range.low_pa);
  if (!high || !low) return false;
  feasible = *high <= slack;
  if (!feasible || *low <= slack) return true;
  double slow_pa = range.low_pa, fast_pa = range.high_pa;
  while (fast_pa - slow_pa > kNarrow * fast_pa) {
    const double middle_pa = 0.5 * (slow_pa + fast_pa);
    const std::optional<double> missing = Missing(group, middle_pa);
    if (!missing) return false;
    (*missing <= slack ? fast_pa : slow_pa) = middle_pa;
  }
  range.low_pa = fast_pa;
  return true;
}

}  // namespace

Pressures GroupRanges::Highest() const {
  Pressures highest{0.0, 0.0};
  for (const Pressures& range : groups) {
    highest.low_pa = std::max(highest.low_pa, range.low_pa);
    highest.high_pa = std::max(highest.high_pa, range.high_pa);
  }
  return highest;
}

GroupRanges RangesOf(KnownCycles& cycles, const Assembly& assembly, double slack) {
  GroupRanges ranges;
  for (int g = 0; g < static_cast<int>(assembly.lines.size()) && ranges.feasible; ++g) {
    KnownCycles::OfGroup& group = cycles.Group(g);
    ranges.groups.push_back(StoodPressures(group.alone.problem, group.alone.assembly));
    if (!Raise(group, slack, ranges.groups.back(), ranges.feasible)) ranges.known = false;
  }
  return ranges;
}

std::vector<double> PressuresAt(const GroupRanges& ranges, const Assembly& assembly,
                                double highest_pa) {
  std::vector<double> group_pa;
  for (std::size_t g = 0; g < ranges.groups.size(); ++g) {
    const auto& [low_pa, high_pa] = ranges.groups[g];
    const bool holds = model::Holds(assembly.lines[g].valve->kind);
    group_pa.push_back(holds ? std::max(low_pa, std::min(high_pa, highest_pa)) : low_pa);
  }
  return group_pa;
}

}  // namespace plenum::verify
