// The node behind a shared regulator: one element feeds several lines.
#ifndef PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_
#define PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "model/flow/simulate_line.h"

namespace plenum::model {

// An open line: `copies` of it, times how far it is open, from the node to one pressure.
template <class T>
struct NodeOutlet {
  const Line<T>* line = nullptr;
  T copies = T(1.0);
  T pressure_pa = T(0.0);
  std::size_t group = 0;  // whose line it is
  int regime = Line<T>::kUnknown;
};

template <class T>
struct NodeSupply {
  T pressure_pa = T(0.0);            // in front of the regulator
  std::optional<Line<T>> regulator;  // none: the node is at the supply's pressure
  double flow_max_m3_per_s = std::numeric_limits<double>::infinity();
};

// Pressure p of the node: min(regulator flow(p_s → p), flow_max) = Σ copies·line flow(p → p_i). The
// left side does not rise with p and the right side rises from zero at the lowest outlet, so there
// is one root, found to rounding. The supply's pressure where nothing flows.
template <class T>
T NodePressure(const NodeSupply<T>& supply, std::span<const NodeOutlet<T>> outlets);

extern template double NodePressure(const NodeSupply<double>&, std::span<const NodeOutlet<double>>);
extern template Dual NodePressure(const NodeSupply<Dual>&, std::span<const NodeOutlet<Dual>>);
extern template WideDual NodePressure(const NodeSupply<WideDual>&,
                                      std::span<const NodeOutlet<WideDual>>);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_
