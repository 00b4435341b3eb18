#include "calibration/noise/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "calibration/noise/phases.h"
#include "calibration/noise/quiet_memory.h"
#include "calibration/noise/readings.h"

namespace plenum::calibration {
namespace {

constexpr double kMadToSigma = 1.4826;  // of a normal distribution
constexpr double kTrimSigmas = 5.0;     // windows beyond are of the signal, not of the noise
constexpr double kSameInstant = 1e-3;   // of the mean spacing
constexpr double kGapMax = 10.0;        // of the median spacing
constexpr double kNoiseless = 1e-4;     // of the range: wild values smaller than that pass
constexpr double kSigmaError = 1.07;    // standard error of σ over σ is this over √windows
// A signal that settles reads (q/2)² off at worst, three times the mean over levels, q²/12.
constexpr double kRoundingError = 0.4;
constexpr double kClipSigmas = 4.0;
constexpr double kSameEnd = 1e-6;  // of the range of the readings
constexpr int kRepeatsMin = 8;     // degrees of freedom
constexpr int kWindowsMin = 30;    // else look further than the quiet spans
constexpr double kUnsettled = 1.0 / 3.0;

struct Samples {
  std::vector<double> t_s, y;
  std::vector<std::size_t> index;  // in the run
};

double Median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

double MedianSpacing(const std::vector<double>& t_s) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < t_s.size(); ++i) gaps.push_back(t_s[i] - t_s[i - 1]);
  return Median(gaps);
}

// The divided difference z of four samples.
double ThirdDifferenceAt(const Samples& samples, std::size_t first) {
  const double* t_s = &samples.t_s[first];
  std::array<double, 4> weight;
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    double product = 1.0;
    for (std::size_t j = 0; j < 4; ++j)
      if (j != i) product *= (t_s[i] - t_s[j]) / (t_s[3] - t_s[0]);
    weight[i] = 1.0 / product;
    squares += weight[i] * weight[i];
  }
  double z = 0.0;
  for (std::size_t i = 0; i < 4; ++i) z += weight[i] / std::sqrt(squares) * samples.y[first + i];
  return z;
}

// Of every four samples in a row that lie in one of the spans and cross no gap of the sampling.
std::vector<double> ThirdDifferences(const Samples& samples, std::span<const TimeSpan> spans,
                                     double spacing_s) {
  const std::vector<double>& t_s = samples.t_s;
  std::vector<double> differences;
  for (const TimeSpan& span : spans) {
    const auto begin = std::lower_bound(t_s.begin(), t_s.end(), span.start_s);
    const auto end = std::upper_bound(t_s.begin(), t_s.end(), span.end_s);
    const auto first = static_cast<std::size_t>(begin - t_s.begin());
    const auto last = static_cast<std::size_t>(end - t_s.begin());
    for (std::size_t i = first; i + 3 < last; ++i) {
      double gap = 0.0;
      for (std::size_t j = i + 1; j < i + 4; ++j) gap = std::max(gap, t_s[j] - t_s[j - 1]);
      if (gap <= kGapMax * spacing_s) differences.push_back(ThirdDifferenceAt(samples, i));
    }
  }
  return differences;
}

// Drops what lies beyond kTrimSigmas robust deviations (at least `floor` each).
void Trim(std::vector<double>& values, double floor) {
  if (values.empty()) return;
  std::vector<double> sizes(values.size());
  std::transform(values.begin(), values.end(), sizes.begin(),
                 [](double value) { return std::abs(value); });
  const double limit = kTrimSigmas * std::max(kMadToSigma * Median(sizes), floor);
  if (limit > 0.0) std::erase_if(values, [&](double value) { return std::abs(value) > limit; });
}

double Rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

// What a run gives to the estimate: the samples without the wild ones, where to look, and the RMS
// of the differences there.
struct Record {
  Samples samples;
  std::vector<TimeSpan> places;
  double spacing_s = 0.0, rms = 0.0;
};

