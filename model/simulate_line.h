// Flow through a line of elements as the simulator needs it: any two pressures, cracking pressures
// allowed, a straight line to zero flow near equal pressures.
#ifndef PLENUM_MODEL_SIMULATE_LINE_H_
#define PLENUM_MODEL_SIMULATE_LINE_H_

#include <span>
#include <vector>

#include "model/iso6358.h"
#include "model/series.h"

namespace plenum::model {

class Line {
 public:
  Line() = default;  // passes nothing
  // At most kMaxSeriesElements, in the order crossed. `flow_factor` scales every C.
  Line(std::span<const FlowElement> elements, double flow_factor, double linear_ratio);

  // m³/s ANR from `upstream_pa` to `downstream_pa`, 0 where Σ Δp_c or more of the upstream pressure
  // is needed to get there. Above `linear_ratio` of the highest downstream pressure that flow can
  // reach, p1 − Σ Δp_c, a straight line to zero.
  double Flow(double upstream_pa, double downstream_pa) const;

  // Flow per upstream pressure at which the straight line begins; only without cracking pressure.
  double linear_flow_m3_per_s_pa() const { return flow_at_linear_ratio_; }

  // Σ Δp_c: no flow below this difference.
  double cracking_pressure_pa() const { return cracking_pressure_pa_; }

 private:
  double FlowWithCracking(double upstream_pa, double downstream_pa) const;

  std::vector<FlowElement> elements_;
  Series series_;  // if no element has a cracking pressure
  double cracking_pressure_pa_ = 0.0;
  double linear_ratio_ = kLinearRatio;
  double flow_at_linear_ratio_ = 0.0;  // of series_, per upstream pressure
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_LINE_H_
