#include "calibration/fit/observations.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace plenum::calibration {
namespace {

// A run's σ stands for itself where it is off the common one by more than this many of its standard
// errors and by more than kOwnShare.
constexpr double kOwnErrors = 4.0;
constexpr double kOwnShare = 0.3;
// Less noise than this share of the operating gauge pressure is not believed: still readings of a
// filtered sensor say nothing of its linearity, and the model is no better either.
constexpr double kLeastNoise = 1e-4;
// A white part that every sensor has: without it two readings at nearly one instant would weigh
// beyond measure.
constexpr double kShareMax = 0.95;

constexpr double kTurnSigmas = 2.0;    // by which the instant of a command may be off
constexpr double kFreedomLeast = 4.0;  // readings beyond the numbers that a fit has

constexpr std::vector<double> Channels::*kSupporting[] = {
    &Channels::inlet_pressure_pa, &Channels::temperature_k, &Channels::volume_m3,
    &Channels::flow_m3_per_s, &Channels::source_pressure_pa};

const std::vector<double>& Measured(const Run& run, const ObservedSignal& signal) {
  return signal.channel ? run.channels.*signal.channel : run.pressure_pa;
}

const std::vector<double>& Predicted(const Reading& reading, const ObservedSignal& signal) {
  return signal.channel ? reading.channels.*signal.channel : reading.pressure_pa;
}

bool Jumps(std::vector<double> Channels::*channel) {
  return channel == &Channels::inlet_pressure_pa || channel == &Channels::flow_m3_per_s;
}

// When the valve turns, rising, from the earliest to the latest.
std::vector<std::pair<double, double>> TurnsOf(const Run& run) {
  std::vector<std::pair<double, double>> turns_s;
  model::ValveState state = model::ValveState::kHold;
  for (std::size_t k = 0; k < run.valve.size(); ++k) {
    if (std::exchange(state, run.valve[k].state) == run.valve[k].state) continue;
    const double known_s = InstantUncertainty(run, k);
    const double room_s = std::isfinite(known_s) ? kTurnSigmas * known_s : 0.0;
    turns_s.emplace_back(run.valve[k].time_s - room_s, run.valve[k].time_s + room_s);
  }
  return turns_s;
}

// Whether one of them may lie between the neighbours of a sample.
bool Beside(const std::vector<std::pair<double, double>>& turns_s, const std::vector<double>& t_s,
            std::size_t i) {
  const auto [first, last] = std::equal_range(t_s.begin(), t_s.end(), t_s[i]);
  const double before_s = first == t_s.begin() ? t_s[i] : *std::prev(first);
  const double after_s = last == t_s.end() ? t_s[i] : *last;
  return std::any_of(turns_s.begin(), turns_s.end(), [&](const std::pair<double, double>& turn) {
    return turn.first <= after_s && turn.second >= before_s;
  });
}

// The whitening of the usable samples.
void TakeSteps(const Run& run, ObservedSignal& signal) {
  std::vector<double> t_s;
  t_s.reserve(signal.samples.size());
  for (const std::size_t i : signal.samples) t_s.push_back(run.t_s[i]);
  signal.steps = StepsOf(t_s, signal.memory);
}

ObservedSignal SignalOf(const Run& run, std::vector<double> Channels::*channel,
                        const Noise& noise) {
  ObservedSignal signal;
  signal.channel = channel;
  signal.sigma = noise.sigma_pa;
  const std::vector<double>& measured = Measured(run, signal);
  const auto turns_s = Jumps(channel) ? TurnsOf(run) : std::vector<std::pair<double, double>>();
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const bool dropped = std::binary_search(noise.outliers.begin(), noise.outliers.end(), i) ||
                         std::binary_search(noise.near_end.begin(), noise.near_end.end(), i);
    const bool either_side = !turns_s.empty() && Beside(turns_s, run.t_s, i);
    if (std::isfinite(measured[i]) && !dropped && !either_side) signal.samples.push_back(i);
  }
  if (noise.staircase && !channel) signal.grid = Grid(noise.quantum_pa, noise.quantum_pa);
  signal.memory = noise.memory;
  TakeSteps(run, signal);
  return signal;
}

