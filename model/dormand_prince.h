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
// Memory is taken once, by the constructor. A norm that is not finite counts as a rejection.
#ifndef PLENUM_MODEL_DORMAND_PRINCE_H_
#define PLENUM_MODEL_DORMAND_PRINCE_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace plenum::model {

class DormandPrince {
 public:
  // kTooSmall: the step was accepted at the smallest size that moves t although its error is above
  // tolerance; kNotFinite: even then the result is not finite, and nothing was accepted.
  enum class Outcome { kAccepted, kTooSmall, kNotFinite };

  explicit DormandPrince(std::size_t size) : y0_(size), y1_(size), stage_(size), error_(size) {
    for (auto& k : k_) k.resize(size);
    for (auto& r : dense_) r.resize(size);
  }

  // Sets the state and evaluates the derivative there: at the start and after any change of rhs.
  template <class Rhs>
  void Start(Rhs&& rhs, double t, std::span<const double> y, double step) {
    t1_ = t;
    std::copy(y.begin(), y.end(), y1_.begin());
    rhs(t, std::span<const double>(y1_), std::span<double>(k_[6]));
    next_step_ = step;
    old_error_ = 1e-4;
  }

  // Advances by one accepted step of at most `step_max`.
  template <class Rhs, class Norm>
  Outcome Step(Rhs&& rhs, double step_max, Norm&& norm) {
    t0_ = t1_;
    y0_.swap(y1_);
    k_[0].swap(k_[6]);
    double h = std::min(next_step_, step_max);
    const double h_smallest = std::min(step_max, 16.0 * kEpsilon * std::max(std::abs(t0_), 1e-9));
    for (bool rejected = false;; rejected = true) {
      Stages(rhs, h);
      const double error = norm(std::span<const double>(y0_), std::span<const double>(y1_),
                                std::span<const double>(error_));
      const bool smallest = h <= h_smallest;
      if (error <= 1.0 || (smallest && std::isfinite(error))) {
        const double bounded = std::max(error, 1e-10);
        const double factor =
            kSafety * std::pow(bounded, -kExponent) * std::pow(old_error_, kMemory);
        next_step_ = h * std::clamp(factor, 0.2, rejected ? 1.0 : 10.0);
        // A step cut short by step_max says nothing against the longer one.
        if (error <= 1.0 && h == step_max) next_step_ = std::max(next_step_, h);
        old_error_ = std::max(error, 1e-4);
        h_ = h;
        t1_ = t0_ + h;
        MakeDense();
        return error <= 1.0 ? Outcome::kAccepted : Outcome::kTooSmall;
      }
      if (smallest) return Outcome::kNotFinite;
      const double factor = std::isfinite(error) ? kSafety * std::pow(error, -kExponent) : 0.1;
      h = std::max(h_smallest, h * std::clamp(factor, 0.1, 0.9));
    }
  }

  double start_time() const { return t0_; }
  double time() const { return t1_; }
  double step() const { return h_; }
  double next_step() const { return next_step_; }
  std::span<const double> start_state() const { return y0_; }
  std::span<const double> state() const { return y1_; }
  std::span<const double> derivative() const { return k_[6]; }
  std::span<const double> start_derivative() const { return k_[0]; }

  // Dense output of the last step at t = start_time() + θ·step(), θ in [0, 1].
  double At(double theta, std::size_t i) const {
    const double rest = 1.0 - theta;
    return dense_[0][i] +
           theta * (dense_[1][i] +
                    rest * (dense_[2][i] + theta * (dense_[3][i] + rest * dense_[4][i])));
  }
  // Its derivative with respect to θ.
  double SlopeAt(double theta, std::size_t i) const {
    const double rest = 1.0 - theta;
    return dense_[1][i] + (1.0 - 2.0 * theta) * dense_[2][i] +
           theta * (2.0 - 3.0 * theta) * dense_[3][i] +
           2.0 * theta * rest * (1.0 - 2.0 * theta) * dense_[4][i];
  }

 private:
  static constexpr double kEpsilon = 2.220446049250313e-16;
  static constexpr double kSafety = 0.9;
  static constexpr double kMemory = 0.04;
  static constexpr double kExponent = 0.2 - 0.75 * kMemory;

  template <class Rhs>
  void Stages(Rhs&& rhs, double h) {
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
      std::vector<double>& y = s == 6 ? y1_ : stage_;
      for (std::size_t i = 0; i < y.size(); ++i) {
        double sum = 0.0;
        for (std::size_t j = 0; j < s; ++j) sum += kA[s][j] * k_[j][i];
        y[i] = y0_[i] + h * sum;
      }
      rhs(t0_ + kC[s] * h, std::span<const double>(y), std::span<double>(k_[s]));
    }
    for (std::size_t i = 0; i < error_.size(); ++i) {
      double sum = 0.0;
      for (std::size_t j = 0; j < 7; ++j) sum += kE[j] * k_[j][i];
      error_[i] = h * sum;
    }
  }

  void MakeDense() {
    static constexpr std::array<double, 7> kD = {
        -12715105075.0 / 11282082432.0,  0.0,
        87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
        701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
        69997945.0 / 29380423.0};
    for (std::size_t i = 0; i < y0_.size(); ++i) {
      const double difference = y1_[i] - y0_[i];
      const double bend = h_ * k_[0][i] - difference;
      double sum = 0.0;
      for (std::size_t j = 0; j < 7; ++j) sum += kD[j] * k_[j][i];
      dense_[0][i] = y0_[i];
      dense_[1][i] = difference;
      dense_[2][i] = bend;
      dense_[3][i] = difference - h_ * k_[6][i] - bend;
      dense_[4][i] = h_ * sum;
    }
  }

  double t0_ = 0.0, t1_ = 0.0, h_ = 0.0, next_step_ = 0.0, old_error_ = 1e-4;
  std::vector<double> y0_, y1_, stage_, error_;
  std::array<std::vector<double>, 7> k_;
  std::array<std::vector<double>, 5> dense_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_DORMAND_PRINCE_H_
