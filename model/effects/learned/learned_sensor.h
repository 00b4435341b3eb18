// learned_sensor of learned.h: a reading that is off by a function of the pressure, that drifts or
// that swings.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SENSOR_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SENSOR_H_

#include <numbers>

#include "model/effects/learned/learned.h"

namespace plenum::model {

template <class T, int N>
class LearnedSensor final : public EffectUnit<T> {
 public:
  static constexpr auto kNames =
      std::to_array<std::string_view>({"shift_0", "shift_1", "shift_2", "shift_3", "shift_4",
                                       "shift_5", "shift_6", "shift_7", "shift_8"});
  static constexpr auto kParameters = LearnedSpecs(kNames, -10.0, 10.0);
  static constexpr EffectSpec kSpec = {"learned_sensor",
                                       Knotted<N>("pressure_3", "pressure_5", "pressure_9"),
                                       EffectPlace::kSensor,
                                       {kParameters.data(), N}};

  explicit LearnedSensor(std::span<const T> p) : shift_(p, kLearnedEnd) {}

  void Prepare(GroupSetup<T>& setup) override {
    span_pa_ = setup.operating_pressure_pa - setup.ambient_pressure_pa;
  }
  void Measure(const T*, T& gauge_pa) const override {
    LearnedCurve<T> shift = shift_;
    shift.Settle(ValueOf(gauge_pa / span_pa_), 0.0);
    gauge_pa += span_pa_ * shift(gauge_pa / span_pa_);
  }

 private:
  LearnedCurve<T> shift_;
  T span_pa_;
};

template <class T>
class LearnedDrift final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"settled_pa", -1e6, 1e6}, {"time_constant_s", 1e-3, 1e6}, {"rate_pa_per_s", -1e6, 1e6}};
  static constexpr EffectSpec kSpec = {"learned_sensor", "drift", EffectPlace::kSensor,
                                       kParameters};

  explicit LearnedDrift(std::span<const T> p)
      : settled_pa_(p[0]), time_constant_s_(p[1]), rate_pa_per_s_(p[2]) {}

  int states() const override { return 1; }  // the time, s
  void Start(const GroupSetup<T>&, const Moment<T>&, T* x, double* size) override {
    x[0] = T(0.0);
    size[0] = 1.0;
  }
  void Rates(const GroupSetup<T>&, const Moment<T>&, const T*, T* dxdt) const override {
    dxdt[0] = T(1.0);
  }
  void Measure(const T* x, T& gauge_pa) const override {
    using std::exp;
    gauge_pa += settled_pa_ * (1.0 - exp(-x[0] / time_constant_s_)) + rate_pa_per_s_ * x[0];
  }

 private:
  T settled_pa_, time_constant_s_, rate_pa_per_s_;
};

template <class T>
class LearnedSwingOfSensor final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"amplitude_pa", 0.0, 1e6}, {"frequency_hz", 1e-4, 1e4}, kPhaseSpec};
  static constexpr EffectSpec kSpec = {"learned_sensor", "swing", EffectPlace::kSensor,
                                       kParameters};

  explicit LearnedSwingOfSensor(std::span<const T> p)
      : amplitude_pa_(p[0]), turn_rad_per_s_(2.0 * std::numbers::pi * p[1]), phase_rad_(p[2]) {}

  int states() const override { return 1; }  // the time, s
  void Start(const GroupSetup<T>&, const Moment<T>&, T* x, double* size) override {
    x[0] = T(0.0);
    size[0] = 1.0;
  }
  void Rates(const GroupSetup<T>&, const Moment<T>&, const T*, T* dxdt) const override {
    dxdt[0] = T(1.0);
  }
  void Measure(const T* x, T& gauge_pa) const override {
    using std::sin;
    gauge_pa += amplitude_pa_ * sin(turn_rad_per_s_ * x[0] + phase_rad_);
  }

 private:
  T amplitude_pa_, turn_rad_per_s_, phase_rad_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SENSOR_H_
