// Inertia of the wall and its load: the volume swings into place instead of following at once,
//   V̈ + 2ζω·V̇ + ω²·(V − V_qs) = 0,
// V_qs the volume that the law and the other volume effects give, dead volume apart. Starts at rest
// at V_qs. Source: second-order models of soft actuators.
// A strong swing may drive the volume toward zero; the run then ends with a status.
#ifndef PLENUM_MODEL_EFFECTS_INERTIA_H_
#define PLENUM_MODEL_EFFECTS_INERTIA_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class Inertia final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"natural_frequency_rad_per_s", 0.1, 1e5},
                                                  {"damping_ratio", 0.0, 100.0}};
  static constexpr EffectSpec kSpec = {"inertia", "", EffectPlace::kVolume, kParameters};

  explicit Inertia(std::span<const T> p)
      : natural_frequency_rad_per_s_(p[0]), damping_ratio_(p[1]) {}

  int states() const override { return 2; }  // volume without dead volume, its rate
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.volume_m3 - setup.dead_volume_m3;
    x[1] = T(0.0);
    size[0] = ValueOf(x[0]);
    size[1] = ValueOf(x[0]) * ValueOf(natural_frequency_rad_per_s_);
  }
  void AfterVolume(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    m.followed_volume_m3 = m.volume_m3 - setup.dead_volume_m3;
    if (setup.blocked) return;
    m.volume_m3 = setup.dead_volume_m3 + x[0];
    m.volume_rate_m3_per_s = x[1];
    m.volume_slope_m3_per_pa = T(0.0);
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T* x, T* dxdt) const override {
    const T& w = natural_frequency_rad_per_s_;
    dxdt[0] = x[1];
    dxdt[1] = w * (w * (m.followed_volume_m3 - x[0]) - 2.0 * damping_ratio_ * x[1]);
  }

 private:
  T natural_frequency_rad_per_s_;
  T damping_ratio_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_INERTIA_H_
