// Integrates a system with CVODE (SUNDIALS) until one of its guards turns: variable-order BDF with
// Newton iteration for stiff systems, or Adams; CVODE's own root finding and dense output. The same
// interface as ExplicitIntegrator: the second opinion in tests, and the way through stiff effects.
#ifndef PLENUM_MODEL_SIMULATE_CVODE_INTEGRATOR_H_
#define PLENUM_MODEL_SIMULATE_CVODE_INTEGRATOR_H_

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "model/simulate/explicit_integrator.h"
#include "model/simulate/simulate_system.h"

namespace plenum::model {

class CvodeIntegrator {
 public:
  CvodeIntegrator(System<double>& system, double relative_tolerance, double absolute_tolerance_pa);
  ~CvodeIntegrator();

  void Start(double t, std::span<const double> y, bool smooth);
  StepOutcome Step(double boundary);

  std::optional<std::size_t> event() const { return event_; }
  double start_time() const { return t0_; }
  double time() const { return t1_; }
  std::span<const double> state() const { return y1_; }
  std::span<const double> slope() const { return slope_; }
  void StateAt(double time_s, std::span<double> y);
  double Value(double theta, std::size_t i);
  double Slope(double theta, std::size_t i);  // per step
  double At(double theta, std::size_t i) { return Value(theta, i); }
  long long steps_at_stability() const { return 0; }
  long long steps_in_fast_modes() const { return 0; }

 private:
  struct Memory;
  System<double>& system_;
  double t0_ = 0.0, t1_ = 0.0;
  std::vector<double> y1_, slope_, dense_;
  std::optional<std::size_t> event_;
  std::unique_ptr<Memory> memory_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_CVODE_INTEGRATOR_H_
