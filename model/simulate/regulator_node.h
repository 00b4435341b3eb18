// The node behind a shared regulator, or behind pumps without a reservoir: it feeds several lines.
#ifndef PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_
#define PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "model/flow/simulate_line.h"
#include "model/physics/compressor.h"

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
  // In place of a regulator so many of this pump; `pressure_pa` is the highest that they reach, and
  // `node_pa` the node's pressure that was found last, ambient while they are off.
  const CompressorCurve* pump = nullptr;
  double pumps = 1.0;
  T duty = T(1.0);  // factor on their delivery
  T node_pa = T(0.0);
};

// Pressure p of the node: min(regulator flow(p_s → p), flow_max) = Σ copies·line flow(p → p_i), or
// with pumps duty·n·Q_c(p) on the left. The left side does not rise with p and the right side rises
// from zero at the lowest outlet, so there is one root, found to rounding. The supply's pressure
// where nothing flows, or where pumps deliver more than the lines take up to there.
template <class T>
T NodePressure(const NodeSupply<T>& supply, std::span<const NodeOutlet<T>> outlets);

// The flow of a pump that delivers the same at any pressure, as a flow controller does, into each
// copy of the only open line: it does not depend on the node. False of other pumps, and where the
// line passes less at the highest pressure.
template <class T>
bool TakeGivenFlow(const NodeSupply<T>& supply, const NodeOutlet<T>& outlet, T& flow);

extern template double NodePressure(const NodeSupply<double>&, std::span<const NodeOutlet<double>>);
extern template Dual NodePressure(const NodeSupply<Dual>&, std::span<const NodeOutlet<Dual>>);
extern template WideDual NodePressure(const NodeSupply<WideDual>&,
                                      std::span<const NodeOutlet<WideDual>>);
extern template bool TakeGivenFlow(const NodeSupply<double>&, const NodeOutlet<double>&, double&);
extern template bool TakeGivenFlow(const NodeSupply<Dual>&, const NodeOutlet<Dual>&, Dual&);
extern template bool TakeGivenFlow(const NodeSupply<WideDual>&, const NodeOutlet<WideDual>&,
                                   WideDual&);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_REGULATOR_NODE_H_
