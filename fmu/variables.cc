#include "fmu/variables.h"

#include <algorithm>
#include <cmath>
#include <variant>

namespace plenum::fmu {

std::vector<Variable> VariablesOf(const Unit& unit) {
  std::vector<Variable> variables;
  const std::size_t count = unit.rig.groups.size();
  variables.reserve(5 * count + 6);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string& name = unit.rig.groups[i].name;
    variables.push_back({name + ".command", Quantity::kCommand, i});
    variables.push_back({name + ".volume_ml", Quantity::kVolume, i});
    variables.push_back({name + ".pressure_kpa_gauge", Quantity::kPressure, i});
    variables.push_back({name + ".flow_l_per_min_anr", Quantity::kFlow, i});
    variables.push_back({name + ".volume_now_ml", Quantity::kVolumeNow, i});
  }
  if (!std::holds_alternative<model::NoSource>(unit.rig.source))
    variables.push_back({"source_pressure_kpa_gauge", Quantity::kSource});
  variables.push_back({"energy_used_wh", Quantity::kEnergyUsed});
  if (std::isfinite(unit.energy_available_j))
    variables.push_back({"battery_charge", Quantity::kBatteryCharge});
  variables.push_back({"air_used_l_anr", Quantity::kAirUsed});
  if (std::isfinite(unit.air_available_m3)) variables.push_back({"air_left", Quantity::kAirLeft});
  if (std::any_of(unit.valves.begin(), unit.valves.end(),
                  [](const DrivenValve& valve) { return valve.holds; }))
    variables.push_back({"close_at_operating_pressure", Quantity::kCloses});
  return variables;
}

}  // namespace plenum::fmu
