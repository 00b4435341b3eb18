// A number whose course over time is given, such as the record of a sensor: straight lines through
// its points, the first value before them and the last one after them.
#ifndef PLENUM_MODEL_SIMULATE_TOLD_TIME_COURSE_H_
#define PLENUM_MODEL_SIMULATE_TOLD_TIME_COURSE_H_

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace plenum::model {

struct CoursePoint {
  double value, slope_per_s;  // slope 0 outside the points
};

// `time_s` rises; `value` has as many. `near`: the point after the instant that was asked for last,
// which is tried first.
inline CoursePoint PointOfCourse(const std::vector<double>& time_s,
                                 const std::vector<double>& value, double t_s, std::size_t& near) {
  if (t_s < time_s.front()) return {value.front(), 0.0};
  if (t_s >= time_s.back()) return {value.back(), 0.0};
  const bool known = near > 0 && near < time_s.size() && time_s[near - 1] <= t_s;
  if (!known || t_s >= time_s[near]) {
    const auto next = std::upper_bound(time_s.begin(), time_s.end(), t_s);
    near = static_cast<std::size_t>(next - time_s.begin());
  }
  const std::size_t i = near;
  const double slope = (value[i] - value[i - 1]) / (time_s[i] - time_s[i - 1]);
  return {value[i - 1] + slope * (t_s - time_s[i - 1]), slope};
}

// The next point after an instant, infinite after the last. `rough`: of many points only some, as a
// step may pass up to seven bends that the error control sees.
inline double NextPointOfCourse(const std::vector<double>& time_s, double t_s, bool rough) {
  constexpr std::size_t kPointsAStep = 8, kPointsKept = 32;
  const std::size_t apart =
      rough ? std::clamp<std::size_t>(time_s.size() / kPointsKept, 1, kPointsAStep) : 1;
  const auto next = std::upper_bound(time_s.begin(), time_s.end(), t_s);
  const auto at = static_cast<std::size_t>(next - time_s.begin());
  const std::size_t end = (at + apart - 1) / apart * apart;
  return end < time_s.size() ? time_s[end] : std::numeric_limits<double>::infinity();
}

struct TimeCourse {
  std::vector<double> time_s;  // rising
  std::vector<double> value;   // as many
  bool operator==(const TimeCourse&) const = default;

  bool empty() const { return time_s.empty(); }
  double At(double t_s) const {
    std::size_t near = 0;
    return PointOfCourse(time_s, value, t_s, near).value;
  }
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_TOLD_TIME_COURSE_H_
