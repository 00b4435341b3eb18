#include "model/flow/series.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace plenum::model {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Pressure behind some elements at flow q, both per pressure in front of them, and its slope.
struct MarchPoint {
  double pressure = 1.0;
  double slope = 0.0;  // d pressure / dq
};

// p·[b + (1−b)·s], s = √(1 − z^{1/m}), z = q/(C·p).
double PressureAfter(const FlowElement& element, double pressure, double flow) {
  const double z = flow / (element.sonic_conductance_m3_per_s_pa * pressure);
  const double power =
      element.subsonic_index == 0.5 ? z * z : std::pow(z, 1.0 / element.subsonic_index);
  const double s = std::sqrt(std::max(0.0, 1.0 - power));
  return pressure * (element.critical_ratio + (1.0 - element.critical_ratio) * s);
}

MarchPoint PointAfter(const FlowElement& element, const MarchPoint& before, double flow) {
  const double inverse = 1.0 / (element.sonic_conductance_m3_per_s_pa * before.pressure);
  const double z = flow * inverse;
  const double z_slope = inverse * (1.0 - flow * before.slope / before.pressure);
  double power = z * z;
  double power_slope = 2.0 * z;
  if (element.subsonic_index != 0.5) {
    const double exponent = 1.0 / element.subsonic_index;
    power = std::pow(z, exponent);
    power_slope = exponent * std::pow(z, exponent - 1.0);
  }
  const double s = std::sqrt(std::max(0.0, 1.0 - power));
  const double width = 1.0 - element.critical_ratio;
  const double ratio = element.critical_ratio + width * s;
  const double ratio_slope = -0.5 * width * power_slope / s;
  return {before.pressure * ratio, before.slope * ratio + before.pressure * ratio_slope * z_slope};
}

MarchPoint March(std::span<const FlowElement> elements, double flow) {
  MarchPoint point;
  for (const FlowElement& element : elements) point = PointAfter(element, point, flow);
  return point;
}

std::span<const FlowElement> Elements(const Series& series) {
  return {series.elements.data(), series.size};
}

// Solves f(q) = 0 for c = √(1 − (q/q_max)²) in (0, 1), where f falls with q and `f(q)` gives value
// and slope. In c the curves of a line are smooth up to q_max and nearly straight, so Newton's
// method takes few steps; bisection steps in where it leaves the bracket.
template <class Function>
double SolveCosine(double flow_max, double start, double step_max, const Function& f) {
  double low = 0.0;
  double high = 1.0;
  double c = std::clamp(start, 1e-12, 1.0 - 1e-16);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double flow = flow_max * std::sqrt((1.0 - c) * (1.0 + c));
    const MarchPoint value = f(flow);
    (value.pressure > 0.0 ? high : low) = c;
    const double slope = -value.slope * flow_max * flow_max * c / flow;
    double next = c - value.pressure / slope;
    // Also where rounding leaves nothing to move by, at the end of the bracket.
    if (std::isfinite(slope) &&
        std::abs(next - c) <= step_max * std::min(1.0, 10.0 * next) * (1.0 - next))
      return next;
    if (!(std::isfinite(slope) && next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::abs(next - c);
    c = next;
    if (step <= 1e-16 || high - low <= 2e-16 * high) break;
  }
  return c;
}

// Choked flow of the line so far and the element that sets it.
struct Choke {
  double flow;
  std::size_t element;
};

// Pressure in front of element `end` at the choked flow of the elements before it. The choking
// element drops to exactly b·p, which rounding in 1 − z² would blur by 1e-8.
double ChokedPressure(std::span<const FlowElement> elements, const Choke& choke) {
  double pressure = 1.0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    pressure = i == choke.element ? pressure * elements[i].critical_ratio
                                  : PressureAfter(elements[i], pressure, choke.flow);
  }
  return pressure;
}

