// Explicit Runge–Kutta method of Dormand and Prince, order 5 with an embedded fourth-order error
// estimate, first-same-as-last, PI step control and dense output of order 4.
//
// Source: Dormand, Prince, J. Comput. Appl. Math. 6 (1980); dense output and step control of
// Hairer, Nørsett, Wanner, Solving Ordinary Differential Equations I, II.5 and II.6.
//
//   DormandPrince stepper(size);
//   stepper.Start(rhs, t, y, step);             // rhs(t, y, dydt) with spans
//   while (…) stepper.Step(rhs, step_max, norm);  // norm(y0, y1, error) ≤ 1 accepts
//
// Memory is taken once, by the constructor. A norm that is not finite counts as a rejection. With
// T = Dual time and state carry derivatives; the norm sees them, too.
#ifndef PLENUM_MODEL_INTEGRATE_DORMAND_PRINCE_H_
#define PLENUM_MODEL_INTEGRATE_DORMAND_PRINCE_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "model/flow/scalar.h"
#include "model/integrate/step_control.h"

namespace plenum::model {

template <class T>
class DormandPrinceOf {
 public:
  // Whether steps of any length leave at rest what rests.
  static constexpr bool kStable = false;

  using Outcome = StepResult;

  explicit DormandPrinceOf(std::size_t size) : y0_(size), y1_(size), stage_(size), error_(size) {
    for (auto& k : k_) k.resize(size);
    for (auto& r : dense_) r.resize(size);
  }

  // Sets the state and evaluates the derivative there: at the start and after any change of rhs.
  template <class Rhs>
  void Start(Rhs&& rhs, const T& t, std::span<const T> y, double step) {
    t1_ = t;
    std::copy(y.begin(), y.end(), y1_.begin());
    rhs(t, std::span<const T>(y1_), std::span<T>(k_[6]));
    control_.Start(step);
  }

  // Advances by one accepted step of at most `step_max`.
  template <class Rhs, class Norm>
  Outcome Step(Rhs&& rhs, const T& step_max, Norm&& norm) {
    t0_ = t1_;
    y0_.swap(y1_);
    k_[0].swap(k_[6]);
    const auto error_of = [&](double h) {
      h_ = h == ValueOf(step_max) ? step_max : T(h);
      Stages(rhs);
      return norm(std::span<const T>(y0_), std::span<const T>(y1_), std::span<const T>(error_));
    };
    const Outcome outcome = control_.Take(ValueOf(t0_), ValueOf(step_max), error_of);
    if (outcome == Outcome::kNotFinite) return outcome;
    t1_ = t0_ + h_;
    MakeDense();
    return outcome;
  }

  // Takes the last step again up to a share `theta` of it, without a new estimate of the error.
  template <class Rhs>
  void Shorten(Rhs&& rhs, double theta) {
    h_ = T(theta * ValueOf(h_));
    Stages(rhs);
    t1_ = t0_ + h_;
    MakeDense();
  }

  // Moves the end of the last step by a small time along the slope there. A new Start must follow.
  void MoveEnd(const T& shift) {
    for (std::size_t i = 0; i < y1_.size(); ++i) y1_[i] += shift * k_[6][i];
    t1_ += shift;
  }

  // |λ|·h of the fastest mode seen in the last two stages; above 3.3 the step was held down by
  // stability (Hairer, Wanner, Solving Ordinary Differential Equations II, IV.2).
  double StiffnessOfStep() const {
    double slopes = 0.0, states = 0.0;
    for (std::size_t i = 0; i < y1_.size(); ++i) {
      const double size = 1.0 / std::max(1e-300, std::abs(ValueOf(y1_[i])));
      slopes += std::pow(size * (ValueOf(k_[6][i]) - ValueOf(k_[5][i])), 2);
      states += std::pow(size * (ValueOf(y1_[i]) - ValueOf(stage_[i])), 2);
    }
    return states > 0.0 ? std::abs(ValueOf(h_)) * std::sqrt(slopes / states) : 0.0;
  }

  const T& start_time() const { return t0_; }
  const T& time() const { return t1_; }
  const T& step() const { return h_; }
  double next_step() const { return control_.next_step(); }
  void set_next_step(double step) { control_.set_next_step(step); }
  std::span<const T> state() const { return y1_; }
  std::span<const T> derivative() const { return k_[6]; }

  // Dense output of the last step at t = start_time() + θ·step(), θ in [0, 1].
  T At(const T& theta, std::size_t i) const {
    const T rest = 1.0 - theta;
    return dense_[0][i] +
           theta * (dense_[1][i] +
                    rest * (dense_[2][i] + theta * (dense_[3][i] + rest * dense_[4][i])));
  }
  // Its derivative with respect to θ.
  T SlopeAt(const T& theta, std::size_t i) const {
    const T rest = 1.0 - theta;
    return dense_[1][i] + (1.0 - 2.0 * theta) * dense_[2][i] +
           theta * (2.0 - 3.0 * theta) * dense_[3][i] +
           2.0 * theta * rest * (1.0 - 2.0 * theta) * dense_[4][i];
  }

 private:
  static constexpr double kMemory = 0.04;

  template <class Rhs>
  void Stages(Rhs&& rhs) {
    static constexpr std::array<double, 7> kC = {0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1, 1};
    static constexpr double kA[7][6] = {
        {},
        {1.0 / 5},
        {3.0 / 40, 9.0 / 40},
        {44.0 / 45, -56.0 / 15, 32.0 / 9},
        {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
        {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
        {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84}};
    static constexpr std::array<double, 7> kE = {
        71.0 / 57600, 0.0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
    for (std::size_t s = 1; s < 7; ++s) {
      std::vector<T>& y = s == 6 ? y1_ : stage_;
      for (std::size_t i = 0; i < y.size(); ++i) {
        T sum = kA[s][0] * k_[0][i];
        for (std::size_t j = 1; j < s; ++j) {
          if (kA[s][j] != 0.0) sum += kA[s][j] * k_[j][i];
        }
        y[i] = y0_[i] + h_ * sum;
      }
      rhs(t0_ + kC[s] * h_, std::span<const T>(y), std::span<T>(k_[s]));
    }
    for (std::size_t i = 0; i < error_.size(); ++i) {
      T sum = kE[0] * k_[0][i];
      for (std::size_t j = 2; j < 7; ++j) sum += kE[j] * k_[j][i];
      error_[i] = h_ * sum;
    }
  }

  void MakeDense() {
    static constexpr std::array<double, 7> kD = {
        -12715105075.0 / 11282082432.0,  0.0,
        87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
        701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
        69997945.0 / 29380423.0};
    for (std::size_t i = 0; i < y0_.size(); ++i) {
      const T difference = y1_[i] - y0_[i];
      const T bend = h_ * k_[0][i] - difference;
      T sum = kD[0] * k_[0][i];
      for (std::size_t j = 2; j < 7; ++j) sum += kD[j] * k_[j][i];
      dense_[0][i] = y0_[i];
      dense_[1][i] = difference;
      dense_[2][i] = bend;
      dense_[3][i] = difference - h_ * k_[6][i] - bend;
      dense_[4][i] = h_ * sum;
    }
  }

  T t0_ = T(0.0), t1_ = T(0.0), h_ = T(0.0);
  StepControl control_{{.exponent = 0.2 - 0.75 * kMemory, .memory = kMemory, .growth_max = 10.0}};
  std::vector<T> y0_, y1_, stage_, error_;
  std::array<std::vector<T>, 7> k_;
  std::array<std::vector<T>, 5> dense_;
};

using DormandPrince = DormandPrinceOf<double>;

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_DORMAND_PRINCE_H_
