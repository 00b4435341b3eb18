#include "optimizer/choices/plant/ranges.h"

#include <algorithm>

#include "model/physics/storage.h"
#include "optimizer/evaluate/candidate.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/pump_feed.h"

namespace plenum::optimizer {
namespace {

double MainsEnergy(const Problem& problem) {
  double power_w = 0.0, regulator_w = 0.0;
  for (const model::Valve& valve : problem.parts.valves)
    power_w = std::max(power_w, valve.coil_power_w);
  for (const model::Regulator& regulator : problem.parts.regulators)
    regulator_w = std::max(regulator_w, regulator.electrical_power_w);
  double pump_w = 0.0;  // of a vacuum beside the mains
  for (const model::Compressor& pump : problem.parts.vacuum_pumps)
    pump_w = std::max(pump_w, pump.curve.voltage_v *
                                  model::LargestCurrent(pump.curve, problem.ambient.pressure_pa,
                                                        model::HighestPressure(pump.curve)));
  return problem.actuations / problem.frequency_hz *
         (LineCount(problem) * power_w + static_cast<double>(problem.groups.size()) * regulator_w +
          (PumpsRail(problem) ? problem.limits.compressors * pump_w : 0.0));
}

// No design uses more than its batteries give.
double MostEnergy(const Problem& problem, Configuration configuration) {
  if (configuration == Configuration::kMains) return MainsEnergy(problem);
  double energy_j = 0.0;
  for (const model::Battery& battery : problem.parts.batteries)
    energy_j =
        std::max(energy_j, problem.limits.batteries *
                               model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v));
  return energy_j;
}

double MostGasKg(const Problem& problem) {
  const model::Parts& parts = problem.parts;
  const double temperature_k = problem.ambient.temperature_k;
  double gas_kg = 0.0;
  for (const model::Cylinder& c : parts.cylinders)
    gas_kg = std::max(gas_kg,
                      model::CylinderCharge(c.water_volume_m3, c.fill_pressure_pa, temperature_k));
  for (const model::Co2Bottle& bottle : parts.co2) gas_kg = std::max(gas_kg, bottle.co2_mass_kg);
  for (const model::Reservoir& tank : parts.tanks)
    gas_kg =
        std::max(gas_kg, model::TankCharge(tank.volume_m3, tank.pressure_max_pa, temperature_k));
  const Limits& most = problem.limits;
  return gas_kg * std::max({most.cylinders, most.co2, most.reservoirs});
}

}  // namespace

double LargestTie(const Problem& problem, const Layout& layout) {
  double sum = 0.0;
  const auto add = [&](const auto& family, double pieces) {
    double most = 0.0;
    for (const auto& part : family) {
      if constexpr (requires { part.per_metre; })
        most = std::max(most, ObjectiveOf(problem.objective, Bought(pieces, part.per_metre)));
      else
        most = std::max(most, ObjectiveOf(problem.objective, Bought(pieces, part.basics)));
    }
    sum += most;
  };
  const model::Parts& parts = problem.parts;
  const Limits& most = problem.limits;
  for (const ActuatorGroup& group : problem.groups) {
    add(parts.tubing, group.count * group.tube_length_m);
    add(parts.fittings, group.count * group.fittings_per_line);
    add(parts.valves, group.count);
  }
  add(parts.regulators, layout.own_regulators ? static_cast<double>(problem.groups.size()) : 1.0);
  add(parts.cylinders, most.cylinders);
  add(parts.co2, most.co2);
  add(PumpsOf(problem, layout.configuration), most.compressors * FeedsOf(problem));
  add(parts.batteries, most.batteries);
  add(parts.reservoirs, most.reservoirs);
  add(parts.tanks, most.reservoirs);
  if (PumpsRail(problem)) add(parts.vacuum_pumps, most.compressors);
  add(parts.manifolds,
      LineCount(problem) * (1 + most.compressors) + 32);  // of pumps, bottles and reservoirs
  add(parts.check_valves, FeedsOf(problem));
  sum += problem.objective.mass_kg * MostGasKg(problem);
  sum += ObjectiveOf(problem.objective, CustomReservoir(problem, model::kMadeReservoirLargestM3,
                                                        CustomRatingPa(problem)));
  return TieOf(problem) * (sum + EnergyWeight(problem) * MostEnergy(problem, layout.configuration));
}

double HighestUseful(const Problem& problem, Configuration configuration, double pump_pa) {
  double highest_pa = pump_pa;
  if (!IsPumped(configuration)) {
    highest_pa = 0.0;
    for (const model::Regulator& regulator : problem.parts.regulators)
      highest_pa = std::max(highest_pa, regulator.outlet_pressure_max_pa);
  }
  if (HasTank(configuration)) highest_pa = std::max(highest_pa, HighestTankPa(problem));
  return std::min(problem.source_pressure_max_pa, highest_pa);
}

BottleRange FindBottleRange(const Problem& problem, Configuration configuration) {
  BottleRange range{problem.ambient.pressure_pa, problem.ambient.pressure_pa};
  double outlet_pa = range.low_pa;
  for (const model::Regulator& regulator : problem.parts.regulators) {
    outlet_pa = std::max(outlet_pa, regulator.outlet_pressure_max_pa);
    range.high_pa = std::max(range.high_pa, regulator.inlet_pressure_min_pa);
  }
  range.high_pa = std::max(range.high_pa, std::min(outlet_pa, problem.source_pressure_max_pa));
  if (HasTank(configuration)) range.high_pa = std::max(range.high_pa, HighestTankPa(problem));
  return range;
}

}  // namespace plenum::optimizer
