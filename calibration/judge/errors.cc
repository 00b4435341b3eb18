#include "calibration/judge/errors.h"

#include <limits>

#include "calibration/judge/evidence.h"
#include "calibration/judge/residual.h"
#include "calibration/learn/criticism.h"
#include "calibration/values/parallel.h"
#include "calibration/values/specimens.h"
#include "calibration/values/thresholds.h"

namespace plenum::calibration {
namespace {

constexpr std::size_t kReportSteps = 20'000;  // when there is no time left

bool IsHeldOut(const Dataset& dataset, std::size_t run) {
  return std::find(dataset.holdout.begin(), dataset.holdout.end(), dataset.runs[run].id) !=
         dataset.holdout.end();
}

bool SameReadings(const Run& a, const Run& b) {
  return a.valve.size() == b.valve.size() &&
         std::equal(a.pressure_pa.begin(), a.pressure_pa.end(), b.pressure_pa.begin(),
                    b.pressure_pa.end(),
                    [](double x, double y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// Σ ∂p/∂uᵀ·Σ·∂p/∂u over the run's pressure samples; 0 where it cannot be simulated.
double PredictionVariance(const FitData& data, const Fit& fit, std::size_t run,
                          const FitOptions& options) {
  std::vector<Parameter> parameters;
  for (const Coordinate& coordinate : fit.coordinates) parameters.push_back(coordinate.parameter);
  const Prediction prediction = data.forward->Predict(
      run, fit.state, parameters, {.cancelled = options.cancelled, .steps_max = options.steps_max});
  if (prediction.status != model::SimulateStatus::kDone) return 0.0;
  const std::vector<std::size_t>& samples = (*data.observed)[run].signals.front().samples;
  Eigen::MatrixXd slopes =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(samples.size()), fit.u.size());
  for (Eigen::Index j = 0; j < fit.u.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    const std::vector<double>& derivative = prediction.derivatives[k].pressure_pa;
    const double slope = derivative.empty() ? 0.0 : fit.coordinates[k].Slope(fit.u[j]);
    for (std::size_t i = 0; i < samples.size() && slope != 0.0; ++i)
      slopes(static_cast<Eigen::Index>(i), j) = slope * derivative[samples[i]];
  }
  return (slopes * Covariance(data, fit, options)).cwiseProduct(slopes).sum();
}

// What the scatter between pieces adds to the squares of a run of a piece that no fit saw.
double PieceVariance(const Bench& bench, const ModelState& state, std::size_t run) {
  std::vector<Parameter> parameters;
  std::vector<double> scatter;
  for (const Declared number : UntoldNumbers(bench.dataset, bench.data.runs, run)) {
    parameters.push_back({.declared = number, .specimen = bench.dataset.runs[run].specimen});
    scatter.push_back(ScatterOf(bench.dataset, bench.data.runs, state, number));
  }
  if (parameters.empty()) return 0.0;
  const Prediction prediction = bench.forward.Predict(
      run, state, parameters,
      {.cancelled = bench.tight.cancelled, .steps_max = bench.tight.steps_max});
  if (prediction.status != model::SimulateStatus::kDone) return 0.0;
  double sum_pa2 = 0.0;
  for (std::size_t j = 0; j < parameters.size(); ++j)
    for (const std::size_t i : bench.observed[run].signals.front().samples)
      if (const std::vector<double>& slope = prediction.derivatives[j].pressure_pa; !slope.empty())
        sum_pa2 += std::pow(scatter[j] * slope[i], 2);
  return sum_pa2;
}

// Squares on runs that a fit did not see, and what they are made of.
struct UnseenSum {
  Squares squares;
  double noise_pa2 = 0.0, spread_pa2 = 0.0, samples = 0.0;
  void Add(const Bench& bench, const FitData& data, const Fit& fit, std::size_t run) {
    squares.Add(ErrorsUnseen(bench, run, fit.state));
    const auto count = static_cast<double>(bench.observed[run].signals.front().samples.size());
    noise_pa2 += count * std::pow(NoiseOf(bench, {run}), 2) + PieceVariance(bench, fit.state, run);
    spread_pa2 += PredictionVariance(data, fit, run, bench.tight);
    samples += count;
  }
  UnseenError Mean() const {
    const double count = std::max(1.0, samples);
    return {squares.Rms(), std::sqrt(noise_pa2 / count), std::sqrt(spread_pa2 / count)};
  }
};

// Of the fitted runs.
std::vector<Reading> ReadingsOf(const Bench& bench, const ModelState& state) {
  std::vector<Reading> readings(bench.data.runs.size());
  ForAll(readings.size(), bench.tight.threads,
         [&](std::size_t k) { readings[k] = Shown(bench, state, bench.data.runs[k]); });
  return readings;
}

// Σ e² − n of the whitened residuals of all channels but the pressure.
double ChannelsAbove(const Run& run, const ObservedRun& observed, const Reading& reading) {
  const std::size_t pressures = observed.signals.front().samples.size();
  if (observed.rows() == pressures) return 0.0;
  std::vector<double> rows(observed.rows());
  Residuals(run, observed, reading, rows);
  double above = 0.0;
  for (std::size_t i = pressures; i < rows.size(); ++i) above += rows[i] * rows[i] - 1.0;
  return above;
}

}  // namespace

bool Stopped(const Bench& bench) { return bench.tight.cancelled && bench.tight.cancelled(); }

Reading Shown(const Bench& bench, const ModelState& state, std::size_t run) {
  FitOptions options = bench.tight;
  options.cancelled = nullptr;
  if (Stopped(bench)) options.steps_max = kReportSteps;
  return Predicted(bench.data, state, run, options);
}

bool HeldOut(const Bench& bench, std::size_t run) { return IsHeldOut(bench.dataset, run); }

std::vector<std::size_t> OriginalsOf(const Dataset& dataset) {
  const std::size_t runs = dataset.runs.size();
  std::vector<std::size_t> original(runs);
  for (std::size_t i = 0; i < runs; ++i) {
    original[i] = i;
    for (std::size_t j = 0; j < runs && original[i] == i; ++j) {
      const bool before = IsHeldOut(dataset, i) == IsHeldOut(dataset, j)
                              ? j < i
                              : IsHeldOut(dataset, i);  // what is fitted comes first
      if (before && SameReadings(dataset.runs[i], dataset.runs[j])) original[i] = j;
    }
  }
  return original;
}

Squares ErrorsOf(const Bench& bench, std::size_t run, const ModelState& state) {
  const Reading reading = Shown(bench, state, run);
  Squares squares;
  if (reading.pressure_pa.empty()) {
    squares.Add(std::numeric_limits<double>::max());
    return squares;
  }
  for (const double r : PressureResidual(bench.dataset.runs[run], bench.observed[run], reading))
    squares.Add(r);
  return squares;
}

Fit AlignedFit(const Bench& bench, std::size_t run, const ModelState& state) {
  FitData data = bench.data;
  data.clocks = data.clocks || IsOneRecording(data);
  return AlignedFit(data, state, run, bench.tight);
}

ModelState Aligned(const Bench& bench, std::size_t run, const ModelState& state) {
  const Fit aligned = AlignedFit(bench, run, state);
  return aligned.Usable() ? aligned.state : state;
}

Squares ErrorsUnseen(const Bench& bench, std::size_t run, const ModelState& state) {
  return ErrorsOf(bench, run, Aligned(bench, run, state));
}

double NoiseOf(const Bench& bench, const std::vector<std::size_t>& runs) {
  double sum = 0.0, count = 0.0;
  for (const std::size_t i : runs) {
    const ObservedSignal& pressure = bench.observed[i].signals.front();
    const double samples = static_cast<double>(pressure.samples.size());
    sum += samples * pressure.sigma * pressure.sigma;
    count += samples;
  }
  return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

UnseenError HeldOutError(const Bench& bench, const Fit& fit) {
  UnseenSum sum;
  for (const std::size_t run : bench.held_out) sum.Add(bench, bench.data, fit, run);
  return sum.Mean();
}

std::optional<UnseenError> LeaveOneOut(const Bench& bench, const Fit& fit) {
  if (bench.data.runs.size() < 2) return std::nullopt;
  UnseenSum sum;
  for (const std::size_t left_out : bench.data.runs) {
    FitData data = bench.data;
    std::erase(data.runs, left_out);
    FitOptions options = bench.tight;
    options.noise_share = 1e-2;
    ModelState start = fit.state;
    CopyRun(bench.forward.Declared(), left_out, start);
    const Fit without = FitModel(data, start, options);
    if (!without.Usable()) return std::nullopt;
    sum.Add(bench, data, without, left_out);
  }
  return sum.Mean();
}

Leftover LeftoverOf(const Bench& bench, const Fit& fit, bool with_holdout) {
  Leftover leftover;
  if (!fit.Usable()) return leftover;
  std::vector<FittedRun> runs;
  Squares squares;
  const std::vector<Reading> readings = ReadingsOf(bench, fit.state);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const std::size_t i = bench.data.runs[k];
    const Reading& reading = readings[k];
    if (reading.pressure_pa.empty()) return leftover;
    const Noise& noise = bench.observed[i].noise;
    runs.push_back({&bench.dataset.runs[i], reading.pressure_pa, noise});
    leftover.rough_noise = leftover.rough_noise || !(noise.relative_error < kRoughNoise);
    for (const double r : PressureResidual(bench.dataset.runs[i], bench.observed[i], reading))
      squares.Add(r);
    leftover.channels_above += ChannelsAbove(bench.dataset.runs[i], bench.observed[i], reading);
  }
  leftover.channels_above = std::max(0.0, leftover.channels_above);
  leftover.pressure_readings = squares.count;
  leftover.residual = AssessResiduals(runs, static_cast<int>(fit.coordinates.size()), nullptr,
                                      bench.tight.cancelled);
  leftover.rms_pa = squares.Rms();
  leftover.priors_hold = PriorsHold(fit);
  // A memory that leaves the residual coloured is not that of the noise.
  const double underread = leftover.residual.white ? std::sqrt(leftover.residual.underread) : 1.0;
  leftover.noise_pa = underread * NoiseOf(bench, bench.data.runs);
  if (IsNoise(leftover))
    leftover.learnable_bic =
        LearnableGain(bench.data, fit, MemoryOf(WhitenedOf(bench, fit)), bench.tight);
  if (!with_holdout) return leftover;
  const std::optional<UnseenError> unseen =
      bench.held_out.empty() ? LeaveOneOut(bench, fit) : HeldOutError(bench, fit);
  if (unseen) {
    leftover.holdout_rms_pa = unseen->rms_pa;
    leftover.holdout_noise_pa = underread * unseen->noise_pa;
    leftover.holdout_spread_pa = underread * unseen->spread_pa;
  }
  return leftover;
}

std::vector<std::vector<double>> WhitenedOf(const Bench& bench, const Fit& fit) {
  std::vector<std::vector<double>> series;
  const std::vector<Reading> readings = ReadingsOf(bench, fit.state);
  for (std::size_t k = 0; k < readings.size(); ++k) {
    const std::size_t i = bench.data.runs[k];
    std::vector<double>& rows = series.emplace_back(bench.observed[i].rows());
    Residuals(bench.dataset.runs[i], bench.observed[i], readings[k], rows);
    rows.resize(bench.observed[i].signals.front().samples.size());
  }
  return series;
}

}  // namespace plenum::calibration
