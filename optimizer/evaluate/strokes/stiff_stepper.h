// Explicit steps of order 5, and implicit ones where stability would hold those down: with the
// interface of DormandPrince (model/integrate/dormand_prince.h).
#ifndef PLENUM_OPTIMIZER_EVALUATE_STROKES_STIFF_STEPPER_H_
#define PLENUM_OPTIMIZER_EVALUATE_STROKES_STIFF_STEPPER_H_

#include <cstddef>
#include <span>

#include "model/integrate/dormand_prince.h"
#include "model/integrate/rosenbrock.h"

namespace plenum::optimizer {

// The rate λ, 1/s, at which what comes closer at this slope does so, less as it is nearer: the flow
// grows with the root of how far one is behind the other.
inline double ApproachRate(double slope_pa_per_s, double behind_pa) {
  return behind_pa > 0.0 ? slope_pa_per_s / (2.0 * behind_pa) : 0.0;
}
// Whether stability holds down an explicit step.
inline bool IsHeldDown(double step_s, double rate_per_s) {
  constexpr double kStable = 0.5;  // |λ|·h
  return rate_per_s * step_s > kStable;
}

class StiffStepper {
 public:
  explicit StiffStepper(std::size_t size) : explicit_(size), implicit_(size) {}

  template <class Rhs>
  void Start(const Rhs& rhs, double t, std::span<const double> y, double step_s) {
    stiff_ = false;
    held_down_ = 0;
    explicit_.Start(rhs, t, y, step_s);
  }
  template <class Rhs, class Norm>
  model::StepResult Step(const Rhs& rhs, double step_max_s, const Norm& norm) {
    return stiff_ ? implicit_.Step(rhs, step_max_s, norm) : explicit_.Step(rhs, step_max_s, norm);
  }
  bool stiff() const { return stiff_; }
  // Told after each step whether stability held it down: after so many in a row steps are implicit
  // until the next start.
  template <class Rhs>
  void CountHeldDown(bool held_down, const Rhs& rhs) {
    constexpr int kInARow = 15;
    held_down_ = held_down ? held_down_ + 1 : 0;
    if (stiff_ || held_down_ < kInARow) return;
    implicit_.Start(rhs, explicit_.time(), explicit_.state(), explicit_.next_step());
    stiff_ = true;
  }
  template <class Rhs>
  void Shorten(const Rhs& rhs, double share) {
    stiff_ ? implicit_.Shorten(rhs, share) : explicit_.Shorten(rhs, share);
  }
  double At(double share, std::size_t i) const {
    return stiff_ ? implicit_.At(share, i) : explicit_.At(share, i);
  }
  double start_time() const { return stiff_ ? implicit_.start_time() : explicit_.start_time(); }
  double time() const { return stiff_ ? implicit_.time() : explicit_.time(); }
  double step() const { return stiff_ ? implicit_.step() : explicit_.step(); }
  double next_step() const { return stiff_ ? implicit_.next_step() : explicit_.next_step(); }
  std::span<const double> state() const { return stiff_ ? implicit_.state() : explicit_.state(); }
  std::span<const double> derivative() const {
    return stiff_ ? implicit_.derivative() : explicit_.derivative();
  }

 private:
  model::DormandPrince explicit_;
  model::RosenbrockOf<double> implicit_;
  bool stiff_ = false;
  int held_down_ = 0;  // steps in a row
};

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EVALUATE_STROKES_STIFF_STEPPER_H_
