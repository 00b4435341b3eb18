// Random processes of known law for the tests of the statistics, and bands for how often a test may
// raise an alarm.
#ifndef PLENUM_TESTS_CALIBRATION_NOISE_PROCESSES_H_
#define PLENUM_TESTS_CALIBRATION_NOISE_PROCESSES_H_

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace plenum::test {

inline std::vector<double> WhiteNoise(std::uint64_t seed, std::size_t count, double sigma = 1.0) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  std::vector<double> values(count);
  for (double& value : values) value = sigma * normal(generator);
  return values;
}

// Stationary, of standard deviation sigma: x_i = ρ_i·x_{i−1} + √(1 − ρ_i²)·e_i, ρ_i = exp(−Δt/θ).
inline std::vector<double> CorrelatedNoise(std::uint64_t seed, const std::vector<double>& t_s,
                                           double theta_s, double sigma = 1.0) {
  std::vector<double> values = WhiteNoise(seed, t_s.size(), sigma);
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double rho = std::exp((t_s[i - 1] - t_s[i]) / theta_s);
    values[i] = rho * values[i - 1] + std::sqrt(1.0 - rho * rho) * values[i];
  }
  return values;
}

inline std::vector<double> EvenTimes(std::size_t count, double spacing_s) {
  std::vector<double> t_s(count);
  for (std::size_t i = 0; i < count; ++i) t_s[i] = static_cast<double>(i) * spacing_s;
  return t_s;
}

// Gaps drawn from an exponential distribution.
inline std::vector<double> RandomTimes(std::uint64_t seed, std::size_t count, double spacing_s) {
  std::mt19937_64 generator(seed);
  std::exponential_distribution<double> gap(1.0 / spacing_s);
  std::vector<double> t_s(count);
  for (std::size_t i = 1; i < count; ++i) t_s[i] = t_s[i - 1] + gap(generator);
  return t_s;
}

inline double RoundTo(double value, double quantum) {
  return quantum * std::round(value / quantum);
}

// Whether `hits` of `draws` agree with a chance of `rate`: within four standard deviations of the
// binomial distribution (and one count, for its steps).
inline bool AgreesWithRate(int hits, int draws, double rate) {
  const double expected = draws * rate;
  return std::abs(hits - expected) <= 4.0 * std::sqrt(expected * (1.0 - rate)) + 1.0;
}

// Whether `hits` of `draws` agree with a chance of at most `rate`: the upper end of that band.
inline bool AtMostRate(int hits, int draws, double rate) {
  return hits <= draws * rate + 4.0 * std::sqrt(draws * rate * (1.0 - rate)) + 1.0;
}

}  // namespace plenum::test

#endif  // PLENUM_TESTS_CALIBRATION_NOISE_PROCESSES_H_
