// The source gives way: the line of each actuator draws from a volume V_r that the source refills
// through (C, b),
//   V_r·dp_r/dt = P0·(T_a/T0)·(Q(p_s → p_r) − Q_line).
// Starts at the source's pressure. Source: isothermal balance of a volume, ISO 6358.
#ifndef PLENUM_MODEL_EFFECTS_SUPPLY_DROOP_H_
#define PLENUM_MODEL_EFFECTS_SUPPLY_DROOP_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class SupplyDroop final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"volume_m3", 1e-9, 10.0},
                                                  {"sonic_conductance_m3_per_s_pa", 1e-14, 1e-4},
                                                  {"critical_ratio", 0.0, 0.95}};
  static constexpr EffectSpec kSpec = {"supply_droop", "", EffectPlace::kSupply, kParameters};

  explicit SupplyDroop(std::span<const T> p)
      : volume_m3_(p[0]), sonic_conductance_m3_per_s_pa_(p[1]), critical_ratio_(p[2]) {}

  void Prepare(GroupSetup<T>& setup) override {
    setup.feed = {
        {.sonic_conductance_m3_per_s_pa = sonic_conductance_m3_per_s_pa_ * setup.flow_factor,
         .critical_ratio = critical_ratio_}};
  }
  int states() const override { return 1; }
  void Start(const GroupSetup<T>& setup, const Moment<T>&, T* x, double* size) override {
    x[0] = setup.source_pressure_pa;
    size[0] = ValueOf(x[0]);
  }
  void BeforeVolume(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    m.head_pa = x[0];
  }
  void Rates(const GroupSetup<T>& setup, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = setup.ContentRate() * (m.draw_m3_per_s - m.line_in_m3_per_s) / volume_m3_;
  }
  T Stored(const GroupSetup<T>& setup, const T* x) const override {
    return x[0] * volume_m3_ / setup.ContentRate();
  }

 private:
  T volume_m3_;
  T sonic_conductance_m3_per_s_pa_;
  T critical_ratio_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_SUPPLY_DROOP_H_
