// What a line passes from one pressure down to another, m³ ANR/s. Straight to zero where the drop
// is less than 1e-9 of the pressure in front, as the simulator has it; nothing flows back.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_FLOW_DOWN_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_FLOW_DOWN_H_

#include <algorithm>

#include "model/flow/flow_table.h"

namespace plenum::optimizer {

inline constexpr double kStraight = 1e-9;

inline double FlowDown(const model::FlowTable& flow, double from_pa, double to_pa) {
  const double drop = 1.0 - to_pa / from_pa;
  return drop >= kStraight ? from_pa * flow(1.0 - drop)
                           : from_pa * flow(1.0 - kStraight) * std::max(0.0, drop / kStraight);
}

// The same with its slopes by the pressures in front and behind, of a drop above 0.
struct FlowAndSlopes {
  double flow, by_from, by_to;
};
inline FlowAndSlopes FlowAndSlopesDown(const model::FlowTable& flow, double from_pa, double to_pa) {
  const double drop = 1.0 - to_pa / from_pa;
  if (drop < kStraight) {
    const double steep = flow(1.0 - kStraight) / kStraight;
    return {steep * (from_pa - to_pa), steep, -steep};
  }
  const auto [per_pa, slope] = flow.WithSlope(1.0 - drop);
  return {from_pa * per_pa, per_pa - (1.0 - drop) * slope, slope};
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_FLOW_DOWN_H_
