#include "calibration/noise/rounding.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

namespace plenum::calibration {
namespace {

constexpr double kVarianceMin = 0.02;                       // of the squared quantum
constexpr double kNoiseLowest = 1e-3, kNoiseHighest = 1e3;  // quanta
constexpr double kChanceMin = 1e-300;
constexpr double kNegligible = 1e-15;  // of a quantum

double Normal(double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

// Chance that the noise lies within the interval; the tail of smaller area is taken, so that far
// intervals keep their digits.
double Chance(double low, double high, double noise) {
  if (low > 0.0) return Normal(-low / noise) - Normal(-high / noise);
  return Normal(high / noise) - Normal(low / noise);
}

double LogLikelihood(std::span<const double> readings, std::span<const double> model,
                     double quantum, double noise) {
  double sum = 0.0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double off = readings[i] - model[i];
    if (!std::isfinite(off)) continue;
    sum += std::log(std::max(Chance(off - 0.5 * quantum, off + 0.5 * quantum, noise), kChanceMin));
  }
  return sum;
}

}  // namespace

Grid::Grid(double quantum, double noise) : quantum_(quantum), noise_(noise) {
  const double width = std::numbers::pi * std::max(noise / quantum, kLeastGridNoise);
  for (int k = 1; k <= kHarmonics; ++k) {
    const double size = std::exp(-2.0 * std::pow(k * width, 2));
    if (size < kNegligible) break;
    size_[static_cast<std::size_t>(k - 1)] = k % 2 == 0 ? size : -size;
    harmonics_ = k;
  }
}

Grid::Shift Grid::At(double off) const {
  if (harmonics_ == 0) return {};
  const double phase = -2.0 * std::numbers::pi * off / quantum_;  // of the model from the reading
  const std::complex<double> turn(std::cos(phase), std::sin(phase));
  std::complex<double> turned = 1.0;
  Shift result;
  for (int k = 1; k <= harmonics_; ++k) {
    turned *= turn;
    const double size = size_[static_cast<std::size_t>(k - 1)];
    result.mean += quantum_ / (std::numbers::pi * k) * size * turned.imag();
    result.slope += 2.0 * size * turned.real();
  }
  return result;
}

// Golden section over ln s.
double LikeliestNoise(std::span<const double> readings, std::span<const double> model,
                      double quantum) {
  const double ratio = (std::sqrt(5.0) - 1.0) / 2.0;
  double low = std::log(kNoiseLowest * quantum), high = std::log(kNoiseHighest * quantum);
  const auto at = [&](double x) { return LogLikelihood(readings, model, quantum, std::exp(x)); };
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double at_a = at(a), at_b = at(b);
  while (high - low > 1e-3) {
    if (at_a >= at_b) {
      high = b;
      b = std::exchange(a, high - ratio * (high - low));
      at_b = std::exchange(at_a, at(a));
    } else {
      low = a;
      a = std::exchange(b, low + ratio * (high - low));
      at_a = std::exchange(at_b, at(b));
    }
  }
  return std::exp(0.5 * (low + high));
}

RoundedResidual StandardiseRounded(std::span<const double> readings, std::span<const double> model,
                                   double quantum) {
  RoundedResidual result;
  result.noise = LikeliestNoise(readings, model, quantum);
  const double reach = 6.0 * result.noise + quantum;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double off = readings[i] - model[i];
    double e = std::numeric_limits<double>::quiet_NaN();
    if (std::isfinite(off)) {
      double mean = 0.0, square = 0.0;  // of reading − model over the grid values within reach
      for (double k = std::ceil((-reach - off) / quantum); off + k * quantum <= reach; k += 1.0) {
        const double value = off + k * quantum;
        const double chance = Chance(value - 0.5 * quantum, value + 0.5 * quantum, result.noise);
        mean += chance * value;
        square += chance * value * value;
      }
      const double variance = square - mean * mean;
      if (variance >= kVarianceMin * quantum * quantum) e = (off - mean) / std::sqrt(variance);
    }
    result.e.push_back(e);
  }
  return result;
}

}  // namespace plenum::calibration
