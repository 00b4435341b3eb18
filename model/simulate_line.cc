#include "model/simulate_line.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plenum::model {

Line::Line(std::span<const FlowElement> elements, double flow_factor, double linear_ratio)
    : elements_(elements.begin(), elements.end()), linear_ratio_(linear_ratio) {
  if (elements_.empty()) return;
  for (const FlowElement& element : elements_)
    cracking_pressure_pa_ += element.cracking_pressure_pa;
  if (cracking_pressure_pa_ == 0.0) {
    series_ = MakeSeries(elements, flow_factor);
    flow_at_linear_ratio_ = FlowAtRatio(series_, linear_ratio);
  }
  for (FlowElement& element : elements_) element.sonic_conductance_m3_per_s_pa *= flow_factor;
}

double Line::Flow(double upstream_pa, double downstream_pa) const {
  const double head_pa = upstream_pa - cracking_pressure_pa_;
  if (elements_.empty() || !(head_pa > 0.0) || head_pa <= downstream_pa) return 0.0;
  const double ratio = downstream_pa / head_pa;
  const double share = (1.0 - ratio) / (1.0 - linear_ratio_);
  if (cracking_pressure_pa_ > 0.0) {
    return share >= 1.0 ? FlowWithCracking(upstream_pa, downstream_pa)
                        : share * FlowWithCracking(upstream_pa, linear_ratio_ * head_pa);
  }
  return upstream_pa * (share >= 1.0 ? FlowAtRatio(series_, ratio) : share * flow_at_linear_ratio_);
}

// The largest flow with which every element can be crossed and the end pressure is not below
// `downstream_pa`. The end pressure falls with the flow, so bisection finds it.
double Line::FlowWithCracking(double upstream_pa, double downstream_pa) const {
  const auto arrives = [&](double flow) {
    double pressure = upstream_pa;
    for (const FlowElement& element : elements_) {
      pressure -= element.cracking_pressure_pa;
      const double z = flow / (element.sonic_conductance_m3_per_s_pa * pressure);
      if (!(pressure > 0.0) || z > 1.0) return false;
      const double power =
          element.subsonic_index == 0.5 ? z * z : std::pow(z, 1.0 / element.subsonic_index);
      const double b = element.critical_ratio;
      pressure *= b + (1.0 - b) * std::sqrt(1.0 - power);
    }
    return pressure >= downstream_pa;
  };
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
  for (const FlowElement& element : elements_) {
    high = std::min(high, element.sonic_conductance_m3_per_s_pa * upstream_pa);
  }
  for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
    (arrives(middle) ? low : high) = middle;
    if (high - low <= 1e-15 * high) break;
  }
  return low;
}

}  // namespace plenum::model
