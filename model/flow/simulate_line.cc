#include "model/flow/simulate_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace plenum::model {
namespace {

using std::sqrt;

// A ratio this close to the border of two regimes is on it.
constexpr double kBorderWidth = 1e-9;
constexpr double kCosineStep = 1e-5;      // of Newton's method; leaves 1e-11 of the flow
constexpr double kSurelySubsonic = 1e-3;  // cosine
constexpr int kSolvedOneByOne = 64;       // before a curve is worth its points

// b + (1−b)·√(1 − z^{1/m}): pressure behind an element per pressure in front of it.
template <class T>
T PressureRatio(const LineElement<T>& element, const T& z) {
  using std::pow;
  const T power =
      element.subsonic_index == 0.5 ? T(z * z) : T(pow(z, 1.0 / element.subsonic_index));
  return element.critical_ratio + (1.0 - element.critical_ratio) * sqrt(1.0 - power);
}

template <class T>
LineElement<double> ValuesOf(const LineElement<T>& element) {
  return {ValueOf(element.sonic_conductance_m3_per_s_pa), ValueOf(element.critical_ratio),
          ValueOf(element.cracking_pressure_pa), element.subsonic_index};
}

}  // namespace

template <class T>
Line<T>::Line(std::span<const LineElement<T>> elements, const LineOptions& options)
    : elements_(elements.begin(), elements.end()), options_(options) {
  if (elements_.empty()) return;
  std::array<FlowElement, kMaxSeriesElements> values;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    cracking_pressure_pa_ += elements_[i].cracking_pressure_pa;
    cracks_inside_ = cracks_inside_ || (i > 0 && !IsZero(elements_[i].cracking_pressure_pa));
    values[i] = {
        .sonic_conductance_m3_per_s_pa = ValueOf(elements_[i].sonic_conductance_m3_per_s_pa),
        .critical_ratio = ValueOf(elements_[i].critical_ratio),
        .subsonic_index = elements_[i].subsonic_index};
  }
  if (cracks_inside_) return;
  // A cracking pressure in front of everything is lost head, and the rest is homogeneous.
  elements_[0].cracking_pressure_pa = T(0.0);
  series_ = MakeSeries(std::span(values.data(), elements_.size()));
  choked_ratio_ = series_.choked_ratio;
  choked_flow_ = LiftFlow(series_.choked_flow_m3_per_s_pa, T(1.0), T(series_.choked_ratio));
  flow_at_linear_ratio_ = SubsonicFlow(T(options.linear_ratio));
}

// Pressure behind the first `count` elements at flow q, and how it falls with q.
template <class T>
typename Line<T>::MarchPoint Line<T>::March(const T& upstream_pa, const T& flow,
                                            std::size_t count) const {
  MarchPoint point = {upstream_pa, 0.0};
  for (std::size_t i = 0; i < count; ++i) {
    const LineElement<T>& element = elements_[i];
    const T front = point.pressure - element.cracking_pressure_pa;
    const T z = flow / (element.sonic_conductance_m3_per_s_pa * front);
    const T ratio = PressureRatio(element, z);
    const double zv = ValueOf(z);
    const double b = ValueOf(element.critical_ratio);
    const double exponent = 1.0 / element.subsonic_index;
    const double power_slope =
        element.subsonic_index == 0.5 ? 2.0 * zv : exponent * std::pow(zv, exponent - 1.0);
    const double root = (ValueOf(ratio) - b) / (1.0 - b);
    const double ratio_slope = -0.5 * (1.0 - b) * power_slope / root;
    const double z_slope = zv / ValueOf(flow) - zv * point.slope / ValueOf(front);
    point.slope = point.slope * ValueOf(ratio) + ValueOf(front) * ratio_slope * z_slope;
    point.pressure = front * ratio;
  }
  return point;
}

// The element that uses the largest share z of the flow it could pass, and that share.
template <class T>
typename Line<T>::Bottleneck Line<T>::FindBottleneck(double upstream_pa, double flow) const {
  Bottleneck largest = {0, 0.0};
  double pressure = upstream_pa;
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const LineElement<double> element = ValuesOf(elements_[i]);
    pressure -= element.cracking_pressure_pa;
    const double z = std::min(1.0, flow / (element.sonic_conductance_m3_per_s_pa * pressure));
    if (z > largest.share) largest = {i, z};
    pressure *= PressureRatio(element, z);
  }
  return largest;
}

// The solved flow with derivatives: one Newton step in dual numbers on the equation that sets it,
// the pressure at the end of the line.
template <class T>
T Line<T>::LiftSubsonicFlow(double flow, const T& upstream_pa, const T& downstream_pa) const {
  if constexpr (kIsDual<T>) {
    const MarchPoint end = March(upstream_pa, T(flow), elements_.size());
    const T residual = end.pressure - downstream_pa;
    return T(flow) - (residual - ValueOf(residual)) / end.slope;
  }
  return T(flow);
}

// The same where an element may be choked: then q = C·p(q) there.
template <class T>
T Line<T>::LiftFlow(double flow, const T& upstream_pa, const T& downstream_pa) const {
  if constexpr (kIsDual<T>) {
    if (!(flow > 0.0)) return T(flow);
    const Bottleneck bottleneck = FindBottleneck(ValueOf(upstream_pa), flow);
    const bool choked = bottleneck.share > 1.0 - 1e-12;
    if (!choked) return LiftSubsonicFlow(flow, upstream_pa, downstream_pa);
    const MarchPoint end = March(upstream_pa, T(flow), bottleneck.element);
    const LineElement<T>& element = elements_[bottleneck.element];
    const T residual =
        element.sonic_conductance_m3_per_s_pa * (end.pressure - element.cracking_pressure_pa) -
        flow;
    const double slope = ValueOf(element.sonic_conductance_m3_per_s_pa) * end.slope - 1.0;
    return T(flow) - (residual - ValueOf(residual)) / slope;
  }
  return T(flow);
}

