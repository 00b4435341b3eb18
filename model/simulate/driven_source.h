// A source whose pressure over time is given, such as the record of a sensor at the source.
//   p_s(t) = p_a + factor·(p(t) − p_a)
// with p(t) the straight lines through the record's points, and its first and last value outside.
// Steps of the simulator end at every point, so that no feature of the record is passed over: a
// noisy record costs a step or more a sample and should be condensed first. Above a relative
// tolerance of 1e-5 a step may pass up to seven points of a record of many. The check in the line
// passes what noise lifts and holds what it drops, so noise also biases a line near equal
// pressures.
#ifndef PLENUM_MODEL_SIMULATE_DRIVEN_SOURCE_H_
#define PLENUM_MODEL_SIMULATE_DRIVEN_SOURCE_H_

#include <algorithm>
#include <cstddef>
#include <vector>

namespace plenum::model {

struct DrivenSource {
  std::vector<double> time_s;       // rising
  std::vector<double> pressure_pa;  // absolute, as many
  double factor = 1.0;              // on the gauge pressure
  bool operator==(const DrivenSource&) const = default;

  // p(t) of the record, and its slope, 0 outside. `near`: the point after the instant that was
  // asked for last, which is tried first.
  struct Point {
    double pressure_pa, slope_pa_per_s;
  };
  Point RecordedAt(double t_s, std::size_t& near) const {
    if (t_s <= time_s.front()) return {pressure_pa.front(), 0.0};
    if (t_s >= time_s.back()) return {pressure_pa.back(), 0.0};
    const bool known = near > 0 && time_s[near - 1] <= t_s && t_s < time_s[near];
    if (!known) {
      const auto next = std::upper_bound(time_s.begin(), time_s.end(), t_s);
      near = static_cast<std::size_t>(next - time_s.begin());
    }
    const std::size_t i = near;
    const double slope = (pressure_pa[i] - pressure_pa[i - 1]) / (time_s[i] - time_s[i - 1]);
    return {pressure_pa[i - 1] + slope * (t_s - time_s[i - 1]), slope};
  }
  double RecordedPressure(double t_s) const {
    std::size_t near = 0;
    return RecordedAt(t_s, near).pressure_pa;
  }
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_DRIVEN_SOURCE_H_