// Deviations within the groups of samples that share an instant, scaled to the variance of one
// reading; leaves the first of each group in `samples`.
std::vector<double> TakeRepeats(Samples& samples, int& freedom) {
  const double span_s = samples.t_s.back() - samples.t_s.front();
  const double same_s = kSameInstant * span_s / static_cast<double>(samples.t_s.size());
  std::vector<double> deviations;
  Samples first;
  for (std::size_t i = 0; i < samples.t_s.size();) {
    std::size_t end = i + 1;
    while (end < samples.t_s.size() && samples.t_s[end] - samples.t_s[i] <= same_s) ++end;
    const double count = static_cast<double>(end - i);
    double mean = 0.0;
    for (std::size_t j = i; j < end; ++j) mean += samples.y[j] / count;
    for (std::size_t j = i; j < end && count > 1.0; ++j)
      deviations.push_back((samples.y[j] - mean) * std::sqrt(count / (count - 1.0)));
    freedom += static_cast<int>(end - i) - 1;
    first.t_s.push_back(samples.t_s[i]);
    first.y.push_back(samples.y[i]);
    first.index.push_back(samples.index[i]);
    i = end;
  }
  samples = std::move(first);
  return deviations;
}

std::vector<TimeSpan> Tails(std::span<const TimeSpan> strokes) {
  std::vector<TimeSpan> tails;
  for (const TimeSpan& span : strokes)
    tails.push_back({0.5 * (span.start_s + span.end_s), span.end_s});
  return tails;
}

// The windows to go by: the quiet ones, with the tails of the strokes if those are few, else all.
std::vector<TimeSpan> Places(const Samples& samples, std::span<const TimeSpan> quiet,
                             std::span<const TimeSpan> strokes, double spacing_s,
                             NoiseSource& source) {
  const auto enough = [&](const std::vector<TimeSpan>& spans) {
    return static_cast<int>(ThirdDifferences(samples, spans, spacing_s).size()) >= kWindowsMin;
  };
  std::vector<TimeSpan> spans(quiet.begin(), quiet.end());
  source = NoiseSource::kClosed;
  if (enough(spans)) return spans;
  for (const TimeSpan& tail : Tails(strokes)) spans.push_back(tail);
  source = NoiseSource::kTail;
  if (enough(spans)) return spans;
  source = NoiseSource::kWhole;
  return {{samples.t_s.front(), samples.t_s.back()}};
}

Samples Without(const Samples& samples, const std::vector<std::size_t>& dropped) {
  Samples kept;
  for (std::size_t i = 0; i < samples.index.size(); ++i) {
    if (std::binary_search(dropped.begin(), dropped.end(), i)) continue;
    kept.t_s.push_back(samples.t_s[i]);
    kept.y.push_back(samples.y[i]);
    kept.index.push_back(samples.index[i]);
  }
  return kept;
}

// The readings that count towards the noise: finite, and not so near an end of the sensor's range
// that noise is cut off there.
Samples Usable(const Readings& readings, const std::vector<std::size_t>& dropped) {
  Samples samples;
  for (std::size_t i = 0; i < readings.t_s.size(); ++i) {
    if (!std::isfinite(readings.y[i]) || std::binary_search(dropped.begin(), dropped.end(), i))
      continue;
    samples.t_s.push_back(readings.t_s[i]);
    samples.y.push_back(readings.y[i]);
    samples.index.push_back(i);
  }
  return samples;
}

