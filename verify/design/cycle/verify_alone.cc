#include "verify/design/cycle/verify_alone.h"

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
  alone.assembly.regulators = {assembly.regulators[group]};
  return alone;
}

Settings AloneAt(double group_pressure_pa) {
  Settings settings;
  settings.source_pressure_pa = group_pressure_pa;
  return settings;
}

std::optional<Cycle> Joined(const std::vector<std::optional<Cycle>>& cycles) {
  Cycle all;
  for (const std::optional<Cycle>& cycle : cycles) {
    if (!cycle) return std::nullopt;
    all.rise_s.push_back(cycle->rise_s.front());
    all.inflate_s.push_back(cycle->inflate_s.front());
    all.fall_s.push_back(cycle->fall_s.front());
    all.filled_pa.push_back(cycle->filled_pa.front());
    all.air_m3 += cycle->air_m3;
    all.coil_w += cycle->coil_w;
    all.steady_j += cycle->steady_j;
    all.inflating_j += cycle->inflating_j;
  }
  return all;
}

}  // namespace plenum::verify
