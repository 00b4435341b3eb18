// Constant volume added at the actuator: fittings, manifold, sensor ports.
#ifndef PLENUM_MODEL_EFFECTS_DEAD_VOLUME_H_
#define PLENUM_MODEL_EFFECTS_DEAD_VOLUME_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class DeadVolume final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"volume_m3", 0.0, 1.0}};
  static constexpr EffectSpec kSpec = {"dead_volume", "", EffectPlace::kVolume, kParameters};

  explicit DeadVolume(std::span<const T> p) : volume_m3_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override { setup.dead_volume_m3 += volume_m3_; }

 private:
  T volume_m3_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_DEAD_VOLUME_H_
