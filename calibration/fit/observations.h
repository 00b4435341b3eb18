// What a fit compares with the model: the usable readings of each run, weighed by their noise.
//
// Sample i of a signal counts as r_i/σ, with r = model − measured. Noise that remembers is
// whitened (noise_memory.h) over the usable samples. Left out: missing, wild and clipped readings.
// A second channel supports the pressure; its σ is at least kChannelAccuracy of its range, because
// its sensor and its place are less certain than its noise; of one that jumps with the valve (inlet
// pressure, flow) the samples next to a command do not count, as clocks may be off by a part of a
// sample, and the jump may lie on either side. Where noise is below half of the
// readings' quantum the model's mean reading on that grid takes the model's place (rounding.h);
// until TakeHiddenNoise is told of a fit, the noise behind the grid counts as a quantum, which
// shifts nothing.
#ifndef PLENUM_CALIBRATION_FIT_OBSERVATIONS_H_
#define PLENUM_CALIBRATION_FIT_OBSERVATIONS_H_

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/fit/forward.h"
#include "calibration/noise/noise.h"
#include "calibration/noise/rounding.h"

namespace plenum::calibration {

inline constexpr double kChannelAccuracy = 0.01;

struct ObservedSignal {
  std::vector<double> Channels::*channel = nullptr;  // null: the pressure
  std::vector<std::size_t> samples;                  // usable, by index into the run
  NoiseMemory memory;
  std::vector<Innovation> steps;  // by usable sample, of that memory
  double sigma = 1.0;
  Grid grid;  // of readings coarser than twice their noise, with the noise behind it
};

struct ObservedRun {
  Noise noise;                          // of the pressure, as the readings show it
  std::vector<ObservedSignal> signals;  // the pressure first
  std::size_t rows() const;
};

// The whitening of samples at these times.
std::vector<Innovation> StepsOf(std::span<const double> t_s, NoiseMemory memory);

// Of every run; the pressure's σ is shared by the runs (one sensor) unless they differ by more than
// their errors allow.
std::vector<ObservedRun> Observe(const Dataset& dataset);

// Every second usable sample of each signal, from the first or the second on.
std::vector<ObservedRun> EverySecond(const Dataset& dataset,
                                     const std::vector<ObservedRun>& observed, std::size_t from);

// Whitened residuals; a channel that the model does not give (an empty one) counts zero. `rows`
// holds run.rows() numbers.
void Residuals(const Run& run, const ObservedRun& observed, const Reading& predicted,
               std::span<double> rows);
// The same linear map of derivatives. `slopes` are those of the pressure's mean readings on their
// grid, where there is one.
std::vector<double> GridSlopes(const Run& run, const ObservedRun& observed,
                               const Reading& predicted);
void Whitened(const ObservedRun& observed, const Reading& derivative,
              std::span<const double> slopes, std::span<double> rows);

// The likeliest noise behind the grid of the runs given, from what a fitted model predicts of them
// (by run); true where some is less than kHiddenLess of what was taken before, and is taken now.
inline constexpr double kHiddenLess = 0.8;
bool TakeHiddenNoise(const Dataset& dataset, const std::vector<std::size_t>& runs,
                     const std::vector<Reading>& predicted, std::vector<ObservedRun>& observed);

// Takes the pressure's noise for what a fit of `numbers` numbers leaves of the runs given, where
// that is less than kMuchLess of what the readings' differences showed: where readings are so few
// that the signal bends between them, the differences are the signal's. True where it was taken.
inline constexpr double kMuchLess = 0.5;
bool TakeNoiseOfFit(const Dataset& dataset, const std::vector<std::size_t>& runs,
                    const std::vector<Reading>& predicted, std::size_t numbers,
                    std::vector<ObservedRun>& observed);

// Leaves out pressure readings that are off a fitted model's prediction by more than kWildSigmas of
// the noise while their neighbours are off by less than a quarter of that: what the readings alone
// did not show as wild, at gaps and where strokes begin. Structure has neighbours; where more than
// kWildShare of a run's readings are off none is left out. True where any was.
inline constexpr double kWildSigmas = 8.0, kWildShare = 0.01;
bool LeaveOutWild(const Dataset& dataset, const std::vector<std::size_t>& runs,
                  const std::vector<Reading>& predicted, std::vector<ObservedRun>& observed);

// Measured − predicted pressure at every sample, NaN where not usable.
std::vector<double> PressureResidual(const Run& run, const ObservedRun& observed,
                                     const Reading& predicted);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_OBSERVATIONS_H_
