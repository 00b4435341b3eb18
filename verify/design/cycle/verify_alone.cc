#include "verify/design/cycle/verify_alone.h"

#include <algorithm>
#include <utility>

namespace plenum::verify {

Alone AloneOf(const Problem& problem, const Assembly& assembly, int group) {
  Alone alone;
  alone.problem.groups = {problem.groups[group]};
  alone.problem.frequency_hz = problem.frequency_hz;
  alone.problem.actuations = problem.actuations;
  alone.problem.rise_fraction = problem.rise_fraction;
  alone.problem.fall_fraction = problem.fall_fraction;
  alone.problem.mains = problem.mains;
  alone.problem.source_pressure_max_pa = problem.source_pressure_max_pa;
  alone.problem.ambient = problem.ambient;
  alone.problem.guarantee = problem.guarantee;
  alone.assembly = assembly;
  alone.assembly.lines = {assembly.lines[group]};
  if (assembly.owns()) alone.assembly.regulators = {assembly.regulators[group]};
  if (problem.pump_feed == PumpFeed::kPerActuator)
    std::swap(alone.feeds, alone.problem.groups.front().count);
  return alone;
}

Settings AloneAt(double group_pressure_pa) {
  Settings settings;
  settings.source_pressure_pa = group_pressure_pa;
  return settings;
}

std::optional<Cycle> Joined(const std::vector<std::optional<Cycle>>& cycles,
                            const std::vector<int>& feeds) {
  Cycle all;
  for (std::size_t g = 0; g < cycles.size(); ++g) {
    const std::optional<Cycle>& cycle = cycles[g];
    if (!cycle) return std::nullopt;
    all.rise_s.push_back(cycle->rise_s.front());
    all.inflate_s.push_back(cycle->inflate_s.front());
    all.fall_s.push_back(cycle->fall_s.front());
    all.filled_pa.push_back(cycle->filled_pa.front());
    all.air_m3 += feeds[g] * cycle->air_m3;
    all.coil_w += feeds[g] * cycle->coil_w;
    all.steady_j += feeds[g] * cycle->steady_j;
    all.inflating_j += feeds[g] * cycle->inflating_j;
    all.pump_on_s = std::max(all.pump_on_s, cycle->pump_on_s);
    all.pump_j += feeds[g] * cycle->pump_j;
    all.pump_air_m3 += feeds[g] * cycle->pump_air_m3;
    all.node_pa = std::max(all.node_pa, cycle->node_pa);
  }
  return all;
}

}  // namespace plenum::verify
