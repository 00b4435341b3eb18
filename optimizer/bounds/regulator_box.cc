#include "optimizer/bounds/regulator_box.h"

#include <algorithm>

#include "model/physics/storage.h"

namespace plenum::optimizer {

const RegulatorCorner& RegulatorAt(const Plan& plan, const Box& box, int group) {
  const int i = plan.own_regulators ? group : 0;
  return plan.regulators[i].corners[box.nodes[plan.regulator_slots[i]]];
}

Inlet InletOf(const Plan& plan, const Box& box) {
  Inlet inlet;
  for (int i = 0; i < static_cast<int>(plan.regulators.size()); ++i) {
    const RegulatorCorner& regulator = RegulatorAt(plan, box, i);
    inlet.objective += regulator.objective;
    inlet.min_pa = std::max(inlet.min_pa, regulator.inlet_min_pa);
    inlet.max_pa = std::min(inlet.max_pa, regulator.inlet_max_pa);
    inlet.electrical_power_w += regulator.electrical_power_w;
    inlet.some_none = regulator.some_none;
    inlet.all_none = regulator.all_none;
  }
  return inlet;
}

bool InletsSuit(const Problem& problem, const Plan& plan, const Box& box) {
  if (plan.configuration == Configuration::kCylinder || HasTank(plan.configuration)) return true;
  const double inlet_pa = plan.configuration == Configuration::kCo2
                              ? model::Co2SaturationPressure(problem.ambient.temperature_k)
                              : problem.mains.pressure_pa;
  const Inlet inlet = InletOf(plan, box);
  return inlet.min_pa <= inlet_pa && inlet_pa <= inlet.max_pa;
}

Window WindowAt(const Problem& problem, const Plan& plan, const Box& box, int group) {
  if (!plan.own_regulators) return box.window;
  const Line& line = *box.lines[group];
  const RegulatorCorner& regulator = RegulatorAt(plan, box, group);
  const bool mains = plan.configuration == Configuration::kMains;
  return {std::max({problem.ambient.pressure_pa, line.source_min_pa, regulator.outlet_min_pa}),
          std::min({problem.source_pressure_max_pa, line.source_max_pa, regulator.outlet_max_pa,
                    mains ? problem.mains.pressure_pa : kUnlimited})};
}

bool NarrowWindow(const Problem& problem, const Plan& plan, Box& box) {
  if (!plan.own_regulators) {
    const RegulatorCorner& regulator = RegulatorAt(plan, box, 0);
    box.window.low_pa = std::max(box.window.low_pa, regulator.outlet_min_pa);
    box.window.high_pa = std::min(box.window.high_pa, regulator.outlet_max_pa);
    if (plan.configuration == Configuration::kMains)
      box.window.high_pa = std::min(box.window.high_pa, problem.mains.pressure_pa);
    return !box.window.empty();
  }
  box.window = {box.source_floor_pa, 0.0};
  for (int g = 0; g < static_cast<int>(box.lines.size()); ++g) {
    const Window window = WindowAt(problem, plan, box, g);
    if (window.empty()) return false;
    box.window.low_pa = std::max(box.window.low_pa, window.low_pa);
    box.window.high_pa = std::max(box.window.high_pa, window.high_pa);
  }
  return true;
}

}  // namespace plenum::optimizer
