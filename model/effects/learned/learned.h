// Terms learned from what no known effect accounts for, each inside one equation, so that the rest
// of the physics stands. What is learned is a function of one feature, as straight lines between N
// knots at equal distances:
//   x in [0, kLearnedEnd], the first and last value beyond; x = (p − p_a)/(p_op − p_a).
//
//   learned_leak         pressure_N   Q_leak = r(x)·V0·(p − p_a)/P0, m³/s ANR, r ≥ 0 in 1/s
//   learned_conductance  pressure_N   the line conducts 1 + c(x) of what it declares, both ways
//                        expansion_N  the same with x = (V − V0)/(V_op − V0)
//   learned_volume       pressure_N   V = V_qs + V0·∫g(x)dx, g the extra growth
//   learned_sensor       pressure_N   the reading is c(x)·(p_op − p_a) above the pressure
//                        drift        … and a·(1 − e^(−t/τ)) + b·t
// Where the structure is narrower than knots, it has one place of its own, S(z) = 1/(1 + e^−z):
//   learned_leak         opening      as pressure_N with r(x) = r·S((x − x0)/w)
//   learned_volume       bend         V = V_qs + V0·g·(S((x − x0)/w) − S(−x0/w))
// Two have a memory:
//   learned_volume       memory_N     below the highest x so far, x_m, the wall is softer by
//                                     V0·x_m·h(x/x_m), h on knots in (0, 1), 0 at both ends
//   learned_leak         store        a rigid volume behind an orifice (C, b), both ways
// Some swing, with a phase of every run's own at its start, φ:
//   learned_supply       swing        p_s·(1 + a·sin(2π·f·t + φ))
//   learned_sensor       swing        the reading is a·sin(2π·f·t + φ) above the pressure
// And one has a time of every stroke's own:
//   learned_valve        late         each command acts late by a time of its own; those of runs
//                                     that are not recorded yet by the mean of these times
// Valid in the range of pressures that they were learned from. Source: hybrid models that learn a
// correction inside an equation instead of on the output.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_H_

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "model/effects/unit.h"

namespace plenum::model {

inline constexpr double kLearnedEnd = 1.2;

// What belongs to a run, not to the rig.
inline constexpr std::string_view kLatenessName = "lateness_s";
inline constexpr ParameterSpec kPhaseSpec = {"phase_rad", -1e3, 1e3};
inline bool OfEachRun(const ParameterSpec& spec) {
  return spec.name == kLatenessName || spec.name == kPhaseSpec.name;
}

// Straight lines between values at equal distances from 0 to `end`; constant outside. The line in
// force is a mode (unit.h), so that no step crosses a knot: it is chosen by Settle.
template <class T>
class LearnedCurve {
 public:
  LearnedCurve(std::span<const T> values, double end)
      : values_(values.begin(), values.end()),
        width_(end / static_cast<double>(values.size() - 1)) {}

  // Takes the line at x; on a knot the one that x moves into.
  void Settle(double x, double rate) {
    const double at = x / width_;
    const double nearest = std::round(at);
    const bool on_knot = std::abs(at - nearest) < 1e-8;
    const double piece = on_knot ? nearest - (rate < 0.0 ? 1.0 : 0.0) : std::floor(at);
    piece_ = static_cast<int>(std::clamp(piece, -1.0, static_cast<double>(values_.size() - 1)));
  }
  // How far it is to the ends of the line in force.
  T Above(const T& x) const { return piece_ < Last() ? T((piece_ + 1) * width_ - x) : T(1.0); }
  T Below(const T& x) const { return piece_ >= 0 ? T(x - piece_ * width_) : T(1.0); }

  T operator()(const T& x) const { return Left() + Slope() * (x - LeftEnd()); }
  T Slope() const {
    const bool inside = piece_ >= 0 && piece_ < Last();
    return inside ? T((values_[Index() + 1] - values_[Index()]) / width_) : T(0.0);
  }
  // ∫ from 0 to x.
  T Integral(const T& x) const {
    T sum(0.0);
    for (int k = 0; k < piece_; ++k) {
      const auto i = static_cast<std::size_t>(k);
      sum += 0.5 * width_ * (values_[i] + values_[i + 1]);
    }
    const T inside = x - LeftEnd();
    return sum + inside * (Left() + 0.5 * Slope() * inside);
  }

 private:
  int Last() const { return static_cast<int>(values_.size()) - 1; }
  std::size_t Index() const { return static_cast<std::size_t>(piece_); }
  double LeftEnd() const { return std::max(piece_, 0) * width_; }
  T Left() const { return piece_ < 0 ? values_.front() : values_[Index()]; }

  std::vector<T> values_;
  double width_;
  int piece_ = 0;  // from knot `piece_` to the next; −1: below the first
};

// x of a pressure.
template <class T>
T PressureShare(const GroupSetup<T>& setup, const T& pressure_pa) {
  return (pressure_pa - setup.ambient_pressure_pa) /
         (setup.operating_pressure_pa - setup.ambient_pressure_pa);
}

inline constexpr std::array<ParameterSpec, 9> LearnedSpecs(
    const std::array<std::string_view, 9>& names, double low, double high) {
  std::array<ParameterSpec, 9> specs{};
  for (std::size_t k = 0; k < specs.size(); ++k) specs[k] = {names[k], low, high};
  return specs;
}

// The law's name with its number of knots.
template <int N>
constexpr std::string_view Knotted(std::string_view three, std::string_view five,
                                   std::string_view nine) {
  static_assert(N == 3 || N == 5 || N == 9);
  return N == 3 ? three : N == 5 ? five : nine;
}

// S(z) = 1/(1 + e^−z).
template <class T>
T Sigmoid(const T& z) {
  using std::exp;
  if (z < 0.0) {
    const T growing = exp(z);
    return growing / (1.0 + growing);
  }
  return 1.0 / (1.0 + exp(-z));
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_H_
