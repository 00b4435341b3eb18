// The node behind a shared regulator: one element feeds several lines.
#ifndef PLENUM_MODEL_REGULATOR_NODE_H_
#define PLENUM_MODEL_REGULATOR_NODE_H_

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "model/simulate_line.h"

namespace plenum::model {

// An open line: `count` copies from the node to actuators at one pressure.
struct NodeOutlet {
  const Line* line = nullptr;
  double count = 1.0;
  double pressure_pa = 0.0;
  std::size_t group = 0;  // whose line it is
};

struct NodeSupply {
  double pressure_pa = 0.0;       // in front of the regulator
  std::optional<Line> regulator;  // none: the node is at the supply's pressure
  double flow_max_m3_per_s = std::numeric_limits<double>::infinity();
};

// Pressure p of the node: min(regulator flow(p_s → p), flow_max) = Σ count·line flow(p → p_i). The
// left side does not rise with p and the right side rises from zero at the lowest outlet, so there
// is one root, found to rounding. The supply's pressure where nothing flows.
double NodePressure(const NodeSupply& supply, std::span<const NodeOutlet> outlets);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_REGULATOR_NODE_H_
