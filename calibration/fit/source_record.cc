#include "calibration/fit/source_record.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace plenum::calibration {
namespace {

// Largest sum of n samples of white noise about a fitted line, in √n standard deviations: more is
// not noise (a Brownian bridge stays within 1.36 in 95 % of cases).
constexpr double kNoiseSumMax = 1.5;

struct Sample {
  double t_s, value, weight;
};

std::vector<Sample> Present(std::span<const double> t_s, std::span<const double> value) {
  std::vector<Sample> samples;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    if (std::isnan(value[i])) continue;
    if (!samples.empty() && samples.back().t_s == t_s[i]) {
      Sample& same = samples.back();
      same.weight += 1.0;
      same.value += (value[i] - same.value) / same.weight;
    } else {
      samples.push_back({t_s[i], value[i], 1.0});
    }
  }
  return samples;
}

// Normal equations of the hat functions on the knots, which are tridiagonal, by elimination. Every
// knot is the instant of a sample, so no pivot is zero.
std::vector<double> NearestValues(const std::vector<Sample>& samples,
                                  const std::vector<double>& knots) {
  const std::size_t n = knots.size();
  std::vector<double> diagonal(n, 0.0), above(n, 0.0), right(n, 0.0);
  std::size_t piece = 0;
  for (const Sample& sample : samples) {
    while (piece + 2 < n && sample.t_s > knots[piece + 1]) ++piece;
    if (n == 1) {
      diagonal[0] += sample.weight, right[0] += sample.weight * sample.value;
      continue;
    }
    const double share = (sample.t_s - knots[piece]) / (knots[piece + 1] - knots[piece]);
    diagonal[piece] += sample.weight * (1.0 - share) * (1.0 - share);
    diagonal[piece + 1] += sample.weight * share * share;
    above[piece] += sample.weight * share * (1.0 - share);
    right[piece] += sample.weight * (1.0 - share) * sample.value;
    right[piece + 1] += sample.weight * share * sample.value;
  }
  for (std::size_t i = 1; i < n; ++i) {
    const double factor = above[i - 1] / diagonal[i - 1];
    diagonal[i] -= factor * above[i - 1];
    right[i] -= factor * right[i - 1];
  }
  for (std::size_t i = n; i-- > 0;) {
    if (i + 1 < n) right[i] -= above[i] * right[i + 1];
    right[i] /= diagonal[i];
  }
  return right;
}

// Where the straight pieces leave more than noise: in each such piece the sample at which the sum
// of the residuals up to it is largest.
std::vector<double> Refinements(const std::vector<Sample>& samples,
                                const std::vector<double>& knots, const std::vector<double>& values,
                                double noise) {
  std::vector<double> refinements;
  auto sample = samples.begin();
  for (std::size_t piece = 0; piece + 1 < knots.size(); ++piece) {
    const double width_s = knots[piece + 1] - knots[piece];
    double sum = 0.0, largest = 0.0, weight = 0.0;
    double at_s = 0.0;
    for (; sample != samples.end() && sample->t_s <= knots[piece + 1]; ++sample) {
      const double share = (sample->t_s - knots[piece]) / width_s;
      const double line = (1.0 - share) * values[piece] + share * values[piece + 1];
      sum += sample->weight * (sample->value - line);
      weight += sample->weight;
      const bool inside = sample->t_s > knots[piece] && sample->t_s < knots[piece + 1];
      if (inside && std::abs(sum) > largest) largest = std::abs(sum), at_s = sample->t_s;
    }
    if (largest > kNoiseSumMax * noise * std::sqrt(weight)) refinements.push_back(at_s);
  }
  return refinements;
}

}  // namespace

model::TimeCourse CondenseRecord(std::span<const double> t_s, std::span<const double> value,
                                 double noise) {
  const std::vector<Sample> samples = Present(t_s, value);
  if (samples.empty()) return {};
  std::vector<double> knots = {samples.front().t_s};
  if (samples.size() > 1) knots.push_back(samples.back().t_s);
  while (true) {
    std::vector<double> values = NearestValues(samples, knots);
    const std::vector<double> more = Refinements(samples, knots, values, noise);
    if (more.empty()) return {.time_s = std::move(knots), .value = std::move(values)};
    const auto middle = knots.insert(knots.end(), more.begin(), more.end());
    std::inplace_merge(knots.begin(), middle, knots.end());
  }
}

}  // namespace plenum::calibration
