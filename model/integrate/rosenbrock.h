// Linearly implicit Runge–Kutta method ROS34PW2 of order 3 for stiff systems, stiffly accurate and
// L-stable, with an embedded second-order error estimate and cubic dense output.
//
// Stages, with any approximation J of ∂f/∂y — a W-method keeps its order with a rough one:
//   (I − γ·h·J)·k_i = h·f(t + α_i·h, y + Σ_j α_ij·k_j) + h·J·Σ_j γ_ij·k_j + h²·γ_i·f_t,  j < i,
//   y₁ = y + Σ b_i·k_i,  γ_i = γ + Σ_j γ_ij.
// J and f_t ≈ ∂f/∂t are taken at the start of a step, by differences or, with dual numbers, from
// derivatives; they stay values, so that one factorisation serves the state and all its
// derivatives. Without f_t a fast mode that follows what moves by itself would hold the steps down.
//
// Source: Rang, Angermann, New Rosenbrock W-methods of order 3 for partial differential algebraic
// equations of index 1, BIT 45 (2005) 761; Hairer, Wanner, Solving Ordinary Differential
// Equations II, IV.7.
//
// The interface is that of DormandPrinceOf (dormand_prince.h).
#ifndef PLENUM_MODEL_INTEGRATE_ROSENBROCK_H_
#define PLENUM_MODEL_INTEGRATE_ROSENBROCK_H_

#include <Eigen/LU>
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
class RosenbrockOf {
 public:
  // Whether steps of any length leave at rest what rests.
  static constexpr bool kStable = true;
  using Outcome = StepResult;

  explicit RosenbrockOf(std::size_t size)
      : y0_(size), y1_(size), stage_(size), error_(size), f0_(size), f1_(size), slope_(size) {
    for (auto& k : k_) k.resize(size);
  }

  template <class Rhs>
  void Start(Rhs&& rhs, const T& t, std::span<const T> y, double step) {
    t1_ = t;
    std::copy(y.begin(), y.end(), y1_.begin());
    rhs(t, std::span<const T>(y1_), std::span<T>(f1_));
    control_.Start(step);
  }

  // Advances by one accepted step of at most `step_max`.
  template <class Rhs, class Norm>
  Outcome Step(Rhs&& rhs, const T& step_max, Norm&& norm) {
    t0_ = t1_;
    y0_.swap(y1_);
    f0_.swap(f1_);
    TakeJacobian(rhs, std::min(next_step(), ValueOf(step_max)));
    const auto error_of = [&](double h) {
      h_ = h == ValueOf(step_max) ? step_max : T(h);
      Stages(rhs);
      return norm(std::span<const T>(y0_), std::span<const T>(y1_), std::span<const T>(error_));
    };
    const Outcome outcome = control_.Take(ValueOf(t0_), ValueOf(step_max), error_of);
    if (outcome != Outcome::kNotFinite) End(rhs);
    return outcome;
  }

  // Takes the last step again up to a share `theta` of it, without a new estimate of the error.
  template <class Rhs>
  void Shorten(Rhs&& rhs, double theta) {
    h_ = T(theta * ValueOf(h_));
    Stages(rhs);
    End(rhs);
  }

  // Moves the end of the last step by a small time along the slope there. A new Start must follow.
  void MoveEnd(const T& shift) {
    for (std::size_t i = 0; i < y1_.size(); ++i) y1_[i] += shift * f1_[i];
    t1_ += shift;
  }

  double StiffnessOfStep() const { return 0.0; }  // stability never holds it down

  const T& start_time() const { return t0_; }
  const T& time() const { return t1_; }
  const T& step() const { return h_; }
  double next_step() const { return control_.next_step(); }
  void set_next_step(double step) { control_.set_next_step(step); }
  std::span<const T> state() const { return y1_; }
  std::span<const T> derivative() const { return f1_; }

  // Cubic through both ends and their slopes, at t = start_time() + θ·step(), θ in [0, 1].
  T At(const T& theta, std::size_t i) const {
    const T rest = 1.0 - theta;
    const T difference = y1_[i] - y0_[i];
    return rest * y0_[i] + theta * y1_[i] -
           theta * rest * (rest * (difference - h_ * f0_[i]) - theta * (difference - h_ * f1_[i]));
  }
  // Its derivative with respect to θ.
  T SlopeAt(const T& theta, std::size_t i) const {
    const T rest = 1.0 - theta;
    const T difference = y1_[i] - y0_[i];
    const T a = difference - h_ * f0_[i], b = difference - h_ * f1_[i];
    return difference - (1.0 - 2.0 * theta) * (rest * a - theta * b) + theta * rest * (a + b);
  }

