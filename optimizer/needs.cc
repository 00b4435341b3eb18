#include "optimizer/needs.h"

#include <algorithm>
#include <cmath>

#include "model/storage.h"

namespace plenum::optimizer {
namespace {

constexpr double kJoulePerWattHour = 3600.0;

}  // namespace

double EnergyObjective(const Problem& problem, double energy_per_cycle_j) {
  return problem.objective.energy_wh * problem.actuations * energy_per_cycle_j / kJoulePerWattHour;
}

double LineObjective(const Problem& problem, const Line& line) {
  return ObjectiveOf(problem.objective, line.amounts) +
         EnergyObjective(problem, CoilEnergyPerCycle(problem, line, line.inflate_time_least_s));
}

bool WithinLimits(const Problem& problem, const Amounts& amounts) {
  return amounts.mass_kg <= problem.mass_max_kg &&
         amounts.volume_m3 * 1e3 <= problem.volume_max_l &&
         amounts.cost_eur <= problem.cost_max_eur;
}

Need LeastNeed(const Problem& problem, const Tree& tree, const Candidate& candidate,
               const Line* next) {
  Need need;
  const double floor_pa = problem.ambient.pressure_pa;
  for (int g = 0; g < static_cast<int>(problem.groups.size()); ++g) {
    const int chosen = static_cast<int>(candidate.lines.size());
    const Line* line = g < chosen ? candidate.lines[g] : g == chosen ? next : nullptr;
    if (line == nullptr) {
      need.air_m3 += tree.air_least_m3[g];
      need.air_to_target_m3 += AirToTarget(problem, g, problem.groups[g].chamber);
      need.coil_j += tree.coil_least_j[g];
      continue;
    }
    need.air_m3 += AirPerStroke(problem, g, *line, std::max(floor_pa, line->source_min_pa));
    need.air_to_target_m3 += AirToTarget(problem, g, line->chamber);
    need.source_min_pa = std::max(need.source_min_pa, line->source_min_pa);
    need.coil_j += CoilEnergyPerCycle(problem, *line, line->inflate_time_least_s);
    need.coil_power_w += line->coil_power_w;
  }
  need.energy_j = need.coil_j;
  if (candidate.regulator.index != kNone) {
    const double power_w = problem.parts.regulators[candidate.regulator.index].electrical_power_w;
    need.coil_power_w += power_w;
    need.energy_j += power_w / problem.frequency_hz;
  }
  if (candidate.compressor.index != kNone) {
    need.pump = LeastPumpNeed(problem, tree.pumps[candidate.compressor.index],
                              candidate.compressor.quantity, need.air_m3, need.air_to_target_m3,
                              need.source_min_pa);
    need.energy_j += need.pump.energy_j;
  }
  return need;
}

bool PumpBears(const Problem& problem, const Candidate& candidate, const Need& need) {
  const double duty_max = problem.parts.compressors[candidate.compressor.index].duty_max;
  return need.pump.on_s * problem.frequency_hz <= duty_max;
}

double PumpCurrent(const Problem& problem, const Candidate& candidate) {
  if (candidate.compressor.index == kNone) return 0.0;
  double low_pa = std::max(problem.ambient.pressure_pa, candidate.source_floor_pa);
  for (const Line* line : candidate.lines) low_pa = std::max(low_pa, line->source_min_pa);
  return candidate.compressor.quantity *
         model::LargestCurrent(problem.parts.compressors[candidate.compressor.index].curve,
                               problem.ambient.pressure_pa, low_pa);
}

double UsableEnergy(const Problem& problem, const Option& option) {
  const model::Battery& battery = problem.parts.batteries[option.index];
  return option.quantity * model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v);
}

bool BatteryBears(const Problem& problem, const Option& option, const BatteryNeed& need) {
  const model::Battery& battery = problem.parts.batteries[option.index];
  return need.energy_j <= option.quantity *
                              model::UsableEnergy(battery.capacity_ah, battery.nominal_voltage_v) &&
         need.pump_current_a + need.coil_power_w / battery.nominal_voltage_v <=
             option.quantity * battery.current_max_a;
}

bool BottleBears(const Problem& problem, const Candidate& candidate, const Option& option,
                 const Need& need, double source_pa) {
  const model::Regulator& regulator = problem.parts.regulators[candidate.regulator.index];
  const double inlet_pa = std::max(source_pa, regulator.inlet_pressure_min_pa);
  const double temperature_k = problem.ambient.temperature_k;
  const double air_m3 = problem.actuations * need.air_m3;
  if (candidate.configuration == Configuration::kCylinder) {
    const model::Cylinder& cylinder = problem.parts.cylinders[option.index];
    return option.quantity * model::CylinderUsableVolume(cylinder.water_volume_m3,
                                                         cylinder.fill_pressure_pa, inlet_pa,
                                                         temperature_k) >=
           air_m3;
  }
  const model::Co2Bottle& bottle = problem.parts.co2[option.index];
  return option.quantity * model::Co2UsableVolume(bottle.co2_mass_kg, bottle.water_volume_m3,
                                                  inlet_pa, temperature_k) >=
             air_m3 &&
         option.quantity * bottle.flow_sustained_m3_per_s >= need.air_m3 * problem.frequency_hz;
}

double LeastBattery(const Problem& problem, const Tree& tree, const Candidate& candidate,
                    const BatteryNeed& need) {
  const std::vector<Option>& batteries = candidate.compressor.index == kNone
                                             ? tree.batteries.options
                                             : tree.pump_batteries[candidate.compressor.index];
  for (const Option& option : batteries)
    if (BatteryBears(problem, option, need)) return option.objective;
  return kUnlimited;
}

double LeastReservoir(const Problem& problem, const Tree& tree, double volume_m3) {
  double least = kUnlimited;
  const auto stock = std::lower_bound(
      tree.reservoir_by_volume.begin(), tree.reservoir_by_volume.end(), volume_m3,
      [](const std::pair<double, double>& entry, double volume) { return entry.first < volume; });
  if (stock != tree.reservoir_by_volume.end()) least = stock->second;
  if (tree.custom_allowed && volume_m3 <= model::kMadeReservoirLargestM3)
    least = std::min(
        least, ObjectiveOf(
                   problem.objective,
                   CustomReservoir(problem, std::max(volume_m3, model::kMadeReservoirSmallestM3))));
  return least;
}

double ChosenObjective(const Problem& problem, const Candidate& parent) {
  double chosen = parent.regulator.objective + parent.compressor.objective +
                  parent.bottle.objective + parent.battery.objective;
  if (parent.reservoir.index >= 0) chosen += parent.reservoir.objective;
  for (const Line* line : parent.lines) chosen += LineObjective(problem, *line);
  return chosen;
}

double PumpObjective(const Problem& problem, const Need& need, double energy_j) {
  return EnergyObjective(problem, energy_j / problem.actuations - need.coil_j);
}

double StockVolume(const Problem& problem, const Option& reservoir) {
  return reservoir.quantity * problem.parts.reservoirs[reservoir.index].volume_m3;
}

}  // namespace plenum::optimizer
