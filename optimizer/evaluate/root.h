// Bracketing on monotone functions that are costly and may be +∞.
#ifndef PLENUM_OPTIMIZER_EVALUATE_ROOT_H_
#define PLENUM_OPTIMIZER_EVALUATE_ROOT_H_

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace plenum::optimizer {

struct Bracket {
  double low, high;  // excess(low) > 0 unless both are equal; excess(high) ≤ 0
};

// Where a falling function through three points, or through the first two if that is between them,
// becomes 0: the second degree in its value.
struct Sample {
  double x, f;
};
inline double Zero(const Sample& low, const Sample& high, const Sample& third) {
  const auto share = [](const Sample& at, const Sample& a, const Sample& b) {
    return at.x * a.f * b.f / ((at.f - a.f) * (at.f - b.f));
  };
  const double zero = share(low, high, third) + share(high, low, third) + share(third, low, high);
  return zero > low.x && zero < high.x ? zero
                                       : high.x - high.f * (high.x - low.x) / (high.f - low.f);
}

// Narrows a bracket of where an excess that does not rise with x becomes ≤ 0, from its values
// f_low > 0 ≥ f_high at the ends, down to tolerance·high. Steps go to the zero of what the last
// values lie on, a little to its right and left in turn, since both ends are to come close; to the
// middle where an end is infinite or two steps did not halve the bracket.
template <typename Excess>
Bracket NarrowBracket(Excess&& excess, double low_x, double f_low, double high_x, double f_high,
                      double tolerance) {
  Sample low{low_x, f_low}, high{high_x, f_high}, third{low_x, f_low};
  bool left = false;
  for (int i = 0, slow = 0; i < 200 && high.x - low.x > tolerance * high.x; ++i) {
    const double width = high.x - low.x;
    Sample middle{0.5 * (low.x + high.x), 0.0};
    if (slow < 2 && std::isfinite(low.f) && std::isfinite(high.f) && high.f < low.f) {
      const double edge = 0.25 * tolerance * high.x;
      const double zero = Zero(low, high, third) + (left ? -edge : edge);
      middle.x = std::clamp(zero, low.x + edge, high.x - edge);
    }
    middle.f = excess(middle.x);
    left = middle.f <= 0.0;
    third = std::exchange(left ? high : low, middle);
    slow = slow < 2 && high.x - low.x > 0.5 * width ? slow + 1 : 0;
  }
  return {low.x, high.x};
}

// The same for an excess that is ≤ 0 at `high`; both ends are `low` where it already is there.
template <typename Excess>
Bracket FeasibleBracket(Excess&& excess, double low, double high, double tolerance) {
  const double f_low = excess(low);
  if (f_low <= 0.0) return {low, low};
  return NarrowBracket(excess, low, f_low, high, excess(high), tolerance);
}

// Raises a floor below which the excess is known to be > 0 as far as it is, to the tolerance; none
// where it still is at `high`, or once a floor that is reached is not `bearable`, as none above is.
// Cheap where the floor is already close: it is looked for in ever longer steps.
template <typename Excess, typename Bearable>
std::optional<double> RaisedFloor(Excess&& excess, double floor, double high, double tolerance,
                                  Bearable&& bearable) {
  constexpr double kGrowth = 4.0;
  double step = tolerance * high;
  double low = std::min(floor + step, high);
  double f_low = excess(low);
  if (f_low <= 0.0) return floor;
  while (low < high && bearable(low)) {
    step *= kGrowth;
    const double next = std::min(floor + step, high);
    const double f_next = excess(next);
    if (f_next <= 0.0) return NarrowBracket(excess, low, f_low, next, f_next, tolerance).low;
    low = next;
    f_low = f_next;
  }
  return std::nullopt;
}

template <typename Excess>
std::optional<double> RaisedFloor(Excess&& excess, double floor, double high, double tolerance) {
  return RaisedFloor(excess, floor, high, tolerance, [](double) { return true; });
}

// Smallest x in [low, high] at which the excess was seen to be ≤ 0, to the tolerance.
template <typename Excess>
double SmallestFeasible(Excess&& excess, double low, double high, double tolerance = 1e-9) {
  return FeasibleBracket(excess, low, high, tolerance).high;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_ROOT_H_