// Root of the mean variance over the runs, by their windows.
double CommonSigma(const std::vector<Noise>& noises) {
  double sum = 0.0, weight = 0.0;
  for (const Noise& noise : noises) {
    if (!std::isfinite(noise.sigma_pa)) continue;
    const double windows = std::max(1, noise.windows);
    sum += windows * noise.sigma_pa * noise.sigma_pa;
    weight += windows;
  }
  return weight > 0.0 ? std::sqrt(sum / weight) : 0.0;
}

double LeastNoise(const Run& run) { return kLeastNoise * model::Span(run.chamber); }

void ShareAmongRuns(const Dataset& dataset, std::vector<Noise>& noises) {
  const double common_pa = CommonSigma(noises);
  for (std::size_t i = 0; i < noises.size(); ++i) {
    Noise& noise = noises[i];
    const double apart = std::abs(noise.sigma_pa / common_pa - 1.0);
    const bool own = apart > std::max(kOwnShare, kOwnErrors * noise.relative_error);
    if (!own) noise.sigma_pa = common_pa;
    noise.sigma_pa = std::max(
        {noise.sigma_pa, LeastNoise(dataset.runs[i]), RoundingPa(noise, dataset.runs[i].sensor)});
  }
}

double SquaresOf(const std::vector<double>& residual_pa) {
  double sum = 0.0;
  for (const double r : residual_pa) sum += std::isfinite(r) ? r * r : 0.0;
  return sum;
}

// Of a channel, σ at its sensor's assumed accuracy at least.
Noise NoiseOfChannel(const Run& run, const std::vector<double>& measured) {
  Noise noise = EstimateNoise({run.t_s, measured, {}, {}});
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double value : measured) {
    if (!std::isfinite(value)) continue;
    low = std::min(low, value), high = std::max(high, value);
  }
  noise.sigma_pa = std::fmax(noise.sigma_pa, kChannelAccuracy * (high - low));
  return noise;
}

// The whitening map on a series given sample by sample.
template <class At>
void Whiten(const ObservedSignal& signal, const At& at, double*& row) {
  double remembered = 0.0;
  for (std::size_t k = 0; k < signal.samples.size(); ++k) {
    const Innovation& step = signal.steps[k];
    const double expected = step.carry * remembered;
    const double off = at(signal.samples[k]) - expected;
    *row++ = off * step.scale / signal.sigma;
    remembered = expected + step.gain * off;
  }
}

}  // namespace

std::vector<Innovation> StepsOf(std::span<const double> t_s, NoiseMemory memory) {
  memory.share = std::min(memory.share, kShareMax);
  InnovationSteps filter(memory);
  std::vector<Innovation> steps;
  for (const double t : t_s) steps.push_back(filter.Next(t));
  return steps;
}

std::size_t ObservedRun::rows() const {
  std::size_t rows = 0;
  for (const ObservedSignal& signal : signals) rows += signal.samples.size();
  return rows;
}

std::vector<ObservedRun> Observe(const Dataset& dataset) {
  std::vector<Readings> readings;
  for (const Run& run : dataset.runs) readings.push_back(ReadingsOf(run));
  std::vector<Noise> noises = EstimateNoise(readings);
  ShareAmongRuns(dataset, noises);
  std::vector<ObservedRun> observed;
  for (std::size_t i = 0; i < dataset.runs.size(); ++i) {
    const Run& run = dataset.runs[i];
    ObservedRun& of_run = observed.emplace_back();
    of_run.noise = noises[i];
    of_run.signals.push_back(SignalOf(run, nullptr, noises[i]));
    for (const auto channel : kSupporting) {
      const bool drives = channel == &Channels::source_pressure_pa &&
                          (run.supply == Supply::kMeasured || run.supply == Supply::kNone);
      const bool imposed = channel == &Channels::volume_m3 && run.volume_imposed;
      const std::vector<double>& measured = run.channels.*channel;
      if (drives || imposed || measured.empty()) continue;
      const Noise noise = NoiseOfChannel(run, measured);
      if (!(noise.sigma_pa > 0.0)) continue;
      ObservedSignal signal = SignalOf(run, channel, noise);
      if (!signal.samples.empty()) of_run.signals.push_back(std::move(signal));
    }
  }
  return observed;
}

