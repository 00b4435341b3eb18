// Elements in series: the exact march of ISO 6358-3, and closed-form combinations as bounds.
//
// With a common stagnation temperature and no cracking pressure each element's law is homogeneous
// in pressure, so a whole line has one curve: flow per upstream pressure, q = Q/p1 in
// m³/(s·Pa), against the ratio r = p2/p1. Marching downstream at a given q is explicit,
//   p_{i+1} = p_i · [b + (1−b)·√(1 − (q/(C_i·p_i))^{1/m})],
// which gives r(q); the largest q that every element can pass is the choked flow q*.
#ifndef PLENUM_MODEL_FLOW_SERIES_H_
#define PLENUM_MODEL_FLOW_SERIES_H_

#include <array>
#include <cstddef>
#include <span>

#include "model/flow/iso6358.h"

namespace plenum::model {

inline constexpr std::size_t kMaxSeriesElements = 8;

// The exact curve of a line. Build with MakeSeries.
struct Series {
  std::array<FlowElement, kMaxSeriesElements> elements{};
  std::size_t size = 0;
  double choked_flow_m3_per_s_pa = 0.0;  // q*, equals the sonic conductance of the line
  double choked_ratio = 0.0;             // r(q*): the line is choked for r ≤ this
  bool operator==(const Series&) const = default;
};

// Elements in the order the gas crosses them, at most kMaxSeriesElements, all without cracking
// pressure (asserted; a line with one is solved by the simulator at each pressure). `flow_factor`
// scales every C (gas other than air, upstream temperature √(T0/T)).
Series MakeSeries(std::span<const FlowElement> elements, double flow_factor = 1.0);

// Downstream/upstream ratio at which the line passes q; q in [0, q*], clamped outside.
// Strictly falling from 1 at q = 0 to choked_ratio at q*.
double RatioAtFlow(const Series& series, double flow_m3_per_s_pa);

// r and dr/dq in one march (slope is −∞ at q* and is returned as such).
struct RatioAndSlope {
  double ratio;
  double slope_pa_s_per_m3;
};
RatioAndSlope RatioAndSlopeAtFlow(const Series& series, double flow_m3_per_s_pa);

// Flow per upstream pressure at ratio r, the inverse of RatioAtFlow: q* for r ≤ choked_ratio,
// 0 for r ≥ 1; to 1e-12 relative of q*.
double FlowAtRatio(const Series& series, double ratio);

// Flow from a pressure down to another, m³/s ANR; `mirror_pa`: as in model/physics/chamber.h.
double FlowBetween(const Series& series, double mirror_pa, double upstream_pa,
                   double downstream_pa);

// c = √(1 − (q/q*)²) at ratio r, 0 where choked and 1 for r ≥ 1. In c the curve r is smooth from
// end to end (m = ½) and keeps the digits that q loses close to q*.
double CosineAtRatio(const Series& series, double ratio);

// The same from a guess, and how c rises with the ratio there: for many ratios close to each other.
// 0 < guess < 1.
struct CosineAndSlope {
  double cosine;
  double slope;
};
// Of the cosine: the last step of Newton's method, whose square is about the error that is left.
inline constexpr double kLastStep = 1e-8;
CosineAndSlope CosineNear(const Series& series, double ratio, double guess,
                          double step_max = kLastStep);

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_SERIES_H_
