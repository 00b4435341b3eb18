#include "calibration/noise/readings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace plenum::calibration {
namespace {

constexpr double kGridTolerance = 0.1;   // of the quantum
constexpr double kSameValue = 1e-9;      // of the range: rounding of unit conversions
constexpr double kSameEnd = 1e-6;        // of the sensor's range
constexpr std::size_t kDistinctMin = 8;  // values on a grid by chance: 0.2^6
constexpr std::size_t kClipLengthMin = 4;
constexpr double kClipChance = 1e-3;
constexpr double kCrowdChance = 1e-6;
constexpr int kQuietPairsMin = 30;
constexpr double kStillShareMax = 0.5;      // more: a staircase that stands by itself
constexpr double kReversalShareMin = 0.02;  // less: a smooth signal that may well stand still
constexpr std::size_t kNeighbours = 5;
constexpr std::size_t kStoppedMin = 8;     // readings at which a moving signal stands still
constexpr double kStoppedShareMax = 0.05;  // of repeated readings elsewhere
constexpr double kStoppedSteps = 10.0;     // of the last decimal place, into them
constexpr double kOutlierSigmas = 6.0;

std::vector<double> Finite(std::span<const double> y) {
  std::vector<double> values;
  for (const double value : y)
    if (std::isfinite(value)) values.push_back(value);
  return values;
}

// Gaps between neighbouring distinct values.
std::vector<double> Gaps(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double same = kSameValue * (values.back() - values.front());
  std::vector<double> gaps;
  double last = values.front();
  for (const double value : values) {
    if (value - last <= same) continue;
    gaps.push_back(value - last);
    last = value;
  }
  return gaps;
}

// Share of the inner values that are higher or lower than both neighbours: 2/3 of white noise.
double ReversalShare(const std::vector<double>& values) {
  int reversals = 0;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    reversals += (values[i] - values[i - 1]) * (values[i + 1] - values[i]) < 0.0;
  return reversals / static_cast<double>(values.size());
}

// Share p of the readings strictly between the two ends that repeat the one before: over all, or
// over those of the quiet spans where it is higher, because a signal that moves does not repeat.
double RepeatShare(const Readings& readings, double low, double high) {
  struct Pairs {
    int all = 0, repeated = 0;
    double Share() const { return (repeated + 1.0) / (all + 2.0); }
  } anywhere, quiet;
  auto span = readings.quiet.begin();
  std::size_t last = readings.y.size();  // the finite reading before; none yet
  for (std::size_t i = 0; i < readings.y.size(); ++i) {
    const double y = readings.y[i];
    if (!std::isfinite(y)) continue;
    const std::size_t before = std::exchange(last, i);
    if (before == readings.y.size() || y <= low || y >= high) continue;
    const double previous = readings.y[before];
    if (previous <= low || previous >= high) continue;
    const bool repeated = std::abs(y - previous) <= kSameValue * (high - low);
    ++anywhere.all, anywhere.repeated += repeated;
    while (span != readings.quiet.end() && span->end_s < readings.t_s[i]) ++span;
    if (span == readings.quiet.end() || span->start_s > readings.t_s[before]) continue;
    ++quiet.all, quiet.repeated += repeated;
  }
  if (quiet.all < kQuietPairsMin) return anywhere.Share();
  return std::max(anywhere.Share(), quiet.Share());
}

// Whether readings at an end are followed by another there more often than a share p allows:
// Chernoff's bound on the binomial tail.
bool Crowded(const std::vector<std::vector<std::size_t>>& stretches, double p) {
  double readings = 0.0, repeated = 0.0;
  for (const std::vector<std::size_t>& stretch : stretches) {
    if (stretch.empty()) continue;
    readings += static_cast<double>(stretch.size());
    repeated += static_cast<double>(stretch.size() - 1);
  }
  const double seen = repeated / readings;
  if (!(seen > p) || repeated == 0.0) return false;
  const double left =
      repeated == readings ? 0.0 : (1.0 - seen) * std::log((1.0 - seen) / (1.0 - p));
  return readings * (seen * std::log(seen / p) + left) > -std::log(kCrowdChance);
}

// Whether the value, the highest or lowest, is read several times and lies between the lines of the
// grid that all the others lie on.
bool IsOffGrid(const std::vector<double>& values, double end, double same) {
  std::vector<double> others;
  for (const double value : values)
    if (std::abs(value - end) > same) others.push_back(value);
  const double quantum = Quantum(others);
  if (quantum == 0.0 || values.size() - others.size() < kClipLengthMin) return false;
  const double nearest = *std::min_element(others.begin(), others.end(), [&](double a, double b) {
    return std::abs(a - end) < std::abs(b - end);
  });
  const double steps = std::abs(nearest - end) / quantum;
  return std::abs(steps - std::round(steps)) > kGridTolerance;
}

// The last decimal place that any of the values needs, at most to a thousand millionth of the
// largest.
double LastPlace(const std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  double place = std::pow(10.0, std::floor(std::log10(largest)));
  const auto fits = [&](double value) {
    return std::abs(value / place - std::round(value / place)) < 1e-3;
  };
  for (int k = 0; k < 9 && !std::all_of(values.begin(), values.end(), fits); ++k) place /= 10.0;
  return place;
}

// Whether the signal moves up to the stretch and then stands still, while no valve acts.
bool RunsInto(const Readings& readings, const std::vector<std::size_t>& stretch, double step) {
  if (stretch.size() < kStoppedMin || stretch.front() < 2) return false;
  const std::size_t first = stretch.front();
  const std::span<const double> t_s = readings.t_s, y = readings.y;
  const auto holds = [&](const TimeSpan& span) {
    return span.start_s <= t_s[first - 2] && t_s[first + 1] < span.end_s;
  };
  const bool undisturbed = std::any_of(readings.quiet.begin(), readings.quiet.end(), holds) ||
                           std::any_of(readings.strokes.begin(), readings.strokes.end(), holds);
  return undisturbed && std::isfinite(y[first - 2]) && std::abs(y[first] - y[first - 1]) > step &&
         (y[first] - y[first - 1]) * (y[first - 1] - y[first - 2]) > 0.0;
}

}  // namespace