// c = √(1 − (q/q*)²) at a ratio above choked_ratio_.
template <class T>
double Line<T>::CosineOf(double ratio) const {
  if (curve_) return curve_->CosineAt(ratio);
  if (options_.tolerance >= kCurveError && ++solved_ == kSolvedOneByOne)
    curve_ = SeriesCurve::Of(series_);
  // The ratio moves little from call to call: the last solution leads to the next.
  const double guess = last_.cosine + last_.slope * (ratio - last_ratio_);
  if (guess > 1e-3 && guess < 1.0)
    last_ = CosineNear(series_, ratio, guess, kCosineStep);
  else
    last_ = {CosineAtRatio(series_, ratio), 1.0 / (1.0 - choked_ratio_)};
  last_ratio_ = ratio;
  return last_.cosine;
}

// Flow per upstream pressure at a ratio above choked_ratio_.
template <class T>
T Line<T>::SubsonicFlow(const T& ratio) const {
  if (elements_.size() == 1 && elements_[0].subsonic_index == 0.5) {
    const T width = 1.0 - elements_[0].critical_ratio;
    const T share = (1.0 - ratio) / width;
    return choked_flow_ * sqrt(share * (2.0 - share));
  }
  const double cosine = CosineOf(ValueOf(ratio));
  const double flow = series_.choked_flow_m3_per_s_pa * std::sqrt((1.0 - cosine) * (1.0 + cosine));
  return cosine > kSurelySubsonic ? LiftSubsonicFlow(flow, T(1.0), ratio)
                                  : LiftFlow(flow, T(1.0), ratio);
}

template <class T>
T Line<T>::Flow(const T& upstream_pa, const T& downstream_pa, int regime) const {
  const double mirror_pa = options_.mirror_pa;
  return mirror_pa > 0.0
             ? FlowBetween(T(mirror_pa - downstream_pa), T(mirror_pa - upstream_pa), regime)
             : FlowBetween(upstream_pa, downstream_pa, regime);
}

// The same of pressures as they are.
template <class T>
T Line<T>::FlowBetween(const T& upstream_pa, const T& downstream_pa, int regime) const {
  const T head_pa = upstream_pa - cracking_pressure_pa_;
  if (elements_.empty() || !(head_pa > 0.0) || head_pa <= downstream_pa) return T(0.0);
  const T ratio = downstream_pa / head_pa;
  bool linear = ratio > options_.linear_ratio;
  // The flow is the same on both sides, but its derivatives are not.
  if (kIsDual<T> && regime != kUnknown &&
      std::abs(ValueOf(ratio) - options_.linear_ratio) < kBorderWidth) {
    linear = regime > 1;
  }
  const T share = (1.0 - ratio) / (1.0 - options_.linear_ratio);
  if (cracks_inside_) {
    return linear ? T(share * FlowWithCracking(upstream_pa, options_.linear_ratio * head_pa))
                  : FlowWithCracking(upstream_pa, downstream_pa);
  }
  if (linear) return head_pa * share * flow_at_linear_ratio_;
  return head_pa * (ratio <= choked_ratio_ ? choked_flow_ : SubsonicFlow(ratio));
}

template <class T>
T Line<T>::ThrottledFlow(const T& opening, std::size_t fixed, const T& upstream_pa,
                         const T& downstream_pa) const {
  if (fixed == 0) return opening * Flow(upstream_pa, downstream_pa);
  auto elements = elements_;
  for (std::size_t i = 0; i + fixed < elements.size(); ++i) {
    elements[i].sonic_conductance_m3_per_s_pa *= opening;
  }
  if (!cracks_inside_ && !elements.empty()) {
    elements[0].cracking_pressure_pa = cracking_pressure_pa_;
  }
  return Line<T>({elements.data(), elements.size()}, options_).Flow(upstream_pa, downstream_pa);
}

// The largest flow with which every element can be crossed and the end pressure is not below
// `downstream_pa`. The end pressure falls with the flow, so bisection finds it.
template <class T>
T Line<T>::FlowWithCracking(const T& upstream_pa, const T& downstream_pa) const {
  const auto arrives = [&](double flow) {
    double pressure = ValueOf(upstream_pa);
    for (const LineElement<T>& lifted : elements_) {
      const LineElement<double> element = ValuesOf(lifted);
      pressure -= element.cracking_pressure_pa;
      const double z = flow / (element.sonic_conductance_m3_per_s_pa * pressure);
      if (!(pressure > 0.0) || z > 1.0) return false;
      pressure *= PressureRatio(element, z);
    }
    return pressure >= ValueOf(downstream_pa);
  };
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  for (const LineElement<T>& element : elements_) {
    high = std::min(high, ValueOf(element.sonic_conductance_m3_per_s_pa) * ValueOf(upstream_pa));
  }
  for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
    (arrives(middle) ? low : high) = middle;
    if (high - low <= 1e-15 * high) break;
  }
  return LiftFlow(low, upstream_pa, downstream_pa);
}

template class Line<double>;
template class Line<Dual>;
template class Line<WideDual>;

}  // namespace plenum::model
