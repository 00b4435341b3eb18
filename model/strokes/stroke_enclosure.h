// Rise and fall time of a line between two bounds, at a tenth of the cost of
// model/strokes/stroke.h: most limits are met or missed by more than the bounds are apart.
//
// Why they hold. Let f_i(z) = b_i + (1−b_i)·√(1−z²). It is concave, falls, and f − z·f' ≥ 1, so
// p_{i+1}(q) = p_i·f_i(q/(C_i·p_i)), the perspective of f_i, is concave in (q, p_i) and grows with
// p_i: by induction every pressure p_i(q) on the way is a concave, falling function of the flow. So
// * the ratio r(q) is concave, and so is its inverse q(r), which is constant, q*, where choked;
// * C_i·p_i(q) − q, positive below the choked flow, is concave: the roots of its tangents lie above
//   it, and the least of them over all elements bounds q* from above;
// * 1/q is convex in r: over an interval with the weight w > 0 of the quadrature its mean lies
//   between the value at the centroid of w and the chord. The value at the centroid is bounded by
//   the tangents of q(r), those at the ends by chords of it; the integrals of w are exact.
// Flows at which the march is taken need no equation to be solved.
#ifndef PLENUM_MODEL_STROKES_STROKE_ENCLOSURE_H_
#define PLENUM_MODEL_STROKES_STROKE_ENCLOSURE_H_

#include <array>
#include <limits>
#include <span>

#include "model/flow/iso6358.h"
#include "model/physics/chamber.h"

namespace plenum::model {

inline constexpr std::size_t kEnclosureNodes = 8;

// Points of a line's curve from high flow to low, and a bound on its choked flow.
struct CurveNodes {
  std::size_t size = 0;  // 0: not enclosed
  double flow_max = 0.0;
  std::array<double, kEnclosureNodes> flow{}, ratio{}, slope{};  // slope: dr/dq
};

// Elements in the order the gas crosses them. `flow_max`: a limit on the flow per upstream
// pressure; `ratio_to`: where the nodes may end. Elements with a subsonic index other than ½ are
// not enclosed.
CurveNodes MarchNodes(std::span<const FlowElement> elements, double flow_factor, double ratio_to,
                      double flow_max = std::numeric_limits<double>::infinity());

struct Enclosure {
  double low_s = 0.0;
  double high_s = std::numeric_limits<double>::infinity();
};

// Around FillTime() and EmptyTime() of model/strokes/stroke.h, rounding and the error of the
// quadrature there included. [0, ∞] where nothing is known: a chamber with a table of volumes, or a
// line that is not enclosed. The nodes may serve several pressures up to which they reach.
Enclosure EncloseFillTime(const CurveNodes& nodes, const Chamber& chamber, double source_pa,
                          double from_pa, double to_pa, double temperature_k);
Enclosure EncloseEmptyTime(const CurveNodes& nodes, const Chamber& chamber, double from_pa,
                           double to_pa, double temperature_k);

// The same from above alone, at a tenth of an enclosure's cost: without critical ratios the square
// of the pressure falls by (q/C_i)² from element to element, so that r² = 1 − q²·Σ C_i⁻² and the
// integrals are closed forms; critical ratios only leave more pressure behind each element.
// `flow_max`: a limit on the flow. +∞ where nothing is known.
double FillTimeAtMost(std::span<const FlowElement> elements, double flow_factor,
                      const Chamber& chamber, double source_pa, double from_pa, double to_pa,
                      double temperature_k,
                      double flow_max_m3_per_s = std::numeric_limits<double>::infinity());
double EmptyTimeAtMost(std::span<const FlowElement> elements, double flow_factor,
                       const Chamber& chamber, double from_pa, double to_pa, double temperature_k);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_STROKES_STROKE_ENCLOSURE_H_
