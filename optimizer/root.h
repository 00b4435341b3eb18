// Bracketing on monotone functions that are costly and may be +∞.
#ifndef PLENUM_OPTIMIZER_ROOT_H_
#define PLENUM_OPTIMIZER_ROOT_H_

#include <algorithm>
#include <cmath>
#include <optional>

namespace plenum::optimizer {

struct Bracket {
  double low, high;  // excess(low) > 0 unless both are equal; excess(high) ≤ 0
};

// Narrows a bracket of where an excess that does not rise with x becomes ≤ 0, from its values
// f_low > 0 ≥ f_high at the ends, down to tolerance·high. Illinois steps where both ends are
// finite, bisection elsewhere.
template <typename Excess>
Bracket NarrowBracket(Excess&& excess, double low, double f_low, double high, double f_high,
                      double tolerance) {
  int side = 0;
  for (int i = 0; i < 200 && high - low > tolerance * high; ++i) {
    double mid = 0.5 * (low + high);
    const bool secant =
        std::isfinite(f_low) && std::isfinite(f_high) && f_high < f_low && i % 4 != 3;
    if (secant) {
      mid = high - f_high * (high - low) / (f_high - f_low);
      const double edge = 0.25 * tolerance * high;
      if (!(mid > low + edge)) mid = low + edge;
      if (!(mid < high - edge)) mid = high - edge;
    }
    const double f = excess(mid);
    if (f <= 0.0) {
      high = mid;
      f_high = f;
      if (side == 1) f_low *= 0.5;
      side = 1;
    } else {
      low = mid;
      f_low = f;
      if (side == -1) f_high *= 0.5;
      side = -1;
    }
  }
  return {low, high};
}

// The same for an excess that is ≤ 0 at `high`; both ends are `low` where it already is there.
template <typename Excess>
Bracket FeasibleBracket(Excess&& excess, double low, double high, double tolerance) {
  const double f_low = excess(low);
  if (f_low <= 0.0) return {low, low};
  return NarrowBracket(excess, low, f_low, high, excess(high), tolerance);
}

// Raises a floor below which the excess is known to be > 0 as far as it is, to the tolerance; none
// where it still is at `high`. Cheap where the floor is already close: it is looked for in ever
// longer steps.
template <typename Excess>
std::optional<double> RaisedFloor(Excess&& excess, double floor, double high, double tolerance) {
  constexpr double kGrowth = 4.0;
  double step = tolerance * high;
  double low = std::min(floor + step, high);
  double f_low = excess(low);
  if (f_low <= 0.0) return floor;
  while (low < high) {
    step *= kGrowth;
    const double next = std::min(floor + step, high);
    const double f_next = excess(next);
    if (f_next <= 0.0) return NarrowBracket(excess, low, f_low, next, f_next, tolerance).low;
    low = next;
    f_low = f_next;
  }
  return std::nullopt;
}

// Smallest x in [low, high] at which the excess was seen to be ≤ 0, to the tolerance.
template <typename Excess>
double SmallestFeasible(Excess&& excess, double low, double high, double tolerance = 1e-9) {
  return FeasibleBracket(excess, low, high, tolerance).high;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_ROOT_H_
