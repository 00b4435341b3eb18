// What a coarse grid does to a residual.
//
// A reading y on a grid of step q says that signal and noise lie in [y − q/2, y + q/2]. Where the
// noise is below q/2, reading less model is a sawtooth along the signal however good the model is.
// Given the model m and normal noise of deviation s, the reading is the grid value k·q with chance
// Φ((k·q + q/2 − m)/s) − Φ((k·q − q/2 − m)/s): that gives its mean μ(m) and variance v(m), and
//   e = (y − μ)/√v
// has mean 0, variance 1 and no memory if model and noise are right. s is the most likely one given
// the readings (so that a wrong model raises s). Readings that are all but sure, v < 0.02·q², tell
// nothing and become NaN: without noise all do, and only a model outside the intervals is seen.
//
// A fit compares μ(m) with the reading, which is on the grid:
//   μ(m) − m = q/π·Σ_k (−1)^k/k·exp(−2·(π·k·s/q)²)·sin(2π·k·m/q),
// the characteristic function's series (Widrow & Kollár, Quantization Noise (2008), chapter 6); s
// is taken at kLeastGridNoise at least, so that kHarmonics terms suffice and every reading tells.
#ifndef PLENUM_CALIBRATION_NOISE_ROUNDING_H_
#define PLENUM_CALIBRATION_NOISE_ROUNDING_H_

#include <array>
#include <span>
#include <vector>

namespace plenum::calibration {

inline constexpr double kLeastGridNoise = 0.12;  // of the quantum
inline constexpr int kHarmonics = 6;

class Grid {
 public:
  Grid() = default;  // none: shifts nothing
  Grid(double quantum, double noise);
  double quantum() const { return quantum_; }
  double noise() const { return noise_; }

  // μ(m) − m and dμ/dm. `off` is reading − model.
  struct Shift {
    double mean = 0.0, slope = 1.0;
  };
  Shift At(double off) const;

 private:
  double quantum_ = 0.0, noise_ = 0.0;
  std::array<double, kHarmonics> size_{};
  int harmonics_ = 0;  // that are more than rounding
};

// s of readings on a grid, of finite readings and models.
double LikeliestNoise(std::span<const double> readings, std::span<const double> model,
                      double quantum);

struct RoundedResidual {
  std::vector<double> e;
  double noise = 0.0;  // s, in the unit of the readings
};

// NaN readings stay NaN. q > 0.
RoundedResidual StandardiseRounded(std::span<const double> readings, std::span<const double> model,
                                   double quantum);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_ROUNDING_H_
