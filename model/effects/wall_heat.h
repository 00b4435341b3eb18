// Temperature of the gas beside a wall of finite heat capacity, which the gas warms and cools:
//   energy balance of the gas as in heat_transfer.h with wall heat hA·(T_w − T),
//   C_w·dT_w/dt = hA·(T − T_w),
// hA = c_v·p_op·V(p_op)/(R·T_a·τ) constant and C_w = capacity_ratio times the heat capacity of the
// gas at the operating pressure. The wall starts between the surroundings and the gas,
// T_w = T_a + start_share·(T − T_a). Nothing is lost to the surroundings: valid for runs that are
// short beside the cooling of the wall from outside. Instead of heat_transfer, not beside it.
// Source: first law for an open volume with a lumped wall.
#ifndef PLENUM_MODEL_EFFECTS_WALL_HEAT_H_
#define PLENUM_MODEL_EFFECTS_WALL_HEAT_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class WallHeat final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"time_constant_s", 1e-4, 1e9}, {"capacity_ratio", 1e-3, 1e6}, {"start_share", 0.0, 1.0}};
  static constexpr EffectSpec kSpec = {"wall_heat", "", EffectPlace::kEnergy, kParameters};

  explicit WallHeat(std::span<const T> p)
      : time_constant_s_(p[0]), capacity_ratio_(p[1]), start_share_(p[2]) {}

  int states() const override { return 2; }  // gas content in m³ ANR, temperature of the wall
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    const T capacity_j_per_k = setup.operating_pressure_pa * setup.OperatingVolume() /
                               ((setup.heat_capacity_ratio - 1.0) * setup.ambient_temperature_k);
    heat_conductance_w_per_k_ = capacity_j_per_k / time_constant_s_;
    wall_j_per_k_ = capacity_ratio_ * capacity_j_per_k;
    x[0] = setup.Content(m.pressure_pa, m.volume_m3, setup.initial_temperature_k);
    x[1] = setup.ambient_temperature_k +
           start_share_ * (setup.initial_temperature_k - setup.ambient_temperature_k);
    size[0] = ValueOf(setup.operating_pressure_pa * setup.OperatingVolume()) / kReferencePressurePa;
    size[1] = ValueOf(setup.ambient_temperature_k);
  }
  void AfterVolume(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    m.temperature_k = setup.Temperature(m.pressure_pa, m.volume_m3, x[0]);
    m.content_m3 = x[0];
    m.tail_temperature_k = m.temperature_k;
    m.heat_capacity_ratio = setup.heat_capacity_ratio;
    m.wall_heat_w = heat_conductance_w_per_k_ * (x[1] - m.temperature_k);
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = m.in_m3_per_s - m.out_m3_per_s;
    dxdt[1] = -m.wall_heat_w / wall_j_per_k_;
  }

 private:
  T heat_conductance_w_per_k_, wall_j_per_k_;
  T time_constant_s_, capacity_ratio_, start_share_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_WALL_HEAT_H_
