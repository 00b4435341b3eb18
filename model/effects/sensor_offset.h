// Zero of the sensor: the reading is that much above the gauge pressure.
#ifndef PLENUM_MODEL_EFFECTS_SENSOR_OFFSET_H_
#define PLENUM_MODEL_EFFECTS_SENSOR_OFFSET_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class SensorOffset final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"offset_pa", -1e6, 1e6}};
  static constexpr EffectSpec kSpec = {"sensor_offset", "", EffectPlace::kSensor, kParameters};

  explicit SensorOffset(std::span<const T> p) : offset_pa_(p[0]) {}

  void Measure(const T*, T& gauge_pa) const override { gauge_pa += offset_pa_; }

 private:
  T offset_pa_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_SENSOR_OFFSET_H_