double Quantum(std::span<const double> y) {
  const std::vector<double> values = Finite(y);
  if (values.size() < kDistinctMin) return 0.0;
  const std::vector<double> gaps = Gaps(values);
  const bool recurring = gaps.size() >= 2 && 2 * (gaps.size() + 1) <= values.size();
  if (gaps.size() + 1 < kDistinctMin && !recurring) return 0.0;
  // The steps counted along the gaps, from small to large, sharpen the step as they go.
  std::vector<double> sorted = gaps;
  std::sort(sorted.begin(), sorted.end());
  double total = 0.0, count = 0.0;
  for (const double gap : sorted) {
    const double quantum = count > 0.0 ? total / count : sorted.front();
    const double steps = std::round(gap / quantum);
    if (std::abs(gap - steps * quantum) > kGridTolerance * quantum) return 0.0;
    total += gap;
    count += steps;
  }
  return total / count;
}

std::vector<std::size_t> Clipped(const Readings& readings) {
  const std::span<const double> y = readings.y;
  const std::vector<double> values = Finite(y);
  if (values.size() < 2 * kClipLengthMin) return {};
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  const double same = kSameValue * (*highest - *lowest);
  const double share = RepeatShare(readings, *lowest + same, *highest - same);
  const bool tells = ReversalShare(values) >= kReversalShareMin && share <= kStillShareMax;
  std::vector<std::size_t> clipped;
  for (const double end : {*lowest, *highest}) {
    const bool off_grid = IsOffGrid(values, end, same);
    const bool smooth = !tells && share <= kStoppedShareMax;
    if (!tells && !off_grid && !smooth) continue;
    std::vector<std::vector<std::size_t>> stretches(1);
    for (std::size_t i = 0; i < y.size(); ++i) {
      if (!std::isfinite(y[i])) continue;
      if (std::abs(y[i] - end) <= same)
        stretches.back().push_back(i);
      else if (!stretches.back().empty())
        stretches.emplace_back();
    }
    const bool all = off_grid || (tells && Crowded(stretches, share));
    const double step = kStoppedSteps * std::max(LastPlace(values), Quantum(values));
    for (const std::vector<std::size_t>& stretch : stretches) {
      if (!all && smooth) {
        if (RunsInto(readings, stretch, step))
          clipped.insert(clipped.end(), stretch.begin(), stretch.end());
        continue;
      }
      const double length = static_cast<double>(stretch.size());
      const double chance = static_cast<double>(values.size()) * std::pow(share, length - 1.0);
      if (all || (stretch.size() >= kClipLengthMin && chance < kClipChance))
        clipped.insert(clipped.end(), stretch.begin(), stretch.end());
    }
  }
  std::sort(clipped.begin(), clipped.end());
  return clipped;
}

