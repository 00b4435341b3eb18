// First-order lag of the reading, filter and sensor tube included: τ·ṗ_m = p − p_m. Starts at the
// pressure.
#ifndef PLENUM_MODEL_EFFECTS_SENSOR_LAG_H_
#define PLENUM_MODEL_EFFECTS_SENSOR_LAG_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class SensorLag final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"time_constant_s", 1e-5, 100.0}};
  static constexpr EffectSpec kSpec = {"sensor_lag", "", EffectPlace::kSensor, kParameters};

  explicit SensorLag(std::span<const T> p) : time_constant_s_(p[0]) {}

  int states() const override { return 1; }
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.pressure_pa;
    size[0] = ValueOf(m.pressure_pa);
    ambient_pressure_pa_ = setup.ambient_pressure_pa;
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T* x, T* dxdt) const override {
    dxdt[0] = (m.pressure_pa - x[0]) / time_constant_s_;
  }
  void Measure(const T* x, T& gauge_pa) const override { gauge_pa = x[0] - ambient_pressure_pa_; }

 private:
  T ambient_pressure_pa_;
  T time_constant_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_SENSOR_LAG_H_
