#include "tests/support/rail_problems.h"

#include <algorithm>

namespace plenum::test {

optimizer::Problem RailProblem(const Draw& draw) {
  optimizer::Problem problem = RandomProblem(draw);
  Random random(draw.seed + 5);
  const double rail_pa = kAmbientPa - Uniform(random, 40e3, 90e3);
  for (optimizer::ActuatorGroup& group : problem.groups) {
    const bool stays_above = problem.groups.size() > 1 && &group == &problem.groups.back();
    if (stays_above && Chance(random, 0.4)) continue;
    model::Chamber& chamber = group.chamber;
    const double above_pa = chamber.operating_pressure_pa - kAmbientPa;
    const double deepest_pa = std::min(
        kAmbientPa - rail_pa, 0.8 * above_pa / std::max(1e-3, chamber.expansion_ratio - 1.0));
    chamber.low_pressure_pa = kAmbientPa - Uniform(random, 0.05, 1.0) * deepest_pa;
    chamber.exhaust_pressure_pa = rail_pa;
    group.fall_time_max_s *= Uniform(random, 1.0, 3.0);
  }
  for (model::Valve& valve : problem.parts.valves)
    if (valve.kind == model::ValveKind::kThreeWay) valve.kind = model::ValveKind::kPair;
  return problem;
}

}  // namespace plenum::test