 private:
  static constexpr double kGamma = 0.435866521508459;
  static constexpr double kDifference = 1e-7;  // of a state's size
  static constexpr double kLater = 1e-4;       // of a step

  // How large state j is, or what it moves by in a step.
  double SizeOf(std::size_t j, double step_s) const {
    double largest = 0.0;
    for (const T& y : y0_) largest = std::max(largest, std::abs(ValueOf(y)));
    return std::max(
        {std::abs(ValueOf(y0_[j])), std::abs(ValueOf(f0_[j])) * step_s, 1e-12 * largest, 1e-12});
  }

  // `step_s`: the longest that is next; within it f has no kink in time.
  template <class Rhs>
  void TakeJacobian(Rhs&& rhs, double step_s) {
    const auto size = static_cast<Eigen::Index>(y0_.size());
    jacobian_.resize(size, size + 1);
    std::copy(y0_.begin(), y0_.end(), stage_.begin());
    if constexpr (kIsDual<T>) {
      for (std::size_t first = 0; first <= y0_.size(); first += kDirectionsOf<T>)
        TakeColumns(rhs, step_s, first,
                    std::min<std::size_t>(kDirectionsOf<T>, y0_.size() + 1 - first));
    } else {
      const auto take = [&](double t, std::size_t j, double moved) {
        rhs(t, std::span<const T>(stage_), std::span<T>(slope_));
        for (std::size_t i = 0; i < y0_.size(); ++i) Entry(i, j) = (slope_[i] - f0_[i]) / moved;
      };
      for (std::size_t j = 0; j < y0_.size(); ++j) {
        // Against the motion: what flows towards equal pressures would be shut beyond them.
        const double by = kDifference * SizeOf(j, step_s);
        stage_[j] = y0_[j] + (f0_[j] < 0.0 ? by : -by);
        take(t0_, j, stage_[j] - y0_[j]);
        stage_[j] = y0_[j];
      }
      const double later = t0_ + kLater * step_s;
      if (later > t0_) {
        take(later, y0_.size(), later - t0_);
      } else {
        jacobian_.col(size).setZero();
      }
    }
  }

  // Derivatives are linear in those of the state and of the time: along each direction another of
  // them moves by `by` more. Of the size of what the direction moves already, so that little is
  // lost in the difference.
  template <class Rhs>
  void TakeColumns(Rhs&& rhs, double step_s, std::size_t first, std::size_t count) {
    std::copy(y0_.begin(), y0_.end(), stage_.begin());
    T time = t0_;
    std::array<double, kDirectionsOf<T>> by{};
    for (std::size_t k = 0; k < count; ++k) {
      const auto direction = static_cast<Eigen::Index>(k);
      double share = 1.0;
      for (std::size_t i = 0; i < y0_.size(); ++i) {
        const double moves = std::abs(y0_[i].v[direction]) + step_s * std::abs(f0_[i].v[direction]);
        share = std::max(share, moves / SizeOf(i, step_s));
      }
      const bool of_state = first + k < y0_.size();
      by[k] = share * (of_state ? SizeOf(first + k, step_s) : step_s);
      (of_state ? stage_[first + k] : time).v[direction] += by[k];
    }
    rhs(time, std::span<const T>(stage_), std::span<T>(slope_));
    for (std::size_t i = 0; i < y0_.size(); ++i)
      for (std::size_t k = 0; k < count; ++k) {
        const auto direction = static_cast<Eigen::Index>(k);
        Entry(i, first + k) = (slope_[i].v[direction] - f0_[i].v[direction]) / by[k];
      }
  }

  // ∂f_i/∂y_j; with j one beyond the last state ∂f_i/∂t.
  double& Entry(std::size_t i, std::size_t j) {
    return jacobian_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  }

