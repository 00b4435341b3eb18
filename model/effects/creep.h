// Creep of the wall: beside the quasi-static volume a part that follows slowly,
//   V = V_qs + V_c,  τ·V̇_c = α·(V_qs − V_qs(p_a)) − V_c.
// Starts at V_c = 0 (rested at ambient). Source: viscoelastic models of soft actuators; one term of
// a Prony series.
#ifndef PLENUM_MODEL_EFFECTS_CREEP_H_
#define PLENUM_MODEL_EFFECTS_CREEP_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class Creep final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"fraction", 0.0, 2.0},
                                                  {"time_constant_s", 1e-3, 1e6}};
  static constexpr EffectSpec kSpec = {"creep", "", EffectPlace::kVolume, kParameters};

  explicit Creep(std::span<const T> p) : fraction_(p[0]), time_constant_s_(p[1]) {}

  int states() const override { return 1; }
  void Start(const GroupSetup<T>& setup, const Moment<T>&, T* x, double* size) override {
    rest_volume_m3_ = setup.QuasiStaticVolume(setup.ambient_pressure_pa);
    x[0] = T(0.0);
    size[0] = ValueOf(rest_volume_m3_);
  }
  void AfterVolume(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    m.volume_m3 += x[0];
    m.volume_rate_m3_per_s += Rate(m, x);
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T* x, T* dxdt) const override {
    dxdt[0] = Rate(m, x);
  }
  T Rate(const Moment<T>& m, const T* x) const {
    return (fraction_ * (m.quasi_static_volume_m3 - rest_volume_m3_) - x[0]) / time_constant_s_;
  }

 private:
  T rest_volume_m3_;
  T fraction_;
  T time_constant_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_CREEP_H_
