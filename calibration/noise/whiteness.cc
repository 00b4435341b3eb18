#include "calibration/noise/whiteness.h"

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <limits>

namespace plenum::calibration {
namespace {

constexpr int kLags = 20;
constexpr int kValuesPerLag = 4;
constexpr int kValuesMin = 100;  // left after taking means
constexpr int kWidthFactor = 4;
// The tail of Q of n values reaches further than that of χ² by about 1 + 1.6·lags/n at 1e-3 (found
// by simulation: 1.30 at n = 100, 1.16 at 200, 1.08 at 400).
constexpr double kSkew = 1.6;

int CountFinite(std::span<const std::vector<double>> series) {
  int count = 0;
  for (const std::vector<double>& e : series)
    count += static_cast<int>(
        std::count_if(e.begin(), e.end(), [](double value) { return std::isfinite(value); }));
  return count;
}

double LjungBox(std::span<const std::vector<double>> series, int lags) {
  double squares = 0.0, count = 0.0;
  for (const std::vector<double>& e : series) {
    for (const double value : e) {
      if (!std::isfinite(value)) continue;
      squares += value * value;
      count += 1.0;
    }
  }
  if (!(squares > 0.0)) return 0.0;
  double statistic = 0.0;
  for (int lag = 1; lag <= lags; ++lag) {
    double products = 0.0, pairs = 0.0;
    for (const std::vector<double>& e : series) {
      for (std::size_t i = static_cast<std::size_t>(lag); i < e.size(); ++i) {
        const double product = e[i] * e[i - static_cast<std::size_t>(lag)];
        if (!std::isfinite(product)) continue;
        products += product;
        pairs += 1.0;
      }
    }
    if (pairs == 0.0) continue;
    const double correlation = products / pairs / (squares / count);
    statistic += pairs * correlation * correlation * (count + 2.0) / count;
  }
  return statistic;
}

// Sums over `width` neighbours, divided by √(values summed): white noise keeps its variance.
std::vector<double> Means(const std::vector<double>& e, std::size_t width) {
  std::vector<double> means;
  for (std::size_t i = 0; i + width <= e.size(); i += width) {
    double sum = 0.0, count = 0.0;
    for (std::size_t j = i; j < i + width; ++j) {
      if (!std::isfinite(e[j])) continue;
      sum += e[j];
      count += 1.0;
    }
    means.push_back(count > 0.0 ? sum / std::sqrt(count)
                                : std::numeric_limits<double>::quiet_NaN());
  }
  return means;
}

}  // namespace

Portmanteau TestWhiteness(std::span<const std::vector<double>> series, int tests) {
  const int count = CountFinite(series);
  const int lags = std::min(kLags, count / kValuesPerLag);
  Portmanteau result;
  if (lags < 1) {
    result.limit = std::numeric_limits<double>::infinity();
    return result;
  }
  int widths = 1;
  for (int left = count / kWidthFactor; left >= kValuesMin; left /= kWidthFactor) ++widths;
  const double chance = kFalseAlarm / (widths * tests);
  const double quantile =
      boost::math::quantile(boost::math::complement(boost::math::chi_squared(lags), chance));
  for (int i = 0, width = 1; i < widths; ++i, width *= kWidthFactor) {
    std::vector<std::vector<double>> means;
    for (const std::vector<double>& e : series)
      means.push_back(Means(e, static_cast<std::size_t>(width)));
    const double statistic = LjungBox(means, lags);
    const double limit = quantile * (1.0 + kSkew * lags * width / count);
    if (i > 0 && statistic * result.limit <= result.statistic * limit) continue;
    result = {statistic, limit, width};
  }
  return result;
}

}  // namespace plenum::calibration
