#include "calibration/judge/residual.h"

#include <algorithm>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "calibration/noise/phases.h"
#include "calibration/noise/rounded_memory.h"
#include "calibration/noise/rounding.h"
#include "calibration/noise/whiteness.h"

namespace plenum::calibration {
namespace {

constexpr double kClipSigmas = 3.0;
constexpr double kMemoryless = 1e-3;  // θ over the spacing

// Residual in units of the noise, without what a coarse grid does to it.
std::vector<double> InNoise(const FittedRun& fitted) {
  std::vector<double> residual = Residual(fitted);
  if (fitted.noise.staircase) {
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] += fitted.model_pa[i];
    return StandardiseRounded(residual, fitted.model_pa, fitted.noise.quantum_pa).e;
  }
  for (double& value : residual) value /= fitted.noise.sigma_pa;
  return residual;
}

// The residuals of readings on a coarse grid again, as noise that remembers leaves them.
void FilterRounded(const std::vector<FittedRun>& runs, const std::function<bool()>& cancelled,
                   std::vector<ResidualSeries>& series) {
  std::vector<std::vector<double>> readings;
  std::vector<RoundedSeries> rounded;
  std::vector<std::size_t> hidden;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].noise.staircase) hidden.push_back(i);
  for (const std::size_t i : hidden) {
    std::vector<double>& y = readings.emplace_back(Residual(runs[i]));
    for (std::size_t k = 0; k < y.size(); ++k) y[k] += runs[i].model_pa[k];
  }
  for (std::size_t k = 0; k < hidden.size(); ++k) {
    const FittedRun& run = runs[hidden[k]];
    rounded.push_back({run.run->t_s, readings[k], run.model_pa, run.noise.quantum_pa,
                       LikeliestNoise(readings[k], run.model_pa, run.noise.quantum_pa)});
  }
  const NoiseMemory memory =
      LikeliestRoundedMemory(rounded, runs[hidden.front()].noise.spacing_s, cancelled);
  for (std::size_t k = 0; k < hidden.size(); ++k)
    series[hidden[k]].residual = InnovationsOf(rounded[k], memory);
}

void TestLackOfFit(const std::vector<FittedRun>& runs, int fitted_numbers, ResidualReport& report) {
  double squares = 0.0, count = 0.0, variance = 0.0;
  for (const FittedRun& fitted : runs) {
    double samples = 0.0;
    for (const double value : Residual(fitted)) {
      if (!std::isfinite(value)) continue;
      squares += std::pow(value / fitted.noise.sigma_pa, 2);
      samples += 1.0;
    }
    const auto& [theta_s, share] = fitted.noise.memory;
    const double rho2 = theta_s > 0.0 ? std::exp(-2.0 * fitted.noise.spacing_s / theta_s) : 0.0;
    variance += 2.0 * samples * (1.0 + 2.0 * share * share * rho2 / (1.0 - rho2)) +
                std::pow(2.0 * samples * fitted.noise.relative_error, 2);
    count += samples;
  }
  const double alarm =
      boost::math::quantile(boost::math::complement(boost::math::normal(), kFalseAlarm));
  report.lack_of_fit = squares / std::max(1.0, count - fitted_numbers);
  report.lack_of_fit_limit = 1.0 + alarm * std::sqrt(variance) / std::max(1.0, count);
}

// Gives the series the memory of their noise: where that is an estimate, the one that is likeliest
// given what is left, among those that agree with the quiet readings.
void GiveMemory(const std::vector<Noise>& noises, const std::function<bool()>& cancelled,
                std::vector<ResidualSeries>& series) {
  std::vector<NoiseSeries> estimated;
  const std::vector<NoiseMemory>* allowed = nullptr;
  for (std::size_t i = 0; i < series.size(); ++i) {
    series[i].memory = noises[i].memory;
    if (noises[i].memories.empty()) continue;
    estimated.push_back({series[i].run->t_s, series[i].residual});
    allowed = &noises[i].memories;
  }
  if (!allowed) return;
  const NoiseMemory memory = LikeliestMemory(estimated, *allowed, cancelled);
  for (std::size_t i = 0; i < series.size(); ++i)
    if (!noises[i].memories.empty()) series[i].memory = memory;
}

// By how much σ² was read too small if the noise has the memory that the residual shows: slow noise
// passes the readings' differences by.
double Underread(const std::vector<Noise>& noises, const std::vector<ResidualSeries>& series) {
  double most = 1.0;
  for (std::size_t i = 0; i < series.size(); ++i) {
    if (noises[i].memories.empty()) continue;
    const auto seen = [&](const NoiseMemory& memory) {
      const double theta_s = std::max(memory.theta_s, kMemoryless * noises[i].spacing_s);
      return ThirdDifference(std::exp(-noises[i].spacing_s / theta_s), memory.share);
    };
    most = std::max(most, seen(noises[i].memory) / seen(series[i].memory));
  }
  return most;
}

// Of all runs together and of each, which share the false-alarm rate: the one furthest towards its
// limit.
Portmanteau TestWhite(const std::vector<ResidualSeries>& series) {
  std::vector<std::vector<double>> white;
  for (const ResidualSeries& one : series)
    white.push_back(Whitened(one.run->t_s, one.residual, one.memory));
  const int count = white.size() > 1 ? static_cast<int>(white.size()) + 1 : 1;
  Portmanteau worst = TestWhiteness(white, count);
  for (std::size_t i = 0; count > 1 && i < white.size(); ++i) {
    const Portmanteau one = TestWhiteness({&white[i], 1}, count);
    if (one.statistic / one.limit > worst.statistic / worst.limit) worst = one;
  }
  return worst;
}