// The largest q with q ≤ C_i·p_i(q) for all i. Adding an element either leaves the choked flow of
// those before it or lowers it to the root of q = C·p(q).
Choke FindChoke(std::span<const FlowElement> elements) {
  Choke choke = {elements[0].sonic_conductance_m3_per_s_pa, 0};
  for (std::size_t i = 1; i < elements.size(); ++i) {
    const auto before = elements.first(i);
    const double conductance = elements[i].sonic_conductance_m3_per_s_pa;
    if (conductance * ChokedPressure(before, choke) >= choke.flow) continue;
    const double flow_max = std::min(choke.flow, conductance);
    const double quotient = flow_max / std::max(choke.flow, conductance);
    const double start = quotient / std::sqrt(1.0 + quotient * quotient);
    const double c = SolveCosine(flow_max, start, kLastStep, [&](double flow) {
      const MarchPoint point = March(before, flow);
      return MarchPoint{point.pressure - flow / conductance, point.slope - 1.0 / conductance};
    });
    choke = {flow_max * std::sqrt((1.0 - c) * (1.0 + c)), i};
  }
  return choke;
}

}  // namespace

Series MakeSeries(std::span<const FlowElement> elements, double flow_factor) {
  assert(!elements.empty() && elements.size() <= kMaxSeriesElements);
  Series series;
  series.size = elements.size();
  for (std::size_t i = 0; i < elements.size(); ++i) {
    assert(elements[i].cracking_pressure_pa == 0.0);
    series.elements[i] = elements[i];
    series.elements[i].sonic_conductance_m3_per_s_pa *= flow_factor;
  }
  const Choke choke = FindChoke(Elements(series));
  series.choked_flow_m3_per_s_pa = choke.flow;
  series.choked_ratio = ChokedPressure(Elements(series), choke);
  return series;
}

double RatioAtFlow(const Series& series, double flow_m3_per_s_pa) {
  if (flow_m3_per_s_pa <= 0.0) return 1.0;
  if (flow_m3_per_s_pa >= series.choked_flow_m3_per_s_pa) return series.choked_ratio;
  double ratio = 1.0;
  for (const FlowElement& element : Elements(series)) {
    ratio = PressureAfter(element, ratio, flow_m3_per_s_pa);
  }
  return ratio;
}

RatioAndSlope RatioAndSlopeAtFlow(const Series& series, double flow_m3_per_s_pa) {
  if (flow_m3_per_s_pa >= series.choked_flow_m3_per_s_pa) return {series.choked_ratio, -kInfinity};
  const MarchPoint point = March(Elements(series), std::max(0.0, flow_m3_per_s_pa));
  return {point.pressure, point.slope};
}

double CosineAtRatio(const Series& series, double ratio) {
  if (ratio <= series.choked_ratio) return 0.0;
  if (ratio >= 1.0) return 1.0;
  // Exact where the line is one ellipse.
  const double start = (ratio - series.choked_ratio) / (1.0 - series.choked_ratio);
  if (start < 1e-12) return start;  // q* to the last digit
  return SolveCosine(series.choked_flow_m3_per_s_pa, start, kLastStep, [&](double flow) {
    const MarchPoint point = March(Elements(series), flow);
    return MarchPoint{point.pressure - ratio, point.slope};
  });
}

CosineAndSlope CosineNear(const Series& series, double ratio, double guess, double step_max) {
  const double flow_max = series.choked_flow_m3_per_s_pa;
  double slope = 1.0;  // d ratio / dc at the last point
  const double c = SolveCosine(flow_max, guess, step_max, [&](double flow) {
    const MarchPoint point = March(Elements(series), flow);
    const double q = flow / flow_max;
    slope = -point.slope * flow_max * std::sqrt((1.0 - q) * (1.0 + q)) / q;
    return MarchPoint{point.pressure - ratio, point.slope};
  });
  return {c, 1.0 / slope};
}

double FlowAtRatio(const Series& series, double ratio) {
  const double c = CosineAtRatio(series, ratio);
  return series.choked_flow_m3_per_s_pa * std::sqrt((1.0 - c) * (1.0 + c));
}

double FlowBetween(const Series& series, double mirror_pa, double upstream_pa,
                   double downstream_pa) {
  return (mirror_pa > 0.0 ? mirror_pa - downstream_pa : upstream_pa) *
         FlowAtRatio(series, PressureRatio(mirror_pa, upstream_pa, downstream_pa));
}

}  // namespace plenum::model
