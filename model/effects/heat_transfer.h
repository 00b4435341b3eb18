// Temperature of the gas and heat from the wall, instead of a constant temperature:
//   energy balance with enthalpy flows (gas enters at T_a, leaves at T), wall heat hA·(T_a − T),
//   hA = c_v·p_op·V(p_op)/(R·T_a·τ) constant, V(p_op) of the actuator, not blocked.
// The state is the gas content n (m³ ANR); T = (p·V/n)·T0/P0. τ → 0 is isothermal, τ → ∞ adiabatic.
// Source: first law for an open volume; a constant hA reproduces measured tank figures.
#ifndef PLENUM_MODEL_EFFECTS_HEAT_TRANSFER_H_
#define PLENUM_MODEL_EFFECTS_HEAT_TRANSFER_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class HeatTransfer final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"time_constant_s", 1e-4, 1e9}};
  static constexpr EffectSpec kSpec = {"heat_transfer", "", EffectPlace::kEnergy, kParameters};

  explicit HeatTransfer(std::span<const T> p) : time_constant_s_(p[0]) {}

  int states() const override { return 1; }  // m³ ANR
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    heat_conductance_w_per_k_ =
        setup.operating_pressure_pa * setup.OperatingVolume() /
        ((setup.heat_capacity_ratio - 1.0) * setup.ambient_temperature_k * time_constant_s_);
    x[0] = setup.Content(m.pressure_pa, m.volume_m3, setup.initial_temperature_k);
    size[0] = ValueOf(setup.operating_pressure_pa * setup.OperatingVolume()) / kReferencePressurePa;
  }
  void AfterVolume(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    m.temperature_k = setup.Temperature(m.pressure_pa, m.volume_m3, x[0]);
    m.content_m3 = x[0];
    m.tail_temperature_k = m.temperature_k;
    m.heat_capacity_ratio = setup.heat_capacity_ratio;
    m.wall_heat_w = heat_conductance_w_per_k_ * (setup.ambient_temperature_k - m.temperature_k);
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = m.in_m3_per_s - m.out_m3_per_s;
  }

 private:
  T heat_conductance_w_per_k_;
  T time_constant_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_HEAT_TRANSFER_H_
