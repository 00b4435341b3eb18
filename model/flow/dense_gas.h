// Gas that is too dense to be ideal: the equation of state of Lee and Kesler.
//
// Amounts of gas count as φ = n·R, J/K, so that an ideal gas has p·V = φ·T; w = V/φ in m³·K/J. With
// T_r = T/T_c and v_r = w·p_c/T_c
//   p = Z·T/w,  Z = 1 + B/v_r + C/v_r² + D/v_r⁵ + c_4/(T_r³·v_r²)·(β + γ/v_r²)·exp(−γ/v_r²),
//   B = b_1 − b_2/T_r − b_3/T_r² − b_4/T_r³,  C = c_1 − c_2/T_r + c_3/T_r³,  D = d_1 + d_2/T_r,
// the constants linear in the acentric factor ω, between those of the simple fluid (0) and of
// n-octane (0.3978). Energy and heat capacity follow from it.
//
// Valid: gases above their critical temperature up to 100 MPa, CO2 below its saturation pressure.
// Densities of air are within 0.3 % of published ones up to 30 MPa, of hydrogen within 0.3 % at
// 35 MPa and 3.1 % at 70 MPa (tests/model/flow/dense_gas_test.cc). Elsewhere NaN.
// Source: Lee and Kesler, AIChE Journal 21 (1975) 510; constants linear in ω: Plöcker, Knapp and
// Prausnitz, Ind. Eng. Chem. Process Des. Dev. 17 (1978) 324.
#ifndef PLENUM_MODEL_FLOW_DENSE_GAS_H_
#define PLENUM_MODEL_FLOW_DENSE_GAS_H_

#include <cmath>
#include <limits>

#include "model/flow/scalar.h"
#include "model/physics/air.h"

namespace plenum::model {

// From this pressure on, absolute, a rig's gas is counted as dense.
inline constexpr double kDenseFromPa = 2e6;

// Content φ of a volume at the reference state, J/K per m³ ANR.
inline constexpr double kContentPerKelvin = kReferencePressurePa / kReferenceTemperatureK;

// T: double or a dual number (model/flow/scalar.h).
template <class T>
struct GasState {
  T pressure_pa;
  T per_kelvin_pa;   // ∂p/∂T at constant volume
  T per_volume_pa;   // ∂p/∂w at constant temperature, Pa per m³·K/J
  T departure_k;     // internal energy less that of the ideal gas, over R
  T added_capacity;  // c_v less that of the ideal gas, over R
};

class DenseGas {
 public:
  explicit DenseGas(Gas gas);

  template <class T>
  GasState<T> At(const T& w, const T& temperature_k) const;
  // w of the gas, and the temperature, at a pressure.
  template <class T>
  T Volume(const T& pressure_pa, const T& temperature_k) const;
  template <class T>
  T Temperature(const T& pressure_pa, const T& w) const;

 private:
  // Where `excess(x, slope)` is 0, by steps of at most half or twice, from `x` on; NaN if nowhere.
  template <typename Excess>
  static double Root(double x, const Excess& excess);

  double critical_k_, critical_pa_;
  double b1_, b2_, b3_, b4_, c1_, c2_, c3_, c4_, d1_, d2_, beta_, gamma_;
};

template <class T>
GasState<T> DenseGas::At(const T& w, const T& temperature_k) const {
  using std::exp;
  const T s = 1.0 / temperature_k * critical_k_;  // 1/T_r
  const T x = critical_k_ / (critical_pa_ * w);   // 1/v_r
  const T x2 = x * x, x5 = x2 * x2 * x, g = gamma_ * x2, decay = exp(-g);
  const T b = b1_ - s * (b2_ + s * (b3_ + s * b4_));
  const T c = c1_ - s * (c2_ - s * s * c3_), d = d1_ + d2_ * s;
  const T last = c4_ * s * s * s * x2 * (beta_ + g) * decay;
  const T z = 1.0 + x * (b + x * c) + x5 * d + last;
  // x·∂Z/∂x and T·∂Z/∂T
  const T by_x = x * b + 2.0 * x2 * c + 5.0 * x5 * d +
                 2.0 * c4_ * s * s * s * x2 * (beta_ + 2.0 * g - g * (beta_ + g)) * decay;
  const T by_t = x * s * (b2_ + s * (2.0 * b3_ + 3.0 * s * b4_)) +
                 x2 * s * (c2_ - 3.0 * s * s * c3_) - x5 * d2_ * s - 3.0 * last;
  const T e = c4_ * s * s * s / (2.0 * gamma_) * (beta_ + 1.0 - (beta_ + 1.0 + g) * decay);
  GasState<T> state;
  state.pressure_pa = z * temperature_k / w;
  state.per_kelvin_pa = (z + by_t) / w;
  state.per_volume_pa = -(z + by_x) * temperature_k / (w * w);
  state.departure_k = temperature_k * (3.0 * e + x5 * d2_ * s / 5.0 -
                                       x * s * (b2_ + s * (2.0 * b3_ + 3.0 * s * b4_)) -
                                       x2 * s * (c2_ - 3.0 * s * s * c3_) / 2.0);
  state.added_capacity =
      2.0 * x * s * s * (b3_ + 3.0 * b4_ * s) - 3.0 * x2 * s * s * s * c3_ - 6.0 * e;
  return state;
}

template <typename Excess>
double DenseGas::Root(double x, const Excess& excess) {
  constexpr int kStepsMax = 60;
  constexpr double kAccuracy = 1e-13;
  for (int i = 0; i < kStepsMax; ++i) {
    double slope = 0.0;
    const double step = -excess(x, slope) / slope;
    const double next = step < -0.5 * x ? 0.5 * x : step > x ? 2.0 * x : x + step;
    if (!(next > 0.0)) break;
    if (std::abs(next - x) <= kAccuracy * x) return next;
    x = next;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

template <class T>
T DenseGas::Volume(const T& pressure_pa, const T& temperature_k) const {
  const double p = ValueOf(pressure_pa), t = ValueOf(temperature_k);
  const double w = Root(t / p, [&](double x, double& slope) {
    const GasState<double> state = At(x, t);
    slope = state.per_volume_pa;
    return state.pressure_pa - p;
  });
  if constexpr (!kIsDual<T>) return w;
  const GasState<T> state = At(T(w), temperature_k);
  return w - (state.pressure_pa - pressure_pa) / state.per_volume_pa;
}

template <class T>
T DenseGas::Temperature(const T& pressure_pa, const T& w) const {
  const double p = ValueOf(pressure_pa), volume = ValueOf(w);
  const double t = Root(p * volume, [&](double x, double& slope) {
    const GasState<double> state = At(volume, x);
    slope = state.per_kelvin_pa;
    return state.pressure_pa - p;
  });
  if constexpr (!kIsDual<T>) return t;
  const GasState<T> state = At(w, T(t));
  return t - (state.pressure_pa - pressure_pa) / state.per_kelvin_pa;
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_FLOW_DENSE_GAS_H_
