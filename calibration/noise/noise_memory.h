// Noise that remembers: a share s of its variance has the covariance exp(−|h|/θ), the rest is
// white.
//
// It is turned white by its Kalman filter, the innovations over their deviations,
//   û⁻ = ρ·û,  P⁻ = ρ²·P + s·(1 − ρ²),  S = P⁻ + 1 − s,  ẽ = (e − û⁻)/√S,
//   û = û⁻ + P⁻/S·(e − û⁻),  P = (1 − P⁻/S)·P⁻,  ρ = exp(−Δt/θ),
// which for s = 1 is (e_i − ρ_i·e_{i−1})/√(1 − ρ_i²). θ = 0 changes nothing. With s = 1 a second
// sample of one instant stays as it is.
#ifndef PLENUM_CALIBRATION_NOISE_NOISE_MEMORY_H_
#define PLENUM_CALIBRATION_NOISE_NOISE_MEMORY_H_

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace plenum::calibration {

struct NoiseMemory {
  double theta_s = 0.0;
  double share = 1.0;
};

// What the filter does at a sample: û⁻ is `carry` times the last û, ẽ = (e − û⁻)·scale, and
// û = û⁻ + gain·(e − û⁻).
struct Innovation {
  double carry = 0.0, gain = 1.0, scale = 1.0;
};

// The filter's steps along a series, one sample after the other; they do not depend on its values.
class InnovationSteps {
 public:
  explicit InnovationSteps(const NoiseMemory& memory) : memory_(memory), variance_(memory.share) {}
  Innovation Next(double t_s);

 private:
  NoiseMemory memory_;
  double variance_;  // P
  double last_s_ = -std::numeric_limits<double>::infinity();
  double gap_s_ = 0.0, carry_ = 0.0;  // of a step before: most gaps are alike
};

// ẽ of a series in units of its noise; NaN is passed over.
std::vector<double> Whitened(std::span<const double> t_s, std::span<const double> e,
                             const NoiseMemory& memory);

// E z² of third differences (noise.h) of even samples over σ²; ρ is that of neighbours.
double ThirdDifference(double rho, double share);

// A series in units of its noise, NaN where missing.
struct NoiseSeries {
  std::span<const double> t_s;
  std::span<const double> e;
};

// The likeliest memory of series of one sensor: of those allowed, and then about that one, within a
// factor 1.3 of θ and 0.1 of the share. θ = 0 where none is allowed, and any where `cancelled` says
// that nobody wants to know.
NoiseMemory LikeliestMemory(std::span<const NoiseSeries> series,
                            std::span<const NoiseMemory> allowed,
                            const std::function<bool()>& cancelled = {});

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_NOISE_NOISE_MEMORY_H_