// Fills in what a run tells by itself: repeats, wild readings, white noise from its windows.
Record RecordOf(const Readings& readings, Noise& noise) {
  Record record;
  Samples samples = Usable(readings, noise.near_end);
  noise.effective_samples = static_cast<double>(samples.y.size());
  noise.outliers.clear();
  noise.repeat_freedom = noise.windows = 0;
  if (samples.y.size() < 4) return record;
  const double rounding_pa = RoundingPa(noise, readings.sensor);
  std::vector<double> deviations = TakeRepeats(samples, noise.repeat_freedom);
  if (noise.repeat_freedom > 0) {
    noise.repeat_sigma_pa = Rms(deviations);  // each is scaled to one reading's variance
  }
  if (samples.t_s.size() > 1) noise.spacing_s = MedianSpacing(samples.t_s);
  if (samples.y.size() >= 4) {
    record.spacing_s = noise.spacing_s;
    const auto [low, high] = std::minmax_element(samples.y.begin(), samples.y.end());
    record.places =
        Places(samples, readings.quiet, readings.strokes, record.spacing_s, noise.source);
    std::vector<double> differences = ThirdDifferences(samples, record.places, record.spacing_s);
    Trim(differences, rounding_pa);
    const double local_pa = differences.empty() ? 0.0 : Rms(differences);
    const double floor_pa = std::max({local_pa, rounding_pa, kNoiseless * (*high - *low)});
    const std::vector<std::size_t> wild = Outliers(samples.t_s, samples.y, floor_pa);
    for (const std::size_t i : wild) noise.outliers.push_back(samples.index[i]);
    record.samples = Without(samples, wild);
    differences = ThirdDifferences(record.samples, record.places, record.spacing_s);
    Trim(differences, rounding_pa);
    noise.windows = static_cast<int>(differences.size());
    if (noise.windows > 0) record.rms = Rms(differences);
  }
  if (noise.windows > 0) {
    noise.sigma_pa = record.rms;
    noise.relative_error = kSigmaError / std::sqrt(noise.windows);
  }
  if (noise.repeat_freedom > std::max(noise.windows, kRepeatsMin)) {
    noise.source = NoiseSource::kRepeats;
    Trim(deviations, rounding_pa);
    noise.sigma_pa = Rms(deviations);
    noise.relative_error = 1.0 / std::sqrt(2.0 * noise.repeat_freedom);
  }
  noise.staircase = noise.sigma_pa < 0.5 * noise.quantum_pa;
  if (noise.staircase && noise.source != NoiseSource::kRepeats)  // rounding depends on the level
    noise.relative_error = std::max(noise.relative_error, kRoundingError);
  return record;
}

// The readings of the places, cut where the sampling has a gap, without what a switch leaves
// behind: the first third.
QuietRecord QuietOf(const Record& record) {
  QuietRecord quiet;
  const auto& [t_s, y, index] = record.samples;
  for (const TimeSpan& place : record.places) {
    quiet.emplace_back();
    const bool switched = place.start_s > t_s.front();
    const double start_s =
        place.start_s + (switched ? kUnsettled * (place.end_s - place.start_s) : 0.0);
    for (std::size_t i = 0; i < t_s.size(); ++i) {
      if (t_s[i] < start_s || t_s[i] > place.end_s) continue;
      const bool gap = i > 0 && t_s[i] - t_s[i - 1] > kGapMax * record.spacing_s;
      if (gap && !quiet.back().t_s.empty()) quiet.emplace_back();
      quiet.back().t_s.push_back(t_s[i]);
      quiet.back().y.push_back(y[i]);
    }
  }
  return quiet;
}

// The memory of all runs, from those that hold still for long enough, and what follows for each
// run's σ.
void TakeMemory(const std::vector<Record>& records, std::vector<Noise>& noises) {
  std::vector<QuietRecord> telling(records.size());
  std::vector<bool> estimated(records.size());
  double spacing_s = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < records.size(); ++j) {
    if (noises[j].staircase || noises[j].source == NoiseSource::kRepeats || !(records[j].rms > 0.0))
      continue;
    if (noises[j].source == NoiseSource::kClosed) telling[j] = QuietOf(records[j]);
    estimated[j] = true;
    spacing_s = std::min(spacing_s, records[j].spacing_s);
  }
  if (std::isinf(spacing_s)) return;
  const QuietMemory found = MemoryOfQuiet(telling, spacing_s);
  const auto& [theta_s, share] = found.memory;
  for (std::size_t j = 0; j < records.size(); ++j) {
    Noise& noise = noises[j];
    if (!estimated[j]) continue;
    noise.memories = found.allowed;
    if (theta_s == 0.0) continue;
    noise.memory = found.memory;
    const double rho = std::exp(-noise.spacing_s / theta_s);
    if (std::isfinite(found.levels[j].sigma)) {
      noise.sigma_pa = found.levels[j].sigma;
      noise.relative_error = found.levels[j].relative_error;
    } else {  // what its differences pass by
      noise.sigma_pa /= std::sqrt(ThirdDifference(rho, share));
    }
    noise.effective_samples /= 1.0 + 2.0 * share * rho / (1.0 - rho);
  }
}