double Extrapolate(std::span<const double> t_s, std::span<const double> y, double at,
                   double* gain2) {
  double value = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < t_s.size(); ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < t_s.size(); ++j)
      if (j != i) weight *= (at - t_s[j]) / (t_s[i] - t_s[j]);
    value += weight * y[i];
    squares += weight * weight;
  }
  if (gain2) *gain2 = squares;
  return value;
}

StatedEnds EndsOf(std::span<const double> y, const Sensor& sensor) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double same =
      std::max(0.5 * sensor.resolution_pa, kSameEnd * (sensor.high_pa - sensor.low_pa));
  StatedEnds ends{sensor.low_pa, sensor.high_pa, {}};
  for (const double value : y) {
    if (value < sensor.low_pa - same) ends.low = -kInfinity;
    if (value > sensor.high_pa + same) ends.high = kInfinity;
  }
  for (std::size_t i = 0; i < y.size(); ++i)
    if (y[i] <= ends.low + same || y[i] >= ends.high - same) ends.clipped.push_back(i);
  return ends;
}

std::vector<std::size_t> NearEnds(std::span<const double> y, double low, double high,
                                  double margin) {
  std::vector<std::size_t> near;
  if (std::isinf(low) && std::isinf(high)) return near;
  for (std::size_t i = 0; i < y.size(); ++i) {
    const std::size_t first = i < kNeighbours ? 0 : i - kNeighbours;
    const std::size_t last = std::min(y.size(), i + kNeighbours + 1);
    std::vector<double> around = Finite(y.subspan(first, last - first));
    if (around.empty()) continue;
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    const bool at_end = y[i] <= low || y[i] >= high;
    if (at_end || *middle < low + margin || *middle > high - margin) near.push_back(i);
  }
  return near;
}

std::vector<std::size_t> Outliers(std::span<const double> t_s, std::span<const double> y,
                                  double sigma) {
  std::vector<std::size_t> wild;
  std::vector<double> size(t_s.size(), 0.0);
  for (std::size_t i = 3; i + 3 < t_s.size(); ++i) {
    const std::array around_t = {t_s[i - 2], t_s[i - 1], t_s[i + 1], t_s[i + 2]};
    const std::array around_y = {y[i - 2], y[i - 1], y[i + 1], y[i + 2]};
    double gain2 = 0.0;
    const double off = y[i] - Extrapolate(around_t, around_y, t_s[i], &gain2);
    if (!(std::abs(off) > kOutlierSigmas * sigma * std::sqrt(1.0 + gain2))) continue;
    const double before = y[i] - Extrapolate(t_s.subspan(i - 3, 3), y.subspan(i - 3, 3), t_s[i]);
    const double after = y[i] - Extrapolate(t_s.subspan(i + 1, 3), y.subspan(i + 1, 3), t_s[i]);
    const double sign = off > 0.0 ? 1.0 : -1.0;
    if (sign * before > 0.5 * std::abs(off) && sign * after > 0.5 * std::abs(off))
      size[i] = std::abs(off);
  }
  for (std::size_t i = 3; i + 3 < t_s.size(); ++i) {  // a wild value throws its neighbours off
    const auto around = std::span(size).subspan(i - 3, 7);
    if (size[i] > 0.0 && size[i] == *std::max_element(around.begin(), around.end()))
      wild.push_back(i);
  }
  return wild;
}

}  // namespace plenum::calibration
