// How much of a run is noise, from its readings alone: no model is asked.
//
// Noise is seen through third differences. For samples at t_0 … t_3 the divided difference
// z = Σ c_i·y_i with c_i ∝ 1/Π_{j≠i}(t_i − t_j) and Σ c_i² = 1 cancels any parabola, so that on a
// smooth signal E z² = Σ c_i·c_j·γ(|t_i − t_j|), which is σ² for white noise, at any spacing. The
// windows are taken where the signal is quiet; samples of one instant enter as differences of
// pairs. What the noise remembers is read by likelihood (quiet_memory.h), and σ with it. Readings
// on a grid of step q carry q²/12 of their own (Widrow); where the other noise is below about q/2
// the differences of a staircase tell nothing, and q²/12 is the least that is reported. Where the
// sensor's range is stated its ends are not guessed, and its resolution is the least that q is.
//
// The relative standard error of σ from n windows is 1.07/√n: 5 % needs 450. Noise that depends on
// the pressure is seen at the quiet places alone. Sources: Gasser, Sroka & Jennen-Steinmetz,
// Biometrika 73 (1986) 625; Widrow & Kollár, Quantization Noise (2008).
#ifndef PLENUM_CALIBRATION_NOISE_NOISE_H_
#define PLENUM_CALIBRATION_NOISE_NOISE_H_

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "calibration/noise/noise_memory.h"
#include "calibration/noise/readings.h"
#include "calibration/values/dataset.h"

namespace plenum::calibration {

// Where the windows lay: closed valve; the second half of each stroke; everywhere; overlaid samples
// alone. kNone: fewer than four usable readings, all numbers are NaN.
enum class NoiseSource { kNone, kClosed, kTail, kWhole, kRepeats };

struct Noise {
  double sigma_pa = std::numeric_limits<double>::quiet_NaN();  // of one reading, quantum included
  double relative_error = std::numeric_limits<double>::quiet_NaN();  // standard error of σ over σ
  double quantum_pa = 0.0;  // step of the readings' grid; 0: none found
  bool staircase = false;   // noise below half a quantum: errors are sawtooth, not random
  NoiseMemory memory;       // θ = 0: not told from white noise
  double spacing_s = 0.0;   // median Δt between instants
  // What else the memory may be (quiet_memory.h); empty: it is known.
  std::vector<NoiseMemory> memories;
  double effective_samples = 0.0;  // n/(1 + 2·s·ρ/(1−ρ)) of the n usable readings
  double repeat_sigma_pa = std::numeric_limits<double>::quiet_NaN();  // pooled over overlaid
                                                                      // samples, NaN without
  int repeat_freedom = 0;  // Σ (samples of an instant − 1)
  NoiseSource source = NoiseSource::kNone;
  int windows = 0;
  std::vector<std::size_t> outliers;  // single readings off both neighbours' trends by more than
                                      // 6 σ; left out of σ
  std::vector<std::size_t> clipped;   // at an end of the sensor's range
  // These and all whose neighbours' median comes within 4 σ of that end: noise is cut off there,
  // and what is left is biased. Left out of σ.
  std::vector<std::size_t> near_end;
  // The ends of the range, as far as clipped readings show them.
  double clip_low_pa = -std::numeric_limits<double>::infinity();
  double clip_high_pa = std::numeric_limits<double>::infinity();
};

// Standard deviation of the rounding, to the readings' grid or the sensor's stated resolution.
double RoundingPa(const Noise& noise, const Sensor& sensor);

Noise EstimateNoise(const Readings& readings);

// Of runs recorded with one sensor: σ of each, the ends of its range and the noise's memory from
// all of them together. Their differences are pooled, because what is left of a slight correlation
// in one run is lost in its scatter.
std::vector<Noise> EstimateNoise(std::span<const Readings> all);

// A run's pressure readings: quiet is a closed valve. The run must outlive them.
Readings ReadingsOf(const Run& run);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_NOISE_H_
