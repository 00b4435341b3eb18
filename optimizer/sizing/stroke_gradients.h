// The strokes of a compressor's candidate with their derivatives with respect to the stop pressure
// (direction 0) and the volume of the reservoir (direction 1), for solvers.
//
// The simulator runs in dual numbers (model/simulate/sensitivity.h). Groups that find the reservoir
// full are one run each, from the command until it is full again. The derivatives are those of the
// steps taken: within 1e-3 of differences, 5e-3 where groups meet on the source close to equal
// pressures. Where groups meet, the state x at the start of the period moves as well: with F two
// periods of the rig, x = F(x, θ) gives
//   dx/dθ = (I − ∂F/∂x)⁻¹ · ∂F/∂θ.
#ifndef PLENUM_OPTIMIZER_SIZING_STROKE_GRADIENTS_H_
#define PLENUM_OPTIMIZER_SIZING_STROKE_GRADIENTS_H_

#include <optional>

#include "model/flow/scalar.h"
#include "optimizer/evaluate/strokes/evaluate_strokes.h"

namespace plenum::optimizer {

inline constexpr int kAlongPressure = 0, kAlongVolume = 1;

// `strokes`: of EvaluateStrokes at the point, whose two volumes are equal; they work. What chambers
// are filled to is not differentiated: pumps deliver what they take, and no margin asks. None where
// the simulator fails or is stopped, or where a derivative does not exist. Not for effects.
std::optional<StrokesOf<model::Dual>> DifferentiateStrokes(const Problem& problem,
                                                           const Candidate& candidate,
                                                           const OperatingPoint& point,
                                                           const Strokes& strokes);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_SIZING_STROKE_GRADIENTS_H_
