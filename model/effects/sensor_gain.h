// Gain of the sensor: the reading is `gain` times the gauge pressure.
#ifndef PLENUM_MODEL_EFFECTS_SENSOR_GAIN_H_
#define PLENUM_MODEL_EFFECTS_SENSOR_GAIN_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class SensorGain final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"gain", 0.1, 10.0}};
  static constexpr EffectSpec kSpec = {"sensor_gain", "", EffectPlace::kSensor, kParameters};

  explicit SensorGain(std::span<const T> p) : gain_(p[0]) {}

  void Measure(const T*, T& gauge_pa) const override { gauge_pa *= gain_; }

 private:
  T gain_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_SENSOR_GAIN_H_
