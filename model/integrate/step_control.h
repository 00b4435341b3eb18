// Sizes of steps of an embedded one-step method, by PI control of its estimated errors:
//   h ← h·s·e^(−α)·e_old^β,  e the error of the step just taken, 1 what is allowed.
//
// Source: Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.4; Hairer, Wanner,
// Solving Ordinary Differential Equations II, IV.2.
#ifndef PLENUM_MODEL_INTEGRATE_STEP_CONTROL_H_
#define PLENUM_MODEL_INTEGRATE_STEP_CONTROL_H_

#include <algorithm>
#include <cmath>
#include <limits>

namespace plenum::model {

// kTooSmall: the step was accepted at the smallest size that moves t although its error is above
// tolerance; kNotFinite: even then the result is not finite, and nothing was accepted.
enum class StepResult { kAccepted, kTooSmall, kNotFinite };

class StepControl {
 public:
  // α, β and how much longer a step may be than the one before.
  struct Law {
    double exponent, memory, growth_max;
  };
  explicit StepControl(const Law& law) : law_(law) {}

  void Start(double step) { next_step_ = step, old_error_ = kErrorFloor; }
  double next_step() const { return next_step_; }
  void set_next_step(double step) { next_step_ = step; }

  // Tries steps of at most `h_max` from time t until one is accepted. `error_of(h)` makes the step
  // of size h and returns its error; one that is not finite counts as a rejection.
  template <class ErrorOf>
  StepResult Take(double t, double h_max, const ErrorOf& error_of) {
    constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
    double h = std::min(next_step_, h_max);
    const double h_smallest = std::min(h_max, 16.0 * kEpsilon * std::max(std::abs(t), 1e-9));
    for (bool rejected = false;; rejected = true) {
      const double error = error_of(h);
      const bool smallest = h <= h_smallest;
      if (error <= 1.0 || (smallest && std::isfinite(error))) {
        const double factor = kSafety * std::pow(std::max(error, 1e-10), -law_.exponent) *
                              std::pow(old_error_, law_.memory);
        next_step_ = h * std::clamp(factor, 0.2, rejected ? 1.0 : law_.growth_max);
        // A step cut short by h_max says nothing against the longer one.
        if (error <= 1.0 && h == h_max) next_step_ = std::max(next_step_, h);
        old_error_ = std::max(error, kErrorFloor);
        return error <= 1.0 ? StepResult::kAccepted : StepResult::kTooSmall;
      }
      if (smallest) return StepResult::kNotFinite;
      const double factor = std::isfinite(error) ? kSafety * std::pow(error, -law_.exponent) : 0.1;
      h = std::max(h_smallest, h * std::clamp(factor, 0.1, 0.9));
    }
  }

 private:
  static constexpr double kSafety = 0.9;
  static constexpr double kErrorFloor = 1e-4;
  Law law_;
  double next_step_ = 0.0, old_error_ = kErrorFloor;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_STEP_CONTROL_H_