// Of the runs whose sensor has no stated range the ends that its readings show. One sensor: what
// one run shows of it holds in all, unless another reads beyond.
void GuessEnds(std::span<const Readings> all, std::vector<Noise>& noises) {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  double lowest = high, highest = low;
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (all[j].sensor.HasRange()) continue;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const double y : all[j].y)
      if (std::isfinite(y)) least = std::min(least, y), most = std::max(most, y);
    lowest = std::min(lowest, least), highest = std::max(highest, most);
    noises[j].clipped = Clipped(all[j]);
    for (const std::size_t i : noises[j].clipped) {
      const bool upper = all[j].y[i] > 0.5 * (least + most);
      if (upper)
        high = std::min(high, most);
      else
        low = std::max(low, least);
    }
  }
  const double same = kSameEnd * (highest - lowest);
  if (high < highest - same) high = std::numeric_limits<double>::infinity();
  if (low > lowest + same) low = -std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (all[j].sensor.HasRange()) continue;
    noises[j].clip_low_pa = low;
    noises[j].clip_high_pa = high;
    std::erase_if(noises[j].clipped, [&](std::size_t i) {
      const double y = all[j].y[i];
      return y < high - same && y > low + same;
    });
  }
}

void FindEnds(std::span<const Readings> all, std::vector<Noise>& noises) {
  GuessEnds(all, noises);
  for (std::size_t j = 0; j < all.size(); ++j) {
    if (all[j].sensor.HasRange()) {
      StatedEnds ends = EndsOf(all[j].y, all[j].sensor);
      noises[j].clip_low_pa = ends.low;
      noises[j].clip_high_pa = ends.high;
      noises[j].clipped = std::move(ends.clipped);
    }
    noises[j].near_end = noises[j].clipped;
  }
}

// An end of the range need not lie on the grid.
double QuantumWithin(const Readings& readings, const Noise& noise) {
  std::vector<double> within;
  for (const double y : readings.y)
    if (y > noise.clip_low_pa && y < noise.clip_high_pa) within.push_back(y);
  return Quantum(within);
}

}  // namespace

double RoundingPa(const Noise& noise, const Sensor& sensor) {
  return std::max(noise.quantum_pa, sensor.resolution_pa) / std::sqrt(12.0);
}

std::vector<Noise> EstimateNoise(std::span<const Readings> all) {
  std::vector<Noise> noises(all.size());
  FindEnds(all, noises);
  for (std::size_t j = 0; j < all.size(); ++j)
    noises[j].quantum_pa = QuantumWithin(all[j], noises[j]);
  std::vector<Record> records;
  for (std::size_t j = 0; j < all.size(); ++j) {
    Noise& noise = noises[j];
    records.push_back(RecordOf(all[j], noise));
    if (!(noise.sigma_pa > 0.0)) continue;
    noise.near_end =
        NearEnds(all[j].y, noise.clip_low_pa, noise.clip_high_pa, kClipSigmas * noise.sigma_pa);
    if (noise.near_end.size() > noise.clipped.size()) records.back() = RecordOf(all[j], noise);
  }
  TakeMemory(records, noises);
  for (std::size_t j = 0; j < noises.size(); ++j)
    noises[j].sigma_pa = std::max(noises[j].sigma_pa, RoundingPa(noises[j], all[j].sensor));
  return noises;
}

Noise EstimateNoise(const Readings& readings) { return EstimateNoise({&readings, 1}).front(); }

Readings ReadingsOf(const Run& run) {
  Readings readings{run.t_s, run.pressure_pa, {}, {}, run.sensor};
  for (const PhaseSpan& span : PhasesOf(run)) {
    const bool closed = span.phase == Phase::kRest || span.phase == Phase::kHold;
    const bool quiet = closed && !run.volume_imposed;
    (quiet ? readings.quiet : readings.strokes).push_back({span.start_s, span.end_s});
  }
  return readings;
}

}  // namespace plenum::calibration
