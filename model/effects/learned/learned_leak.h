// learned_leak of learned.h: a leak that opens with the pressure, and a store behind an orifice.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_LEAK_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_LEAK_H_

#include "model/effects/leak.h"
#include "model/effects/learned/learned.h"

namespace plenum::model {

template <class T, int N>
class LearnedLeak final : public EffectUnit<T> {
 public:
  static constexpr auto kNames = std::to_array<std::string_view>(
      {"rate_0_per_s", "rate_1_per_s", "rate_2_per_s", "rate_3_per_s", "rate_4_per_s",
       "rate_5_per_s", "rate_6_per_s", "rate_7_per_s", "rate_8_per_s"});
  static constexpr auto kParameters = LearnedSpecs(kNames, 0.0, 1e3);
  static constexpr EffectSpec kSpec = {"learned_leak",
                                       Knotted<N>("pressure_3", "pressure_5", "pressure_9"),
                                       EffectPlace::kChamber,
                                       {kParameters.data(), N}};

  explicit LearnedLeak(std::span<const T> p) : rate_(p, kLearnedEnd) {}

  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T*, double*) override {
    ambient_pa_ = setup.ambient_pressure_pa;
    span_pa_ = setup.operating_pressure_pa - setup.ambient_pressure_pa;
    Settle(m, nullptr);
  }

  void AfterFlow(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    const T above = m.pressure_pa - setup.ambient_pressure_pa;
    const T rate = rate_(Share(m));
    LeakOrifice<T>::AddLeak(rate * setup.rest_volume_m3 * above / kReferencePressurePa, m);
  }

  int guards() const override { return 2; }
  void Guards(const Moment<T>& m, const T*, T* guards) const override {
    guards[0] = rate_.Above(Share(m));
    guards[1] = rate_.Below(Share(m));
  }
  void Settle(const Moment<T>& m, const T*) override {
    rate_.Settle(ValueOf(Share(m)), ValueOf(m.pressure_rate_pa_per_s));
  }

 private:
  T Share(const Moment<T>& m) const { return (m.pressure_pa - ambient_pa_) / span_pa_; }

  LearnedCurve<T> rate_;
  T ambient_pa_, span_pa_;
};

template <class T>
class LearnedOpening final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"rate_per_s", 0.0, 1e3}, {"centre", 0.0, kLearnedEnd}, {"width", 0.003, 0.5}};
  static constexpr EffectSpec kSpec = {"learned_leak", "opening", EffectPlace::kChamber,
                                       kParameters};

  explicit LearnedOpening(std::span<const T> p) : rate_per_s_(p[0]), centre_(p[1]), width_(p[2]) {}

  void AfterFlow(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    const T above = m.pressure_pa - setup.ambient_pressure_pa;
    const T open = Sigmoid<T>((PressureShare(setup, m.pressure_pa) - centre_) / width_);
    LeakOrifice<T>::AddLeak(
        rate_per_s_ * open * setup.rest_volume_m3 * above / kReferencePressurePa, m);
  }

 private:
  T rate_per_s_, centre_, width_;
};

template <class T>
class LearnedStore final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"volume_m3", 1e-9, 10.0},
                                                  {"sonic_conductance_m3_per_s_pa", 1e-15, 1e-4},
                                                  {"critical_ratio", 0.0, 0.95}};
  static constexpr EffectSpec kSpec = {"learned_leak", "store", EffectPlace::kChamber, kParameters};

  explicit LearnedStore(std::span<const T> p)
      : volume_m3_(p[0]), orifice_(LeakOrifice<T>(p.subspan(1))), conductance_(p[1]) {}

  int states() const override { return 1; }  // pressure in the store
  void Start(const GroupSetup<T>&, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.pressure_pa;
    size[0] = ValueOf(m.pressure_pa);
  }
  void AfterFlow(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    const T flow = Flow(setup, m, x);
    (flow > 0.0 ? m.out_m3_per_s : m.in_m3_per_s) += flow > 0.0 ? flow : T(-flow);
  }
  void Rates(const GroupSetup<T>& setup, const Moment<T>& m, const T* x, T* dxdt) const override {
    dxdt[0] = setup.ContentRate() * Flow(setup, m, x) / volume_m3_;
  }
  T Stored(const GroupSetup<T>& setup, const T* x) const override {
    return x[0] * volume_m3_ / setup.ContentRate();
  }

 private:
  T Flow(const GroupSetup<T>& setup, const Moment<T>& m, const T* x) const {
    const bool outward = m.pressure_pa >= x[0];
    const T& upstream = outward ? m.pressure_pa : x[0];
    const T ratio = (outward ? x[0] : m.pressure_pa) / upstream;
    const T flow = conductance_ * setup.flow_factor * upstream * orifice_.Psi(ratio);
    return outward ? flow : T(-flow);
  }

  T volume_m3_;
  LeakOrifice<T> orifice_;
  T conductance_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_LEAK_H_
