#include "optimizer/source_options.h"

#include <algorithm>

#include "model/storage.h"

namespace plenum::optimizer {
namespace {

// Part × 1…quantity_max for each part of `parts`; `charge_kg` is the gas that one piece carries.
template <typename Part, typename Charge>
OptionSet PartsInParallel(const Problem& problem, const std::vector<Part>& parts, int quantity_max,
                          Charge&& charge_kg) {
  OptionSet set;
  for (int i = 0; i < static_cast<int>(parts.size()); ++i) {
    for (int quantity = 1; quantity <= quantity_max; ++quantity) {
      ++set.total;
      if (CostMatters(problem) && !parts[i].basics.cost_eur) {
        ++set.unpriced;
        continue;
      }
      Option option;
      option.index = i;
      option.quantity = quantity;
      option.amounts = static_cast<double>(quantity) * parts[i].basics;
      option.amounts.mass_kg += quantity * charge_kg(parts[i]);
      option.objective = ObjectiveOf(problem.objective, option.amounts);
      set.options.push_back(option);
    }
  }
  return set;
}

void SortByObjective(OptionSet& set) {
  std::stable_sort(set.options.begin(), set.options.end(),
                   [](const Option& a, const Option& b) { return a.objective < b.objective; });
}

template <typename Part>
OptionSet Sorted(const Problem& problem, const std::vector<Part>& parts, int quantity_max) {
  OptionSet set = PartsInParallel(problem, parts, quantity_max, [](const Part&) { return 0.0; });
  SortByObjective(set);
  return set;
}

}  // namespace

OptionSet RegulatorOptions(const Problem& problem) {
  return Sorted(problem, problem.parts.regulators, 1);
}

OptionSet CompressorOptions(const Problem& problem) {
  return Sorted(problem, problem.parts.compressors, problem.limits.compressors);
}

OptionSet BatteryOptions(const Problem& problem) {
  return Sorted(problem, problem.parts.batteries, problem.limits.batteries);
}

OptionSet CylinderOptions(const Problem& problem) {
  OptionSet set = PartsInParallel(
      problem, problem.parts.cylinders, problem.limits.cylinders, [&](const model::Cylinder& c) {
        return model::CylinderCharge(c.water_volume_m3, c.fill_pressure_pa,
                                     problem.ambient.temperature_k);
      });
  SortByObjective(set);
  return set;
}

OptionSet Co2Options(const Problem& problem) {
  OptionSet set =
      PartsInParallel(problem, problem.parts.co2, problem.limits.co2,
                      [](const model::Co2Bottle& bottle) { return bottle.co2_mass_kg; });
  SortByObjective(set);
  return set;
}

OptionSet ReservoirOptions(const Problem& problem) {
  OptionSet set = PartsInParallel(problem, problem.parts.reservoirs, problem.limits.reservoirs,
                                  [](const model::Reservoir&) { return 0.0; });
  const auto required = problem.require.find(Family::kReservoir);
  const bool allowed = !problem.exclude.contains("custom") &&
                       (required == problem.require.end() || required->second.contains("custom"));
  if (allowed) {
    ++set.total;
    if (CostMatters(problem)) {
      ++set.unpriced;
    } else {
      Option custom;
      custom.index = kCustom;
      custom.quantity = 1;
      custom.objective =
          ObjectiveOf(problem.objective, CustomReservoir(problem, model::kMadeReservoirSmallestM3));
      set.options.push_back(custom);
    }
  }
  SortByObjective(set);
  return set;
}

bool RegulatorFits(const Problem& problem, Configuration configuration, int regulator) {
  const model::Regulator& part = problem.parts.regulators[regulator];
  if (configuration == Configuration::kCo2) {
    const double bottle_pa = model::Co2SaturationPressure(problem.ambient.temperature_k);
    return part.inlet_pressure_max_pa >= bottle_pa && part.inlet_pressure_min_pa <= bottle_pa;
  }
  if (configuration == Configuration::kMains)
    return part.inlet_pressure_max_pa >= problem.mains_pressure_pa &&
           part.inlet_pressure_min_pa <= problem.mains_pressure_pa;
  return true;
}

bool RegulatorFitsCylinder(const Problem& problem, int regulator, int cylinder) {
  return problem.parts.regulators[regulator].inlet_pressure_max_pa >=
         problem.parts.cylinders[cylinder].fill_pressure_pa;
}

bool BatteryFitsCompressor(const Problem& problem, int battery, int compressor) {
  return model::VoltageMatches(problem.parts.batteries[battery].nominal_voltage_v,
                               problem.parts.compressors[compressor].curve.voltage_v);
}

}  // namespace plenum::optimizer
