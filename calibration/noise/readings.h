// What a sensor does to its readings besides noise: the grid that it rounds to, the ends of its
// range, single wild values.
#ifndef PLENUM_CALIBRATION_NOISE_READINGS_H_
#define PLENUM_CALIBRATION_NOISE_READINGS_H_

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/values/dataset.h"

namespace plenum::calibration {

// Readings y at times t (rising, NaN where missing); `quiet` are the spans to look at first and
// `strokes` the others.
struct TimeSpan {
  double start_s = 0.0, end_s = 0.0;
};
struct Readings {
  std::span<const double> t_s, y;
  std::vector<TimeSpan> quiet, strokes;
  Sensor sensor = {};
};

// Step q of the grid that the finite values lie on, each within q/10; 0 if they lie on none. Asked
// of at least eight distinct values, or of fewer where most readings recur.
double Quantum(std::span<const double> y);

// Indices of readings at an end of the sensor's range: of the run's highest or lowest value,
// (a) in unbroken stretches so long that the readings elsewhere, which repeat the one before with a
// share p, would hold still that long with a chance n·p^(length−1) below 1e-3, or
// (b) all of them, where they repeat more often than with a share p, at a chance below 1e-6: at the
// floor of a converter half the noise or more is cut off, while an extreme that nothing cuts off is
// the tail of the noise and hardly ever repeats.
// None where that cannot be told: p above one half (a coarse grid) or no visible noise. But
// (d) without visible noise a stretch of eight or more that a moving signal runs into: the step
// into it is more than ten of the last decimal place, which a signal that settles by itself passes
// in ever smaller steps, and no valve acts there. Or (c) whatever the noise, where four or more are
// at that value and it lies between the lines of the grid that all others lie on, by more than a
// tenth of its step.
std::vector<std::size_t> Clipped(const Readings& readings);

// Of a sensor whose range is stated: the ends beyond which none of the readings lies by more than
// half of its resolution, −∞ and ∞ of the others, and which of the readings lie at those ends.
struct StatedEnds {
  double low, high;
  std::vector<std::size_t> clipped;
};
StatedEnds EndsOf(std::span<const double> y, const Sensor& sensor);

// Indices of readings whose median with five neighbours on either side comes within `margin` of an
// end of the range, low or high (infinite where there is none).
std::vector<std::size_t> NearEnds(std::span<const double> y, double low, double high,
                                  double margin);

// Indices i of single readings that are off by more than 6 standard deviations from the cubic
// through two neighbours on either side, and off by at least half as much, the same way, from the
// parabolas through the three before and the three after: a kink or a step of the signal agrees
// with one of the two sides, a wild value with neither. Of candidates within three samples of each
// other the largest is the one. `t_s` rises strictly, all values are finite, `sigma` is that of one
// reading. The first and last three samples are not judged.
std::vector<std::size_t> Outliers(std::span<const double> t_s, std::span<const double> y,
                                  double sigma);

// Value at `at` of the polynomial through the points (Lagrange), and in `gain2` the sum of the
// squared weights, by which white noise of the points grows.
double Extrapolate(std::span<const double> t_s, std::span<const double> y, double at,
                   double* gain2 = nullptr);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_READINGS_H_