std::vector<ObservedRun> EverySecond(const Dataset& dataset,
                                     const std::vector<ObservedRun>& observed, std::size_t from) {
  std::vector<ObservedRun> halved = observed;
  for (std::size_t run = 0; run < halved.size(); ++run)
    for (ObservedSignal& signal : halved[run].signals) {
      std::vector<std::size_t> kept;
      for (std::size_t k = from; k < signal.samples.size(); k += 2)
        kept.push_back(signal.samples[k]);
      signal.samples = std::move(kept);
      TakeSteps(dataset.runs[run], signal);
    }
  return halved;
}

void Residuals(const Run& run, const ObservedRun& observed, const Reading& predicted,
               std::span<double> rows) {
  double* row = rows.data();
  for (const ObservedSignal& signal : observed.signals) {
    const std::vector<double>& model = Predicted(predicted, signal);
    const std::vector<double>& measured = Measured(run, signal);
    const auto off = [&](std::size_t i) {
      if (model.empty()) return 0.0;
      const double above = model[i] - measured[i];
      return above + signal.grid.At(-above).mean;
    };
    Whiten(signal, off, row);
  }
}

std::vector<double> GridSlopes(const Run& run, const ObservedRun& observed,
                               const Reading& predicted) {
  const ObservedSignal& pressure = observed.signals.front();
  std::vector<double> slopes;
  if (pressure.grid.quantum() == 0.0) return slopes;
  for (std::size_t i = 0; i < run.pressure_pa.size(); ++i)
    slopes.push_back(pressure.grid.At(run.pressure_pa[i] - predicted.pressure_pa[i]).slope);
  return slopes;
}

void Whitened(const ObservedRun& observed, const Reading& derivative,
              std::span<const double> slopes, std::span<double> rows) {
  double* row = rows.data();
  for (const ObservedSignal& signal : observed.signals) {
    const std::vector<double>& series = Predicted(derivative, signal);
    const bool on_grid = signal.channel == nullptr && !slopes.empty();
    const auto at = [&](std::size_t i) {
      return series.empty() ? 0.0 : series[i] * (on_grid ? slopes[i] : 1.0);
    };
    Whiten(signal, at, row);
  }
}

bool TakeHiddenNoise(const Dataset& dataset, const std::vector<std::size_t>& runs,
                     const std::vector<Reading>& predicted, std::vector<ObservedRun>& observed) {
  bool less = false;
  for (const std::size_t run : runs) {
    ObservedSignal& pressure = observed[run].signals.front();
    if (pressure.grid.quantum() == 0.0 || predicted[run].pressure_pa.empty()) continue;
    std::vector<double> readings, model;
    for (const std::size_t i : pressure.samples) {
      readings.push_back(dataset.runs[run].pressure_pa[i]);
      model.push_back(predicted[run].pressure_pa[i]);
    }
    const double hidden = LikeliestNoise(readings, model, pressure.grid.quantum());
    if (hidden > kHiddenLess * pressure.grid.noise()) continue;
    pressure.grid = Grid(pressure.grid.quantum(), hidden);
    less = true;
  }
  return less;
}

