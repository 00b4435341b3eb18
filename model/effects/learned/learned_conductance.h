// learned_conductance of learned.h: the line conducts more or less as the actuator fills.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_CONDUCTANCE_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_CONDUCTANCE_H_

#include "model/effects/learned/learned.h"

namespace plenum::model {

enum class ConductanceFeature { kPressure, kExpansion };

template <class T, int N, ConductanceFeature kFeature>
class LearnedConductance final : public EffectUnit<T> {
 public:
  static constexpr auto kNames =
      std::to_array<std::string_view>({"change_0", "change_1", "change_2", "change_3", "change_4",
                                       "change_5", "change_6", "change_7", "change_8"});
  static constexpr auto kParameters = LearnedSpecs(kNames, -0.99, 10.0);
  static constexpr EffectSpec kSpec = {
      "learned_conductance",
      kFeature == ConductanceFeature::kPressure
          ? Knotted<N>("pressure_3", "pressure_5", "pressure_9")
          : Knotted<N>("expansion_3", "expansion_5", "expansion_9"),
      EffectPlace::kLine,
      {kParameters.data(), N}};

  explicit LearnedConductance(std::span<const T> p) : change_(p, kLearnedEnd) {}

  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T*, double*) override {
    if (kFeature == ConductanceFeature::kPressure) {
      zero_ = setup.ambient_pressure_pa;
      span_ = setup.operating_pressure_pa - setup.ambient_pressure_pa;
    } else {
      zero_ = setup.dead_volume_m3 + setup.QuasiStaticVolume(setup.ambient_pressure_pa);
      span_ = setup.OperatingVolume() - setup.QuasiStaticVolume(setup.ambient_pressure_pa);
    }
    Settle(m, nullptr);
  }
  void AfterVolume(const GroupSetup<T>&, const T*, Moment<T>& m) const override {
    m.line_factor *= 1.0 + change_(Share(m));
  }

  int guards() const override { return 2; }
  void Guards(const Moment<T>& m, const T*, T* guards) const override {
    guards[0] = change_.Above(Share(m));
    guards[1] = change_.Below(Share(m));
  }
  void Settle(const Moment<T>& m, const T*) override {
    const T& pressure_rate = m.pressure_rate_pa_per_s;
    const T rate = kFeature == ConductanceFeature::kPressure
                       ? pressure_rate
                       : T(m.volume_rate_m3_per_s + m.volume_slope_m3_per_pa * pressure_rate);
    change_.Settle(ValueOf(Share(m)), ValueOf(rate));
  }

 private:
  // 0 for a chamber that does not expand.
  T Share(const Moment<T>& m) const {
    if (IsZero(span_)) return T(0.0);
    return ((kFeature == ConductanceFeature::kPressure ? m.pressure_pa : m.volume_m3) - zero_) /
           span_;
  }

  LearnedCurve<T> change_;
  T zero_, span_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_CONDUCTANCE_H_
