// Whether a series is white noise.
//
// Ljung–Box over up to 20 lags, with missing values: with m_k pairs at lag k of n values,
//   r_k = (Σ e_i·e_{i+k}/m_k) / (Σ e_i²/n),   Q = (n+2)/n·Σ m_k·r_k²,
// which is the published form where nothing is missing, and χ² of as many degrees of freedom as
// lags for white noise. The mean is not taken off: noise has none, and a model that is off by a
// constant must be seen. Slow structure under much noise hides in the first 20 lags, so Q is also
// taken of means over 4, 16, 64, … neighbours, as long as 100 of them are left, and the limit is
// that of the largest of all. Lags count samples; of uneven samples too, where white stays white.
// Source: Ljung & Box, Biometrika 65 (1978) 297.
#ifndef PLENUM_CALIBRATION_NOISE_WHITENESS_H_
#define PLENUM_CALIBRATION_NOISE_WHITENESS_H_

#include <span>
#include <vector>

namespace plenum::calibration {

// Chance that a test here raises an alarm on pure noise.
inline constexpr double kFalseAlarm = 1e-3;

struct Portmanteau {
  double statistic = 0.0;  // of the width of mean that goes furthest towards its limit
  double limit = 0.0;      // exceeded by white noise with kFalseAlarm
  int width = 1;           // of the means at which it was largest
};

// Of several series of one unit of measure, lags within each; NaN where missing. `tests` like this
// one share the false-alarm rate.
Portmanteau TestWhiteness(std::span<const std::vector<double>> series, int tests = 1);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_WHITENESS_H_
