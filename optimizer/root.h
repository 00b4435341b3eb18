// Bracketing on monotone functions that are costly and may be +∞.
#ifndef PLENUM_OPTIMIZER_ROOT_H_
#define PLENUM_OPTIMIZER_ROOT_H_

#include <cmath>

namespace plenum::optimizer {

struct Bracket {
  double low, high;  // excess(low) > 0 unless both are equal; excess(high) ≤ 0
};

// Where an excess that does not rise with x and is ≤ 0 at `high` becomes ≤ 0: a bracket no wider
// than tolerance·high. Illinois steps where both ends are finite, bisection elsewhere.
template <typename Excess>
Bracket FeasibleBracket(Excess&& excess, double low, double high, double tolerance) {
  double f_low = excess(low);
  if (f_low <= 0.0) return {low, low};
  double f_high = excess(high);
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

// Smallest x in [low, high] at which the excess was seen to be ≤ 0, to the tolerance.
template <typename Excess>
double SmallestFeasible(Excess&& excess, double low, double high, double tolerance = 1e-9) {
  return FeasibleBracket(excess, low, high, tolerance).high;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_ROOT_H_