// Both tests of structure; where they were made before, with another memory, the milder one counts.
void TestStructure(const std::vector<Noise>& noises, const std::function<bool()>& cancelled,
                   std::vector<ResidualSeries>& series, ResidualReport& report,
                   std::vector<InputCorrelation>* by_input) {
  const auto stopped = [&] { return cancelled && cancelled(); };
  report.tested = false;
  if (stopped()) return;
  GiveMemory(noises, cancelled, series);
  if (stopped()) return;
  const Portmanteau white = TestWhite(series);
  if (white.statistic / white.limit < report.portmanteau / report.portmanteau_limit) {
    report.portmanteau = white.statistic;
    report.portmanteau_limit = white.limit;
  }
  Independence independence = TestIndependence(series, cancelled);
  if (stopped()) return;
  report.tested = true;
  if (independence.statistic < report.cross) {
    report.cross = independence.statistic;
    report.cross_limit = independence.limit;
    if (by_input) *by_input = std::move(independence.inputs);
  }
  report.white = report.portmanteau <= report.portmanteau_limit;
  report.independent_of_inputs = report.cross <= report.cross_limit;
}

}  // namespace

std::vector<double> Residual(const FittedRun& fitted) {
  const Run& run = *fitted.run;
  std::vector<double> residual(run.t_s.size());
  for (std::size_t i = 0; i < residual.size(); ++i)
    residual[i] = run.pressure_pa[i] - fitted.model_pa[i];
  const double margin_pa = kClipSigmas * fitted.noise.sigma_pa;
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (fitted.model_pa[i] > fitted.noise.clip_high_pa - margin_pa ||
        fitted.model_pa[i] < fitted.noise.clip_low_pa + margin_pa)
      residual[i] = std::numeric_limits<double>::quiet_NaN();
  for (const auto* dropped :
       {&fitted.noise.near_end, &fitted.noise.clipped, &fitted.noise.outliers})
    for (const std::size_t i : *dropped) residual[i] = std::numeric_limits<double>::quiet_NaN();
  return residual;
}

std::vector<PhaseResidual> ResidualByPhase(const Run& run, std::span<const double> residual_pa) {
  std::vector<PhaseResidual> result;
  for (const PhaseSpan& span : PhasesOf(run))
    result.push_back({run.id, span.phase, span.cycle, span.start_s, span.end_s});
  const std::vector<PhaseSpan> phases = PhasesOf(run);
  struct Moments {
    double t = 0.0, tt = 0.0, tr = 0.0;
  };
  std::vector<Moments> moments(result.size());
  for (std::size_t i = 0; i < residual_pa.size(); ++i) {
    if (!std::isfinite(residual_pa[i])) continue;
    const std::size_t at = PhaseAt(phases, run.t_s[i]);
    const double t = run.t_s[i] - phases[at].start_s;
    PhaseResidual& phase = result[at];
    ++phase.samples;
    phase.mean_pa += residual_pa[i];
    phase.rms_pa += residual_pa[i] * residual_pa[i];
    moments[at].t += t;
    moments[at].tt += t * t;
    moments[at].tr += t * residual_pa[i];
  }
  for (std::size_t i = 0; i < result.size(); ++i) {
    PhaseResidual& phase = result[i];
    if (phase.samples == 0) continue;
    const double count = phase.samples;
    phase.mean_pa /= count;
    phase.rms_pa = std::sqrt(phase.rms_pa / count);
    const double spread = moments[i].tt - moments[i].t * moments[i].t / count;
    if (phase.samples > 2 && spread > 0.0)
      phase.trend_pa_per_s = (moments[i].tr - moments[i].t * phase.mean_pa) / spread;
  }
  return result;
}

ResidualReport AssessResiduals(const std::vector<FittedRun>& runs, int fitted_numbers,
                               std::vector<InputCorrelation>* by_input,
                               const std::function<bool()>& cancelled) {
  ResidualReport report;
  report.portmanteau = report.cross = std::numeric_limits<double>::infinity();
  report.portmanteau_limit = report.cross_limit = 1.0;
  std::vector<ResidualSeries> series;
  std::vector<Noise> noises;
  for (const FittedRun& fitted : runs) {
    series.push_back({fitted.run, InNoise(fitted), fitted.model_pa, {}});
    noises.push_back(fitted.noise);
    for (PhaseResidual& phase : ResidualByPhase(*fitted.run, Residual(fitted)))
      report.phases.push_back(std::move(phase));
  }
  TestLackOfFit(runs, fitted_numbers, report);
  TestStructure(noises, cancelled, series, report, by_input);
  const auto hides = [](const Noise& noise) { return noise.staircase; };
  const bool structure = !report.white || !report.independent_of_inputs;
  if (structure && std::any_of(noises.begin(), noises.end(), hides)) {
    FilterRounded(runs, cancelled, series);
    TestStructure(noises, cancelled, series, report, by_input);
  }
  report.underread = Underread(noises, series);
  report.lack_of_fit_limit *= report.underread;
  return report;
}

}  // namespace plenum::calibration
