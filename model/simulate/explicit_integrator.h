// Integrates a system with a one-step method until one of its guards turns: Dormand–Prince 5(4), or
// a linearly implicit method where the equations are stiff.
#ifndef PLENUM_MODEL_SIMULATE_EXPLICIT_INTEGRATOR_H_
#define PLENUM_MODEL_SIMULATE_EXPLICIT_INTEGRATOR_H_

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "model/integrate/dormand_prince.h"
#include "model/integrate/rosenbrock.h"
#include "model/integrate/simulate_root.h"
#include "model/simulate/simulate_system.h"

namespace plenum::model {

enum class StepOutcome { kTaken, kNotFinite };

template <class T, class Stepper>
class OneStepIntegrator {
 public:
  OneStepIntegrator(System<T>& system, double relative_tolerance, double absolute_tolerance_pa)
      : system_(system),
        rtol_(relative_tolerance),
        atol_pa_(absolute_tolerance_pa),
        stepper_(system.size()),
        trial_(system.size()) {
    if constexpr (kIsDual<T>) largest_.resize(system.size(), Derivatives::Zero());
  }

  // Takes up the state after a switch, or after a cut that changes nothing at once (`smooth`).
  void Start(const T& t, std::span<const T> y, bool smooth) {
    stepper_.Start(system_, t, y, stepper_.next_step());
    if (!smooth) stepper_.set_next_step(FirstStep());
    if constexpr (kIsDual<T>) NoteDerivatives();
    Guards(t, y, before_);
  }

  // One step, to `boundary` at most. It ends where the first guard turns.
  StepOutcome Step(const T& boundary) {
    event_.reset();
    const auto outcome = stepper_.Step(
        system_, boundary - stepper_.time(),
        [&](auto before, auto after, auto error) { return Norm(before, after, error); });
    if (outcome == Stepper::Outcome::kNotFinite) return StepOutcome::kNotFinite;
    if constexpr (kIsDual<T>) NoteDerivatives();
    const double stiffness = stepper_.StiffnessOfStep();
    if (stiffness > kStabilityBound) ++steps_at_stability_;
    if (stiffness > kFastMode) ++steps_in_fast_modes_;
    Guards(stepper_.time(), stepper_.state(), after_);
    const double theta = FirstTurn();
    if (event_) EndAtEvent(theta);
    before_.swap(after_);
    return StepOutcome::kTaken;
  }

  // The guard that ended the last step.
  std::optional<std::size_t> event() const { return event_; }

  const T& start_time() const { return stepper_.start_time(); }
  const T& time() const { return stepper_.time(); }
  std::span<const T> state() const { return stepper_.state(); }
  std::span<const T> slope() const { return stepper_.derivative(); }

  // Inside the last step.
  void StateAt(double time_s, std::span<T> y) {
    const T theta = (time_s - stepper_.start_time()) / stepper_.step();
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = stepper_.At(theta, i);
  }
  double Value(double theta, std::size_t i) { return ValueOf(stepper_.At(T(theta), i)); }
  double Slope(double theta, std::size_t i) { return ValueOf(stepper_.SlopeAt(T(theta), i)); }
  T At(double theta, std::size_t i) { return stepper_.At(T(theta), i); }

  long long steps_at_stability() const { return steps_at_stability_; }
  // Among them those through which a fast mode rings or has rung out.
  long long steps_in_fast_modes() const { return steps_in_fast_modes_; }

 private:
  static constexpr double kThetaTolerance = 1e-14;
  static constexpr double kStabilityBound = 3.25;  // on the real axis
  static constexpr double kFastMode = 0.6;         // a radian of a ringing one is about the bound

  // Values at rest ask for no step, however long, and values that move slowly for long ones:
  // derivatives would then grow beyond the bound of an explicit method's stability, with nothing in
  // the values to tell. So much a step may err by, as a share of the largest so far; less where
  // the values rest, since then they alone choose the steps.
  static constexpr double kAtRest = 1e-4;
  static constexpr double kDerivativeShare = 1e-2, kDerivativeShareAtRest = 1e-4;
  // Below this share of what moves most along a direction, each by its size, derivatives are
  // rounding: no step, however short, makes their errors smaller.
  static constexpr double kRounding = 1e-9;

  double Norm(std::span<const T> before, std::span<const T> after, std::span<const T> error) const {
    double norm = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const double size = std::max(std::abs(ValueOf(before[i])), std::abs(ValueOf(after[i])));
      const double allowed = Stepper::kStable ? system_.room(i) : 1.0;
      const double share = std::abs(ValueOf(error[i])) /
                           (allowed * ErrorBound(size, system_.sizes()[i], rtol_, atol_pa_));
      if (!std::isfinite(share)) return std::numeric_limits<double>::infinity();
      norm = std::max(norm, share);
    }
    if constexpr (kIsDual<T> && !Stepper::kStable) {
      const double share = norm < kAtRest ? kDerivativeShareAtRest : kDerivativeShare;
      norm = std::max(norm, DerivativeNorm(error) / share);
    }
    return norm;
  }

