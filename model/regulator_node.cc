#include "model/regulator_node.h"

#include <algorithm>

#include "model/simulate_root.h"

namespace plenum::model {

double NodePressure(const NodeSupply& supply, std::span<const NodeOutlet> outlets) {
  const auto surplus = [&](double node_pa) {
    double flow = supply.flow_max_m3_per_s;
    if (supply.regulator) {
      flow = std::min(flow, supply.regulator->Flow(supply.pressure_pa, node_pa));
    }
    for (const NodeOutlet& outlet : outlets) {
      flow -= outlet.count * outlet.line->Flow(node_pa, outlet.pressure_pa);
    }
    return flow;
  };
  double lowest_pa = supply.pressure_pa;
  for (const NodeOutlet& outlet : outlets) lowest_pa = std::min(lowest_pa, outlet.pressure_pa);
  const double at_supply = surplus(supply.pressure_pa);
  if (at_supply >= 0.0) return supply.pressure_pa;
  return RootBetween(surplus, lowest_pa, surplus(lowest_pa), supply.pressure_pa, at_supply, 0.0);
}

}  // namespace plenum::model
