// What a fit compares with the model: the usable readings of each run, weighed by their noise.
//
// Sample i of a signal counts as r_i/σ, with r = model − measured. Noise that remembers is
// whitened (noise_memory.h) over the usable samples. Left out: missing, wild and clipped readings.
// A second channel supports the pressure; its σ is at least kChannelAccuracy of its range, because
// its sensor and its place are less certain than its noise.
#ifndef PLENUM_CALIBRATION_OBSERVATIONS_H_
#define PLENUM_CALIBRATION_OBSERVATIONS_H_

#include <cstddef>
#include <span>
#include <vector>

#include "calibration/forward.h"
#include "calibration/noise.h"

namespace plenum::calibration {

inline constexpr double kChannelAccuracy = 0.01;

struct ObservedSignal {
  std::vector<double> Channels::*channel = nullptr;  // null: the pressure
  std::vector<std::size_t> samples;                  // usable, by index into the run
  std::vector<Innovation> steps;                     // by usable sample
  double sigma = 1.0;
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

// Whitened residuals, and the same linear map of a derivative; a channel that the model does not
// give (an empty one) counts zero. `rows` holds run.rows() numbers.
void Residuals(const Run& run, const ObservedRun& observed, const Reading& predicted,
               std::span<double> rows);
void Whitened(const ObservedRun& observed, const Reading& derivative, std::span<double> rows);

// Measured − predicted pressure at every sample, NaN where not usable.
std::vector<double> PressureResidual(const Run& run, const ObservedRun& observed,
                                     const Reading& predicted);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_OBSERVATIONS_H_
