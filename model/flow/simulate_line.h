// Flow through a line of elements as the simulator needs it: any two pressures, cracking pressures
// allowed, a straight line to zero flow near equal pressures.
#ifndef PLENUM_MODEL_FLOW_SIMULATE_LINE_H_
#define PLENUM_MODEL_FLOW_SIMULATE_LINE_H_

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "model/flow/iso6358.h"
#include "model/flow/scalar.h"
#include "model/flow/series.h"
#include "model/flow/series_curve.h"

namespace plenum::model {

template <class T>
struct LineElement {
  T sonic_conductance_m3_per_s_pa = T(0.0);
  T critical_ratio = T(0.0);
  T cracking_pressure_pa = T(0.0);
  double subsonic_index = 0.5;
};

// Elements of a rig with a factor on what they conduct.
template <class T>
std::vector<LineElement<T>> Lifted(std::span<const FlowElement> elements, const T& factor,
                                   const Lift& lift) {
  std::vector<LineElement<T>> lifted;
  for (const FlowElement& element : elements) {
    lifted.push_back({lift.operator()<T>(element.sonic_conductance_m3_per_s_pa) * factor,
                      lift.operator()<T>(element.critical_ratio),
                      lift.operator()<T>(element.cracking_pressure_pa), element.subsonic_index});
  }
  return lifted;
}

struct LineOptions {
  double linear_ratio = kLinearRatio;
  double mirror_pa = 0.0;  // above 0: pressures are images at half of it (chamber.h)
  double tolerance =
      0.0;  // of the flow, relative; from kCurveError (series_curve.h) on a curve is used
};

// T is double, Dual or WideDual (model/flow/scalar.h).
template <class T>
class Line {
 public:
  Line() = default;  // passes nothing
  // At most kMaxSeriesElements, in the order crossed.
  Line(std::span<const LineElement<T>> elements, const LineOptions& options);

  // m³/s ANR from `upstream_pa` to `downstream_pa`, 0 where Σ Δp_c or more of the upstream pressure
  // is needed to get there. Above `linear_ratio` of the highest downstream pressure that flow can
  // reach, p1 − Σ Δp_c, a straight line to zero.
  // On the border itself `regime` decides, the number of kinks below the ratio; kUnknown: the
  // value.
  static constexpr int kUnknown = -1;
  T Flow(const T& upstream_pa, const T& downstream_pa, int regime = kUnknown) const;

  // Flow while the valve is only partly open: every element but the last `fixed` conducts `opening`
  // (above 0) times its C.
  T ThrottledFlow(const T& opening, std::size_t fixed, const T& upstream_pa,
                  const T& downstream_pa) const;

  // Between these values of downstream_pa / (upstream_pa − Σ Δp_c) the flow is smooth: choked below
  // the first, none above the last.
  static constexpr std::size_t kKinks = 3;
  std::array<double, kKinks> kinks() const { return {choked_ratio_, options_.linear_ratio, 1.0}; }
  T RatioOf(const T& upstream_pa, const T& downstream_pa) const {
    if (options_.mirror_pa > 0.0)
      return (options_.mirror_pa - upstream_pa) /
             (options_.mirror_pa - downstream_pa - cracking_pressure_pa_);
    return downstream_pa / (upstream_pa - cracking_pressure_pa_);
  }

  // Flow per upstream pressure at which the straight line begins; only without cracking pressure.
  double linear_flow_m3_per_s_pa() const { return ValueOf(flow_at_linear_ratio_); }

  // Σ Δp_c: no flow below this difference.
  const T& cracking_pressure_pa() const { return cracking_pressure_pa_; }
  bool empty() const { return elements_.empty(); }

 private:
  struct MarchPoint {
    T pressure;
    double slope;  // d pressure / dq
  };
  T FlowBetween(const T& upstream_pa, const T& downstream_pa, int regime) const;
  T SubsonicFlow(const T& ratio) const;
  double CosineOf(double ratio) const;
  T FlowWithCracking(const T& upstream_pa, const T& downstream_pa) const;
  MarchPoint March(const T& upstream_pa, const T& flow, std::size_t count) const;
  struct Bottleneck {
    std::size_t element;
    double share;
  };
  Bottleneck FindBottleneck(double upstream_pa, double flow) const;
  T LiftSubsonicFlow(double flow, const T& upstream_pa, const T& downstream_pa) const;
  T LiftFlow(double flow, const T& upstream_pa, const T& downstream_pa) const;

  boost::container::static_vector<LineElement<T>, kMaxSeriesElements> elements_;
  Series series_;  // of the values, if no element but the first has a cracking pressure
  bool cracks_inside_ = false;
  T cracking_pressure_pa_ = T(0.0);
  T choked_flow_ = T(0.0);           // of series_, per upstream pressure
  T flow_at_linear_ratio_ = T(0.0);  // the same at linear_ratio
  double choked_ratio_ = 0.0;
  LineOptions options_;
  // The last solution of the march, where the next one starts: an object serves one run at a time.
  mutable double last_ratio_ = 0.0;
  mutable CosineAndSlope last_ = {0.0, 0.0};
  mutable int solved_ = 0;
  mutable std::optional<SeriesCurve> curve_;
};

extern template class Line<double>;
extern template class Line<Dual>;
extern template class Line<WideDual>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_SIMULATE_LINE_H_
