// Root of a continuous function between two points of opposite sign.
#ifndef PLENUM_MODEL_INTEGRATE_SIMULATE_ROOT_H_
#define PLENUM_MODEL_INTEGRATE_SIMULATE_ROOT_H_

#include <algorithm>
#include <cmath>

namespace plenum::model {

// Bisection with inverse quadratic interpolation where that is safe (Chandrupatla 1997). `fa` and
// `fb` are the values at a and b, of opposite sign or zero. Stops when the bracket is shorter than
// `tolerance` (absolute) or cannot be halved any more; returns the end with the smaller |f|.
template <class Function>
double RootBetween(const Function& f, double a, double fa, double b, double fb, double tolerance) {
  if (fa == 0.0) return a;
  if (fb == 0.0) return b;
  double c = a, fc = fa;
  double step = 0.5;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double x = a + step * (b - a);
    const double fx = f(x);
    if ((fx > 0.0) == (fa > 0.0)) {
      c = a, fc = fa;
    } else {
      c = b, b = a, fc = fb, fb = fa;
    }
    a = x, fa = fx;
    const bool a_is_best = std::abs(fa) < std::abs(fb);
    const double best = a_is_best ? a : b;
    const double least_share = (2e-16 * std::abs(best) + 0.5 * tolerance) / std::abs(b - a);
    if (fa == 0.0 || least_share > 0.5) return best;
    const double xi = (a - b) / (c - b);
    const double phi = (fa - fb) / (fc - fb);
    const bool interpolate = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    step = interpolate ? fa / (fb - fa) * fc / (fb - fc) +
                             (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
                       : 0.5;
    step = std::clamp(step, least_share, 1.0 - least_share);
  }
  return std::abs(fa) < std::abs(fb) ? a : b;
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_SIMULATE_ROOT_H_
