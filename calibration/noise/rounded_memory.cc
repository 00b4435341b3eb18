#include "calibration/noise/rounded_memory.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace plenum::calibration {
namespace {

constexpr double kVarianceMin = 0.02;  // of the squared quantum
constexpr double kChanceMin = 1e-12;
constexpr double kLeastTheta = 0.5;  // spacings
constexpr int kPasses = 3;           // over grids of kBrackets² memories
constexpr int kBrackets = 7;

double Density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

// Chance that a standard normal lies between, from the tail of smaller area.
double Chance(double low, double high) {
  const auto below = [](double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); };
  return low > 0.0 ? below(-low) - below(-high) : below(high) - below(low);
}

// Of a standard normal between two ends.
struct Cut {
  double chance = 0.0, mean = 0.0, variance = 1.0;
};
Cut CutAt(double low, double high) {
  Cut cut{Chance(low, high)};
  if (cut.chance < kChanceMin) {  // far outside: all but at the nearer end
    cut.mean = low > 0.0 ? low : high;
    cut.variance = 0.0;
    cut.chance = kChanceMin;
    return cut;
  }
  cut.mean = (Density(low) - Density(high)) / cut.chance;
  cut.variance = std::max(
      0.0, 1.0 + (low * Density(low) - high * Density(high)) / cut.chance - cut.mean * cut.mean);
  return cut;
}

// (y − E[y])/√Var[y] of a reading that is `off` above the mean of what is rounded, whose deviation
// is `sigma`; NaN where Var[y] is next to nothing.
double Standardised(double off, double quantum, double sigma) {
  const double reach = 6.0 * sigma + quantum;
  double mean = 0.0, square = 0.0;
  for (double k = std::ceil((-reach - off) / quantum); off + k * quantum <= reach; k += 1.0) {
    const double value = off + k * quantum;
    const double chance = Chance((value - 0.5 * quantum) / sigma, (value + 0.5 * quantum) / sigma);
    mean += chance * value;
    square += chance * value * value;
  }
  const double variance = square - mean * mean;
  if (variance < kVarianceMin * quantum * quantum) return std::numeric_limits<double>::quiet_NaN();
  return (off - mean) / std::sqrt(variance);
}

// The filter along a series; `each` gets, of every reading, its index, how far it is above what is
// expected of it, and the deviation of what is rounded.
template <class Each>
double Filter(const RoundedSeries& series, const NoiseMemory& memory, const Each& each) {
  const auto& [theta_s, share] = memory;
  double sum = 0.0, mean = 0.0, variance = share;
  double last_s = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < series.readings.size(); ++i) {
    const double off = series.readings[i] - series.model[i];
    if (!std::isfinite(off)) continue;
    const double rho = theta_s > 0.0 ? std::exp((last_s - series.t_s[i]) / theta_s) : 0.0;
    last_s = series.t_s[i];
    mean *= rho;
    variance = rho * rho * variance + share * (1.0 - rho * rho);
    const double total = variance + 1.0 - share, deviation = std::sqrt(total);
    const double sigma = series.noise * deviation;
    const double above = off - series.noise * mean;
    each(i, above, sigma);
    const Cut cut =
        CutAt((above - 0.5 * series.quantum) / sigma, (above + 0.5 * series.quantum) / sigma);
    sum += std::log(cut.chance);
    mean += variance / deviation * cut.mean;
    variance -= variance * variance / total * (1.0 - cut.variance);
  }
  return sum;
}

double LogLikelihood(std::span<const RoundedSeries> series, const NoiseMemory& memory) {
  double sum = 0.0;
  for (const RoundedSeries& one : series)
    sum += Filter(one, memory, [](std::size_t, double, double) {});
  return sum;
}

}  // namespace

std::vector<double> InnovationsOf(const RoundedSeries& series, const NoiseMemory& memory) {
  std::vector<double> e(series.readings.size(), std::numeric_limits<double>::quiet_NaN());
  Filter(series, memory, [&](std::size_t i, double above, double sigma) {
    e[i] = Standardised(above, series.quantum, sigma);
  });
  return e;
}

NoiseMemory LikeliestRoundedMemory(std::span<const RoundedSeries> series, double spacing_s,
                                   const std::function<bool()>& cancelled) {
  // Over ln θ and the share, on a grid that shrinks about the best.
  double theta_low = std::log(kLeastTheta * spacing_s),
         theta_high = std::log(kRoundedReach * spacing_s);
  double share_low = 0.0, share_high = 1.0;
  NoiseMemory best;
  double most = -std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < kPasses; ++pass) {
    for (int i = 0; i < kBrackets; ++i) {
      for (int k = 0; k < kBrackets; ++k) {
        if (cancelled && cancelled()) return best;
        const NoiseMemory memory{
            std::exp(theta_low + (theta_high - theta_low) * i / (kBrackets - 1)),
            share_low + (share_high - share_low) * k / (kBrackets - 1)};
        const double likelihood = LogLikelihood(series, memory);
        if (likelihood > most) most = likelihood, best = memory;
      }
    }
    const double theta_step = (theta_high - theta_low) / (kBrackets - 1);
    const double share_step = (share_high - share_low) / (kBrackets - 1);
    theta_low = std::log(best.theta_s) - theta_step;
    theta_high = std::min(std::log(kRoundedReach * spacing_s), std::log(best.theta_s) + theta_step);
    share_low = std::max(0.0, best.share - share_step);
    share_high = std::min(1.0, best.share + share_step);
  }
  return best;
}

}  // namespace plenum::calibration
