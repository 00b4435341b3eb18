#include "model/simulate/regulator_node.h"

#include <algorithm>
#include <cmath>

#include "model/integrate/simulate_root.h"

namespace plenum::model {
namespace {

// Along the table, with its end values outside.
template <class T>
T Delivery(const NodeSupply<T>& supply, const T& node_pa) {
  const MonotoneCurve& table = supply.pump->free_air_m3_per_s;
  const T within_pa = node_pa < table.front()  ? T(table.front())
                      : node_pa > table.back() ? T(table.back())
                                               : node_pa;
  return CurveAt(table, within_pa) * supply.pumps * supply.duty;
}

}  // namespace

template <class T>
T NodePressure(const NodeSupply<T>& supply, std::span<const NodeOutlet<T>> outlets) {
  const auto surplus = [&](const T& node_pa) {
    T flow = supply.pump ? Delivery(supply, node_pa) : T(supply.flow_max_m3_per_s);
    if (supply.regulator) {
      const T regulated = supply.regulator->Flow(supply.pressure_pa, node_pa);
      if (regulated < flow) flow = regulated;
    }
    for (const NodeOutlet<T>& outlet : outlets) {
      flow -= outlet.copies * outlet.line->Flow(node_pa, outlet.pressure_pa);
    }
    return flow;
  };
  const auto surplus_value = [&](double node_pa) { return ValueOf(surplus(T(node_pa))); };
  double lowest_pa = ValueOf(supply.pressure_pa);
  const double supply_pa = lowest_pa;
  for (const NodeOutlet<T>& outlet : outlets) {
    lowest_pa = std::min(lowest_pa, ValueOf(outlet.pressure_pa));
  }
  const double at_supply = surplus_value(supply_pa);
  if (at_supply >= 0.0) return supply.pressure_pa;
  const double node_pa =
      RootBetween(surplus_value, lowest_pa, surplus_value(lowest_pa), supply_pa, at_supply, 0.0);
  if constexpr (kIsDual<T>) {
    // One Newton step in dual numbers carries the derivatives over.
    const double h = 1e-6 * node_pa;
    const double slope = (surplus_value(node_pa + h) - surplus_value(node_pa - h)) / (2.0 * h);
    const T residual = surplus(T(node_pa));
    return T(node_pa) - (residual - ValueOf(residual)) / slope;
  }
  return T(node_pa);
}

template <class T>
bool TakeGivenFlow(const NodeSupply<T>& supply, const NodeOutlet<T>& outlet, T& flow) {
  const std::span<const double> free_air = supply.pump->free_air_m3_per_s.y();
  const double delivered = free_air.front() * supply.pumps;
  if (free_air.front() != free_air.back()) return false;  // it falls
  flow = supply.duty * delivered / outlet.copies;
  return !(outlet.line->Flow(supply.pressure_pa, outlet.pressure_pa) < flow);
}

template double NodePressure(const NodeSupply<double>&, std::span<const NodeOutlet<double>>);
template Dual NodePressure(const NodeSupply<Dual>&, std::span<const NodeOutlet<Dual>>);
template WideDual NodePressure(const NodeSupply<WideDual>&, std::span<const NodeOutlet<WideDual>>);
template bool TakeGivenFlow(const NodeSupply<double>&, const NodeOutlet<double>&, double&);
template bool TakeGivenFlow(const NodeSupply<Dual>&, const NodeOutlet<Dual>&, Dual&);
template bool TakeGivenFlow(const NodeSupply<WideDual>&, const NodeOutlet<WideDual>&, WideDual&);

}  // namespace plenum::model