  // The largest error of a derivative, as a share of the largest so far.
  double DerivativeNorm(std::span<const T> error) const {
    Derivatives moves = Derivatives::Zero();
    for (std::size_t i = 0; i < error.size(); ++i) moves = moves.cwiseMax(largest_[i] / Size(i));
    double norm = 0.0;
    for (std::size_t i = 0; i < error.size(); ++i) {
      const Derivatives size = largest_[i].cwiseMax(kRounding * Size(i) * moves);
      for (int k = 0; k < kDirectionsOf<T>; ++k)
        if (largest_[i][k] > 0.0) norm = std::max(norm, std::abs(error[i].v[k]) / size[k]);
    }
    return norm;
  }

  double Size(std::size_t i) const {
    return std::max(std::abs(ValueOf(stepper_.state()[i])), system_.sizes()[i]);
  }

  void NoteDerivatives() {
    for (std::size_t i = 0; i < largest_.size(); ++i)
      largest_[i] = largest_[i].cwiseMax(stepper_.state()[i].v.cwiseAbs());
  }

  // So short that no state moves by more than a hundredth of its size.
  double FirstStep() const {
    double step_s = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < system_.dynamic_size(); ++i) {
      const double slope = std::abs(ValueOf(stepper_.derivative()[i]));
      const double size = Size(i);
      if (slope > 0.0) step_s = std::min(step_s, 1e-2 * size / slope);
    }
    return step_s;
  }

  void Guards(const T& t, std::span<const T> y, std::vector<T>& values) {
    values.resize(system_.guards().size());
    system_.GuardValues(t, y, values);
  }

  double GuardAt(std::size_t k, double theta) {
    for (std::size_t i = 0; i < trial_.size(); ++i) trial_[i] = stepper_.At(T(theta), i);
    Guards(stepper_.start_time() + theta * stepper_.step(), trial_, during_);
    return ValueOf(during_[k]);
  }

  // Share of the step at which the first guard turns, which becomes the event. A guard that was not
  // yet positive at the start (the step began where it turned) counts if it was in between.
  double FirstTurn() {
    double first = 2.0;
    for (std::size_t k = 0; k < after_.size(); ++k) {
      const double end = ValueOf(after_[k]);
      if (end > 0.0) continue;
      double start_theta = 0.0;
      double start = ValueOf(before_[k]);
      if (!(start > 0.0)) {
        start_theta = 0.5;
        start = GuardAt(k, 0.5);
        const GuardKind kind = system_.guards()[k].kind;
        const bool must_stop = kind == GuardKind::kPumpLimit || kind == GuardKind::kPumpDemand;
        if (!(start > 0.0)) {
          if (must_stop && end < 0.0 && first > 1.0) first = 1.0, event_ = k;
          continue;
        }
      }
      const double theta = RootBetween([&](double share) { return GuardAt(k, share); }, start_theta,
                                       start, 1.0, end, kThetaTolerance);
      if (theta < first) first = theta, event_ = k;
    }
    return first;
  }

  // Takes the step again up to the event, then one Newton step in time onto it, which also gives
  // the event's time its derivatives. A kink needs neither: nothing jumps there.
  void EndAtEvent(double theta) {
    const double h = 1e-4 * ValueOf(stepper_.step());
    if (theta < 1.0) stepper_.Shorten(system_, std::max(theta, 1e-12));
    Guards(stepper_.time(), stepper_.state(), after_);
    if (system_.guards()[*event_].kind == GuardKind::kKink) return;
    const auto moved = [&](double shift) {
      for (std::size_t i = 0; i < trial_.size(); ++i) {
        trial_[i] = stepper_.state()[i] + shift * stepper_.derivative()[i];
      }
      Guards(stepper_.time() + shift, trial_, during_);
      return ValueOf(during_[*event_]);
    };
    const double rate = (moved(h) - moved(-h)) / (2.0 * h);
    T shift = -after_[*event_] / rate;
    if (!std::isfinite(ValueOf(shift))) return;
    // After a step as short as rounding the time is as good as it gets; its derivatives still move.
    if (std::abs(ValueOf(shift)) >= ValueOf(stepper_.step())) shift -= ValueOf(shift);
    stepper_.MoveEnd(shift);
  }

  using Derivatives = Eigen::Matrix<double, kDirectionsOf<T>, 1>;

  System<T>& system_;
  double rtol_, atol_pa_;
  Stepper stepper_;
  std::optional<std::size_t> event_;
  std::vector<T> before_, after_, during_, trial_;
  std::vector<Derivatives> largest_;  // seen of each state, in size; of dual numbers only
  long long steps_at_stability_ = 0, steps_in_fast_modes_ = 0;
};

template <class T>
using ExplicitIntegrator = OneStepIntegrator<T, DormandPrinceOf<T>>;
template <class T>
using ImplicitIntegrator = OneStepIntegrator<T, RosenbrockOf<T>>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_EXPLICIT_INTEGRATOR_H_
