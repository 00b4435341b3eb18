#include "tests/support/rail_problems.h"

#include <algorithm>

#include "optimizer/evaluate/pumped_rail.h"
#include "tests/support/pumps/vacuum_problems.h"

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

optimizer::Problem PumpedRailProblem(const Draw& draw) {
  optimizer::Problem problem = RailProblem(draw);
  Random random(draw.seed + 9);
  model::Parts& parts = problem.parts;
  for (const model::Compressor& pump : parts.compressors) {
    model::Compressor vacuum = AsVacuumPump(random, pump);
    vacuum.curve.voltage_v = Chance(random, 0.7) ? 12.0 : 6.0;
    if (Chance(random, 0.3)) MakePowerFall(random, vacuum.curve);
    parts.vacuum_pumps.push_back(std::move(vacuum));
  }
  parts.compressors.clear();
  for (model::Battery& pack : parts.batteries)
    pack.nominal_voltage_v = Chance(random, 0.7) ? 11.1 : 6.0;
  for (model::Reservoir& reservoir : parts.reservoirs)
    reservoir.volume_m3 *= LogUniform(random, 1.0, 6.0);
  problem.limits.reservoirs = Pick(random, 1, 2);
  const double floor_pa =
      Chance(random, 0.5) ? kAmbientPa - Uniform(random, 60e3, 90e3) : model::kDeepestVacuumPa;
  for (optimizer::ActuatorGroup& group : problem.groups)
    if (double& low_pa = group.chamber.low_pressure_pa; low_pa > 0.0)
      low_pa = std::max(low_pa, floor_pa + 1e3);
  optimizer::SetRailFloor(floor_pa, problem);
  return problem;
}

}  // namespace plenum::test
