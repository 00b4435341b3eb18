// The pressure inside a line that passes a flow.
#ifndef PLENUM_MODEL_SIMULATE_INLET_PRESSURE_H_
#define PLENUM_MODEL_SIMULATE_INLET_PRESSURE_H_

#include <cstddef>
#include <span>
#include <vector>

#include "model/flow/simulate_line.h"
#include "model/simulate/regulator_node.h"

namespace plenum::model {

// Behind the first `count` elements of a line between two pressures, where both parts pass the same
// flow; all elements but the last `fixed` conduct `opening` times their C.
template <class T>
T PressureBehind(std::vector<LineElement<T>> elements, std::size_t count, const T& opening,
                 std::size_t fixed, const T& upstream_pa, const T& downstream_pa,
                 const LineOptions& options) {
  for (std::size_t i = 0; i + fixed < elements.size(); ++i) {
    elements[i].sonic_conductance_m3_per_s_pa *= opening;
  }
  const std::span<const LineElement<T>> all = elements;
  if (count == 0) return upstream_pa;
  if (count == elements.size()) return downstream_pa;
  NodeSupply<T> before;
  before.pressure_pa = upstream_pa;
  before.regulator.emplace(all.first(count), options);
  const Line<T> behind(all.subspan(count), options);
  const NodeOutlet<T> outlet = {&behind, T(1.0), downstream_pa};
  return NodePressure<T>(before, {&outlet, 1});
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_INLET_PRESSURE_H_
