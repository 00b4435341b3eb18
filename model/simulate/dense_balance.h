// The balances of gas that is too dense to be ideal (flow/dense_gas.h), φ = n·R in J/K, w = V/φ.
//
// Choked flow goes with √(p·ρ): ISO 6358's is divided by √Z of the gas upstream. Of one volume
//   φ·c_v·Ṫ = Q_w + φ̇_in·(h_in − h) − T·p_T·(V̇ − w·φ̇)   with an energy balance, else Ṫ = 0,
//   ṗ = p_T·Ṫ + p_w·(V̇ − w·φ̇)/φ,
// p_T and p_w the derivatives of the pressure: the first law of an open volume whose gas leaves at
// its own state and enters from the head of the line at ambient temperature.
// What effects hold in stores of their own, and what leaks, counts as ideal.
#ifndef PLENUM_MODEL_SIMULATE_DENSE_BALANCE_H_
#define PLENUM_MODEL_SIMULATE_DENSE_BALANCE_H_

#include <cmath>

#include "model/effects/unit.h"

namespace plenum::model {

// 1/√Z, a factor on what flows out of gas at a state; 1 without a gas.
template <class T>
T Thinness(const DenseGas* gas, const T& pressure_pa, const T& temperature_k) {
  using std::sqrt;
  if (!gas || !(pressure_pa > 0.0)) return T(1.0);
  return sqrt(temperature_k / (pressure_pa * gas->Volume(pressure_pa, temperature_k)));
}

// Of one actuator's gas.
template <class T>
struct DenseVolume {
  DenseVolume(const GroupSetup<T>& of, const Moment<T>& at)
      : setup(of),
        m(at),
        content(kContentPerKelvin * m.content_m3),
        w(m.volume_m3 / content),
        gas(setup.dense->At(w, m.temperature_k)) {}

  const GroupSetup<T>& setup;
  const Moment<T>& m;
  T content, w;
  GasState<T> gas;

  double ideal_capacity() const { return 1.0 / (setup.heat_capacity_ratio - 1.0); }
  T Energy() const { return content * (ideal_capacity() * m.temperature_k + gas.departure_k); }
  // Per content, K: of the gas here, and of that which enters.
  T Enthalpy() const {
    return ideal_capacity() * m.temperature_k + gas.departure_k + gas.pressure_pa * w;
  }
  T EnthalpyIn() const {
    const T& temperature_k = setup.ambient_temperature_k;
    if (!(m.head_pa > 0.0)) return (ideal_capacity() + 1.0) * temperature_k;  // no source
    const T volume = setup.dense->Volume(m.head_pa, temperature_k);
    const GasState<T> head = setup.dense->At(volume, temperature_k);
    return ideal_capacity() * temperature_k + head.departure_k + m.head_pa * volume;
  }

  // W, of so many.
  void Enthalpies(double count, T& in, T& out) const {
    in = count * kContentPerKelvin * m.in_m3_per_s * EnthalpyIn();
    out = count * kContentPerKelvin * m.out_m3_per_s * Enthalpy();
  }

  T PressureRate() const {
    const T in = kContentPerKelvin * m.in_m3_per_s;
    const T net = kContentPerKelvin * (m.in_m3_per_s - m.out_m3_per_s);
    T warmed(0.0), stiffness = -gas.per_volume_pa;
    if (m.heat_capacity_ratio > 1.0) {
      const T capacity = ideal_capacity() + gas.added_capacity;
      T heat_w = m.wall_heat_w;
      if (in > 0.0) heat_w += in * (EnthalpyIn() - Enthalpy());
      warmed = gas.per_kelvin_pa / (content * capacity) * heat_w;
      stiffness += m.temperature_k * gas.per_kelvin_pa * gas.per_kelvin_pa / capacity;
    }
    return (warmed - stiffness * (m.volume_rate_m3_per_s - w * net) / content) /
           (1.0 + stiffness * m.volume_slope_m3_per_pa / content);
  }
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_DENSE_BALANCE_H_
