// Whether a group's chambers fill in time out of a source of constant pressure: the operating
// pressure within its window (gait.h), and the target of the rise within its limit.
#ifndef PLENUM_OPTIMIZER_EVALUATE_FILLING_H_
#define PLENUM_OPTIMIZER_EVALUATE_FILLING_H_

#include <optional>
#include <span>

#include "model/flow/series.h"
#include "model/strokes/stroke_enclosure.h"
#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

class Filling {
 public:
  // `elements` from the source to one actuator, which outlive this, as the chamber does; `slack`: a
  // factor on the limits; `flow_max_m3_per_s`: ANR, per actuator.
  Filling(const Problem& problem, int group, std::span<const model::FlowElement> elements,
          double flow_factor, const model::Chamber& chamber, double slack,
          double flow_max_m3_per_s = kUnlimited);

  // How much later than the limits the strokes are, s; positive where the source is too weak.
  double Lateness(double source_pa);
  // At most that, at a tenth of the cost; none where there is no enclosure.
  std::optional<double> LatenessAtLeast(double source_pa);
  // Lateness() ≤ 0, by the enclosure where that decides.
  bool InTime(double source_pa);

  double InflateTime(double source_pa) { return FillTime(source_pa, operating_pa_); }
  // At most that; 0 where there is no enclosure.
  double InflateTimeAtLeast(double source_pa);

  const model::Series& series();

 private:
  double FillTime(double source_pa, double to_pa);
  struct Enclosures {
    bool known;
    model::Enclosure inflate, rise;
  };
  const Enclosures& Enclose(double source_pa);

  const Problem& problem_;
  const ActuatorGroup& group_;
  std::span<const model::FlowElement> elements_;
  double flow_factor_;
  const model::Chamber& chamber_;
  double flow_max_m3_per_s_;
  double operating_pa_, rise_pa_, window_s_, rise_max_s_;
  std::optional<model::Series> series_;
  double enclosed_pa_ = 0.0;  // of enclosures_
  Enclosures enclosures_{};
};

// Factor on the limits of boxes: corners are compared with limits a hair wider than what they
// bound, so that rounding in a corner never decides.
inline constexpr double kBoxSlack = 1.0 + 1e-9;

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_FILLING_H_
