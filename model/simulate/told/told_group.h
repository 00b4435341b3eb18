// What a record tells of a group while it runs: how far its valve is open, and the volume.
//
// Opening o(t), 0 to 1: while the schedule opens a way, the elements of the line that are the valve
// (GroupRig::inlet_after of them; all, where that is 0) conduct o·C, and what is behind them as
// ever. The valve's delay acts on the record, too.
//   one pair:           Q = o·C·f(p1, p2)
//   valve, then a tube: the exact march through (o·C_v, b_v) and (C_t, b_t)
// Volume V(t): the actuator's without dead volume, whatever the pressure. Its rate enters the
// balance of the gas; it jumps at the record's points, so that each step lies on one straight
// piece. Source: mass balance of a volume with moving boundary; ISO 6358-3 for the line.
#ifndef PLENUM_MODEL_SIMULATE_TOLD_TOLD_GROUP_H_
#define PLENUM_MODEL_SIMULATE_TOLD_TOLD_GROUP_H_

#include <array>
#include <boost/container/static_vector.hpp>
#include <cstddef>
#include <limits>
#include <span>

#include "model/flow/simulate_line.h"
#include "model/simulate/told/told.h"

namespace plenum::model {

// A way through a line that a valve opens: how much of it, and the line's regime.
template <class T>
struct OpenWay {
  const Line<T>* line = nullptr;
  T share = T(0.0);
  int regime = Line<T>::kUnknown;
};

// The next point of what is told, whose opening a delay moves; infinite after the last.
template <class T>
T NextPointOf(const Told& told, double now_s, const T& delay_s, bool rough) {
  constexpr double kPast = 1e-12;  // within this share of the time a moved point is past
  T next_s(std::numeric_limits<double>::infinity());
  if (!told.volume_m3.empty()) next_s = T(NextPointOfCourse(told.volume_m3.time_s, now_s, false));
  if (told.opening.empty()) return next_s;
  const double past_s = now_s * (1.0 + kPast) - ValueOf(delay_s);
  const T turn_s = NextPointOfCourse(told.opening.time_s, past_s, rough) + delay_s;
  return turn_s < next_s ? turn_s : next_s;
}

// The elements of a line that a valve turns.
struct TurnedElements {
  std::size_t first = 0, count = 0;
};

template <class T>
class ToldGroup {
 public:
  ToldGroup() = default;  // tells nothing
  // `told` must outlive it.
  ToldGroup(const Told& told, const T& delay_s) : told_(&told), delay_s_(delay_s) { Settle(0.0); }

  bool turns() const { return told_ && !told_->opening.empty(); }
  bool stretches() const { return told_ && !told_->volume_m3.empty(); }

  // Whether the opening still moves.
  bool Turning(double time_s) const {
    return turns() && time_s < told_->opening.time_s.back() + ValueOf(delay_s_);
  }

  // Throttles an open way by the opening. `line`: 0 or 1, which of the two ways it is.
  void Throttle(const T& t, std::size_t line, std::span<const LineElement<T>> elements,
                TurnedElements turned, const LineOptions& options, OpenWay<T>& way) {
    if (!turns() || !(way.share > 0.0)) return;
    const T opening = OpeningAt(t);
    if (!(opening > kClosed) || turned.count == 0 || turned.count == elements.size()) {
      way.share *= opening;
      return;
    }
    boost::container::static_vector<LineElement<T>, kMaxSeriesElements> part(elements.begin(),
                                                                             elements.end());
    for (std::size_t i = turned.first; i < turned.first + turned.count; ++i)
      part[i].sonic_conductance_m3_per_s_pa *= opening;
    throttled_[line] = Line<T>(std::span<const LineElement<T>>(part.data(), part.size()), options);
    way.line = &throttled_[line];
    way.regime = Line<T>::kUnknown;
  }

  // The straight piece of the volume's record that holds from an instant on.
  void Settle(double time_s) {
    if (!stretches()) return;
    piece_s_ = time_s;
    piece_ = PointOfCourse(told_->volume_m3.time_s, told_->volume_m3.value, time_s, near_volume_);
  }
  T Volume(const T& t) const { return piece_.value + piece_.slope_per_s * (t - piece_s_); }
  double volume_rate_m3_per_s() const { return piece_.slope_per_s; }

 private:
  // Below this a valve in front of a tube is the only resistance, whose flow goes with the opening.
  static constexpr double kClosed = 1e-9;

  T OpeningAt(const T& t) const {
    const T at_s = t - delay_s_;
    const TimeCourse& record = told_->opening;
    const CoursePoint at = PointOfCourse(record.time_s, record.value, ValueOf(at_s), near_opening_);
    return Chain(at_s, at.value, at.slope_per_s);
  }

  const Told* told_ = nullptr;
  T delay_s_ = T(0.0);
  mutable std::size_t near_opening_ = 0, near_volume_ = 0;
  double piece_s_ = 0.0;
  CoursePoint piece_ = {0.0, 0.0};
  std::array<Line<T>, 2> throttled_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_TOLD_TOLD_GROUP_H_
