// Where a function that falls becomes 0, from its values and slopes.
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_FALLING_ROOT_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_FALLING_ROOT_H_

#include <algorithm>
#include <cmath>

namespace plenum::optimizer {

struct ValueAndSlope {
  double value, slope;
};

// In [low, high], above 0 at `low` and below at `high` > 0, to 1e-13 of this; from a guess, by
// Newton's method, and to the middle of what is left where that leaves it or does not halve its
// step: so each step halves the one before or the interval, and it ends whatever the function is.
template <typename Function>
double FallingRoot(Function&& function, double low, double high, double guess) {
  constexpr double kWidth = 1e-13;
  const double width = kWidth * high;
  double x = std::clamp(guess, low, high), before = high - low;
  if (x == low || x == high) x = 0.5 * (low + high);
  while (high - low > width) {
    const ValueAndSlope at = function(x);
    if (at.value == 0.0) return x;
    (at.value > 0.0 ? low : high) = x;
    const double newton = x - at.value / at.slope;
    const bool converges = newton >= low && newton <= high && std::abs(newton - x) <= 0.5 * before;
    const double next = converges ? newton : 0.5 * (low + high);
    before = std::abs(next - x);
    x = next;
    if (before <= width) break;
  }
  return x;
}

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_FALLING_ROOT_H_