  template <class Rhs>
  void Stages(Rhs&& rhs) {
    static constexpr double kAlpha[4][3] = {
        {}, {0.871733043016918}, {0.8445706001536942, -0.1129906423648419}, {0.0, 0.0, 1.0}};
    static constexpr double kCoupling[4][3] = {
        {},
        {-0.871733043016918},
        {-0.9033805701304408, 0.05418067238809533},
        {0.24212380706095346, -1.2232505839045147, 0.5452602553351021}};
    static constexpr std::array<double, 4> kB = {0.24212380706095346, -1.2232505839045147,
                                                 1.545260255335102, 0.435866521508459};
    static constexpr std::array<double, 4> kEmbedded = {0.3781090314581937, -0.09604229221242318,
                                                        0.5, 0.2179332607542295};
    const auto size = jacobian_.rows();
    const double h = ValueOf(h_);
    lu_.compute(Eigen::MatrixXd::Identity(size, size) - kGamma * h * jacobian_.leftCols(size));
    for (std::size_t s = 0; s < 4; ++s) {
      double alpha = 0.0, gamma = kGamma;
      for (std::size_t j = 0; j < s; ++j) alpha += kAlpha[s][j], gamma += kCoupling[s][j];
      for (std::size_t i = 0; i < y0_.size(); ++i) {
        T sum = y0_[i];
        for (std::size_t j = 0; j < s; ++j)
          if (kAlpha[s][j] != 0.0) sum += kAlpha[s][j] * k_[j][i];
        stage_[i] = sum;
      }
      if (s == 0)
        slope_ = f0_;
      else
        rhs(t0_ + alpha * h_, std::span<const T>(stage_), std::span<T>(slope_));
      for (std::size_t i = 0; i < y0_.size(); ++i) {
        T sum(0.0);
        for (std::size_t j = 0; j < s; ++j) sum += kCoupling[s][j] * k_[j][i];
        stage_[i] = sum;
      }
      for (std::size_t i = 0; i < y0_.size(); ++i) {
        T sum = h_ * slope_[i] + T(h * h * gamma * Entry(i, y0_.size()));
        for (std::size_t j = 0; s > 0 && j < y0_.size(); ++j) {
          if (Entry(i, j) != 0.0) sum += h * Entry(i, j) * stage_[j];
        }
        k_[s][i] = sum;
      }
      Solve(k_[s]);
    }
    for (std::size_t i = 0; i < y0_.size(); ++i) {
      T sum = y0_[i], error(0.0);
      for (std::size_t s = 0; s < 4; ++s) {
        sum += kB[s] * k_[s][i];
        error += (kB[s] - kEmbedded[s]) * k_[s][i];
      }
      y1_[i] = sum, error_[i] = error;
    }
  }

  // x ← (I − γ·h·J)⁻¹·x, value and derivatives alike.
  void Solve(std::vector<T>& x) {
    const auto& factors = lu_.matrixLU();
    const auto& place = lu_.permutationP().indices();
    const auto size = factors.rows();
    const auto at = [&](Eigen::Index i) -> T& { return stage_[static_cast<std::size_t>(i)]; };
    for (Eigen::Index i = 0; i < size; ++i) at(place[i]) = x[static_cast<std::size_t>(i)];
    for (Eigen::Index i = 1; i < size; ++i) {
      T rest = at(i);
      for (Eigen::Index j = 0; j < i; ++j) rest -= factors(i, j) * at(j);
      at(i) = rest;
    }
    for (Eigen::Index i = size - 1; i >= 0; --i) {
      T rest = at(i);
      for (Eigen::Index j = i + 1; j < size; ++j) rest -= factors(i, j) * at(j);
      at(i) = rest / factors(i, i);
    }
    x.swap(stage_);
  }

  template <class Rhs>
  void End(Rhs&& rhs) {
    t1_ = t0_ + h_;
    rhs(t1_, std::span<const T>(y1_), std::span<T>(f1_));
  }

  T t0_ = T(0.0), t1_ = T(0.0), h_ = T(0.0);
  StepControl control_{{.exponent = 1.0 / 3.0, .memory = 0.0, .growth_max = 6.0}};
  std::vector<T> y0_, y1_, stage_, error_, f0_, f1_, slope_;
  std::array<std::vector<T>, 4> k_;
  Eigen::MatrixXd jacobian_;  // ∂f/∂y, ∂f/∂t
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_ROSENBROCK_H_