bool TakeNoiseOfFit(const Dataset& dataset, const std::vector<std::size_t>& runs,
                    const std::vector<Reading>& predicted, std::size_t numbers,
                    std::vector<ObservedRun>& observed) {
  double readings = 0.0;
  for (const std::size_t run : runs)
    readings += static_cast<double>(observed[run].signals.front().samples.size());
  const double free = 1.0 - static_cast<double>(numbers) / readings;  // of each reading
  double squares_pa2 = 0.0, freedom = 0.0;
  std::vector<std::size_t> too_loud;
  for (const std::size_t run : runs) {
    const ObservedSignal& pressure = observed[run].signals.front();
    if (pressure.grid.quantum() > 0.0 || predicted[run].pressure_pa.empty()) continue;
    const double left_pa2 =
        SquaresOf(PressureResidual(dataset.runs[run], observed[run], predicted[run]));
    const double own = free * static_cast<double>(pressure.samples.size());
    if (!(left_pa2 < std::pow(kMuchLess * pressure.sigma, 2) * own)) continue;
    too_loud.push_back(run);
    squares_pa2 += left_pa2;
    freedom += own;
  }
  if (freedom < kFreedomLeast) return false;
  const double left_pa = std::sqrt(squares_pa2 / freedom);
  for (std::size_t run = 0; run < observed.size(); ++run) {  // those that no fit saw: one sensor
    const ObservedSignal& pressure = observed[run].signals.front();
    const bool fitted = std::find(runs.begin(), runs.end(), run) != runs.end();
    if (!fitted && pressure.grid.quantum() == 0.0 && left_pa < kMuchLess * pressure.sigma)
      too_loud.push_back(run);
  }
  bool less = false;
  for (const std::size_t run : too_loud) {
    Noise& noise = observed[run].noise;
    const double taken_pa = std::max(
        {left_pa, RoundingPa(noise, dataset.runs[run].sensor), LeastNoise(dataset.runs[run])});
    double& sigma_pa = observed[run].signals.front().sigma;
    less = less || taken_pa < kHiddenLess * sigma_pa;
    sigma_pa = noise.sigma_pa = std::min(sigma_pa, taken_pa);
    noise.relative_error = 1.0 / std::sqrt(2.0 * freedom);
  }
  return less;
}

bool LeaveOutWild(const Dataset& dataset, const std::vector<std::size_t>& runs,
                  const std::vector<Reading>& predicted, std::vector<ObservedRun>& observed) {
  bool any = false;
  for (const std::size_t index : runs) {
    if (predicted[index].pressure_pa.empty()) continue;
    const Run& run = dataset.runs[index];
    ObservedSignal& pressure = observed[index].signals.front();
    Noise& noise = observed[index].noise;
    const auto off = [&](std::size_t k) {
      const std::size_t i = pressure.samples[k];
      return std::abs(run.pressure_pa[i] - predicted[index].pressure_pa[i]);
    };
    std::vector<std::size_t> wild;
    for (std::size_t k = 1; k + 1 < pressure.samples.size(); ++k)
      if (off(k) > kWildSigmas * pressure.sigma && 4.0 * std::max(off(k - 1), off(k + 1)) < off(k))
        wild.push_back(pressure.samples[k]);
    const double most = kWildShare * static_cast<double>(pressure.samples.size());
    if (wild.empty() || static_cast<double>(wild.size()) > most) continue;
    any = true;
    noise.outliers.insert(noise.outliers.end(), wild.begin(), wild.end());
    std::sort(noise.outliers.begin(), noise.outliers.end());
    std::erase_if(pressure.samples,
                  [&](std::size_t i) { return std::binary_search(wild.begin(), wild.end(), i); });
    TakeSteps(run, pressure);
  }
  return any;
}

std::vector<double> PressureResidual(const Run& run, const ObservedRun& observed,
                                     const Reading& predicted) {
  std::vector<double> residual(run.t_s.size(), std::numeric_limits<double>::quiet_NaN());
  for (const std::size_t i : observed.signals.front().samples)
    residual[i] = run.pressure_pa[i] - predicted.pressure_pa[i];
  return residual;
}

}  // namespace plenum::calibration
