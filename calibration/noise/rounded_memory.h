// Noise that remembers (noise_memory.h) behind a grid that is coarser than it (rounding.h).
//
// What a rounded reading shows of the noise depends on where the model lies between two grid
// values, so that no one memory describes the standardised readings. Instead the remembered part of
// the noise is filtered: before a reading it is normal with mean û⁻ and variance P⁻ as in
// noise_memory.h; the reading y says that noise and model m lie within q/2 of it, and the mean μ
// and variance v of the normal distribution that is cut off there take the place of an exact
// reading,
//   û = û⁻ + P⁻/S·μ,  P = P⁻ − (P⁻)²/S·(1 − v/S),
// with μ of the innovation and all in units of the noise. Given the readings before, the next one
// has a known mean and variance, and
//   e = (y − E[y])/√Var[y]
// has mean 0, variance 1 and no memory if model and noise are right. Readings that are all but sure
// become NaN as in rounding.h. Source: assumed density filtering (Maybeck, Stochastic Models,
// Estimation, and Control 2 (1982), chapter 12).
#ifndef PLENUM_CALIBRATION_NOISE_ROUNDED_MEMORY_H_
#define PLENUM_CALIBRATION_NOISE_ROUNDED_MEMORY_H_

#include <functional>
#include <span>
#include <vector>

#include "calibration/noise/noise_memory.h"

namespace plenum::calibration {

// Readings of one run on a grid, at rising times, and what the model has; NaN where missing.
struct RoundedSeries {
  std::span<const double> t_s;
  std::span<const double> readings;
  std::span<const double> model;
  double quantum = 0.0;
  double noise = 0.0;  // standard deviation behind the grid
};

// e of every reading.
std::vector<double> InnovationsOf(const RoundedSeries& series, const NoiseMemory& memory);

// The likeliest memory of series of one sensor, θ up to kRoundedReach spacings: what remembers for
// longer is not told from structure. Any where `cancelled` says that nobody wants to know.
inline constexpr double kRoundedReach = 8.0;
NoiseMemory LikeliestRoundedMemory(std::span<const RoundedSeries> series, double spacing_s,
                                   const std::function<bool()>& cancelled = {});

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_ROUNDED_MEMORY_H_
