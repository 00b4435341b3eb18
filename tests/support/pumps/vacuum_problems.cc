#include "tests/support/pumps/vacuum_problems.h"

#include <algorithm>

namespace plenum::test {
namespace {

constexpr double kDeepestPa = 2.0 * kAmbientPa - 1e3;  // as an image

void Evacuate(Random& random, optimizer::ActuatorGroup& group) {
  model::Chamber& chamber = group.chamber;
  const double depth_pa = Uniform(random, 10e3, 60e3);
  chamber.evacuated = true;
  chamber.operating_pressure_pa = kAmbientPa + depth_pa;
  chamber.expansion_ratio = Chance(random, 0.2) ? 1.0 : Uniform(random, 0.05, 1.0);
  group.pressure_max_pa = kAmbientPa + (Chance(random, 0.7) ? 1.05 : 1.3) * depth_pa;
}

}  // namespace

// The same shares of the way to its end, which lies below ambient.
model::Compressor AsVacuumPump(Random& random, model::Compressor pump) {
  const double deepest_pa = kAmbientPa + Uniform(random, 40e3, 90e3);
  const auto onto = [&](const model::MonotoneCurve& curve) {
    std::vector<double> pressure_pa;
    for (const double p : curve.x())
      pressure_pa.push_back(kAmbientPa + (p - kAmbientPa) / (curve.back() - kAmbientPa) *
                                             (deepest_pa - kAmbientPa));
    return model::MonotoneCurve(std::move(pressure_pa), {curve.y().begin(), curve.y().end()});
  };
  pump.curve.free_air_m3_per_s = onto(pump.curve.free_air_m3_per_s);
  pump.curve.current_a = onto(pump.curve.current_a);
  pump.curve.pressure_max_pa = deepest_pa;
  return pump;
}

optimizer::Problem EvacuatedProblem(const Draw& draw) {
  optimizer::Problem problem = RandomProblem(draw);
  Random random(draw.seed);
  for (optimizer::ActuatorGroup& group : problem.groups) Evacuate(random, group);
  for (const model::Compressor& pump : problem.parts.compressors)
    problem.parts.vacuum_pumps.push_back(AsVacuumPump(random, pump));
  model::Parts& parts = problem.parts;
  parts.compressors.clear();
  const auto stand = [](auto& family) {
    for (auto& part : family) part.pressure_max_pa = kDeepestPa;
  };
  stand(parts.tubing);
  stand(parts.fittings);
  stand(parts.valves);
  stand(parts.reservoirs);
  for (model::Valve& valve : parts.valves) {
    valve.pressure_min_pa = kAmbientPa;
    if (Chance(random, 0.5)) valve.kind = model::ValveKind::kPair;
  }
  for (model::Compressor& pump : parts.vacuum_pumps)
    pump.curve.voltage_v = Chance(random, 0.7) ? 12.0 : 6.0;
  for (model::Battery& pack : parts.batteries)
    pack.nominal_voltage_v = Chance(random, 0.7) ? 11.1 : 6.0;
  problem.source_pressure_max_pa =
      Chance(random, 0.5) ? optimizer::kUnlimited : kAmbientPa + Uniform(random, 50e3, 95e3);
  return problem;
}

optimizer::Problem EjectorProblem(const Draw& draw) {
  optimizer::Problem problem = EvacuatedProblem(draw);
  Random random(draw.seed + 1);
  for (model::Compressor ejector : problem.parts.vacuum_pumps) {
    const auto pressures = ejector.curve.current_a.x();
    ejector.curve.current_a = model::MonotoneCurve({pressures.begin(), pressures.end()},
                                                   std::vector<double>(pressures.size(), 0.0));
    ejector.curve.voltage_v = 0.0;
    ejector.duty_max = 1.0;
    ejector.air_consumption_m3_per_s =
        Uniform(random, 0.7, 2.0) * ejector.curve.free_air_m3_per_s.y().front();
    ejector.basics.id = "ejector-" + ejector.basics.id;
    problem.parts.ejectors.push_back(std::move(ejector));
  }
  problem.compressed_air.pressure_pa = kAmbientPa + 600e3;
  if (Chance(random, 0.7))
    problem.compressed_air.flow_max_m3_per_s =
        Uniform(random, 0.5, 4.0) * problem.parts.ejectors.front().air_consumption_m3_per_s;
  return problem;
}

}  // namespace plenum::test
