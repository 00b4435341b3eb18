// learned_volume of learned.h: another course of the volume over the pressure, and one that depends
// on the highest pressure so far.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VOLUME_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VOLUME_H_

#include "model/effects/learned/learned.h"

namespace plenum::model {

template <class T, int N>
class LearnedVolume final : public EffectUnit<T> {
 public:
  static constexpr auto kNames =
      std::to_array<std::string_view>({"growth_0", "growth_1", "growth_2", "growth_3", "growth_4",
                                       "growth_5", "growth_6", "growth_7", "growth_8"});
  static constexpr auto kParameters = LearnedSpecs(kNames, -100.0, 100.0);
  static constexpr EffectSpec kSpec = {"learned_volume",
                                       Knotted<N>("pressure_3", "pressure_5", "pressure_9"),
                                       EffectPlace::kVolume,
                                       {kParameters.data(), N}};

  explicit LearnedVolume(std::span<const T> p) : growth_(p, kLearnedEnd) {}

  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T*, double*) override {
    ambient_pa_ = setup.ambient_pressure_pa;
    span_pa_ = setup.operating_pressure_pa - setup.ambient_pressure_pa;
    Settle(m, nullptr);
  }

  // Taken where the law is, so that hysteresis acts on both.
  void AfterVolume(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    if (setup.blocked) return;
    const T x = Share(m);
    const T extra_m3 = setup.rest_volume_m3 * growth_.Integral(x);
    m.quasi_static_volume_m3 += extra_m3;
    m.volume_m3 += extra_m3;
    if (!m.volume_follows) return;
    m.volume_slope_m3_per_pa += setup.rest_volume_m3 * growth_(x) / span_pa_;
  }

  int guards() const override { return 2; }
  void Guards(const Moment<T>& m, const T*, T* guards) const override {
    guards[0] = growth_.Above(Share(m));
    guards[1] = growth_.Below(Share(m));
  }
  void Settle(const Moment<T>& m, const T*) override {
    growth_.Settle(ValueOf(Share(m)), ValueOf(m.pressure_rate_pa_per_s));
  }

 private:
  T Share(const Moment<T>& m) const { return (m.volume_pressure_pa - ambient_pa_) / span_pa_; }

  LearnedCurve<T> growth_;
  T ambient_pa_, span_pa_;
};

template <class T>
class LearnedBend final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"growth", -10.0, 10.0}, {"centre", 0.0, kLearnedEnd}, {"width", 0.003, 0.5}};
  static constexpr EffectSpec kSpec = {"learned_volume", "bend", EffectPlace::kVolume, kParameters};

  explicit LearnedBend(std::span<const T> p) : growth_(p[0]), centre_(p[1]), width_(p[2]) {}

  void AfterVolume(const GroupSetup<T>& setup, const T*, Moment<T>& m) const override {
    if (setup.blocked) return;
    const T grown = Sigmoid<T>((PressureShare(setup, m.volume_pressure_pa) - centre_) / width_);
    const T size_m3 = setup.rest_volume_m3 * growth_;
    const T extra_m3 = size_m3 * (grown - Sigmoid<T>(-centre_ / width_));
    m.quasi_static_volume_m3 += extra_m3;
    m.volume_m3 += extra_m3;
    if (!m.volume_follows) return;
    const T span_pa = setup.operating_pressure_pa - setup.ambient_pressure_pa;
    m.volume_slope_m3_per_pa += size_m3 * grown * (1.0 - grown) / (width_ * span_pa);
  }

 private:
  T growth_, centre_, width_;
};

// The state is the highest share of the operating pressure so far.
template <class T, int N>
class LearnedMemory final : public EffectUnit<T> {
 public:
  static constexpr auto kNames =
      std::to_array<std::string_view>({"softer_1", "softer_2", "softer_3"});
  static constexpr auto kParameters = [] {
    std::array<ParameterSpec, 3> specs{};
    for (std::size_t k = 0; k < specs.size(); ++k) specs[k] = {kNames[k], -10.0, 10.0};
    return specs;
  }();
  static constexpr EffectSpec kSpec = {"learned_volume",
                                       N == 1 ? "memory_1" : "memory_3",
                                       EffectPlace::kVolume,
                                       {kParameters.data(), N}};

  explicit LearnedMemory(std::span<const T> p) : softer_(WithEnds(p), 1.0) {}

  int states() const override { return 1; }
  void Start(const GroupSetup<T>& setup, const Moment<T>& m, T* x, double* size) override {
    x[0] = PressureShare(setup, m.pressure_pa);
    size[0] = 1.0;
    span_pa_ = setup.operating_pressure_pa - setup.ambient_pressure_pa;
    ambient_pa_ = setup.ambient_pressure_pa;
    first_ = true;
  }
  void AfterVolume(const GroupSetup<T>& setup, const T* x, Moment<T>& m) const override {
    if (setup.blocked || first_ || !(x[0] > 0.0)) return;
    const T share = Share(m) / x[0];
    const T extra_m3 = setup.rest_volume_m3 * x[0] * softer_(share);
    m.quasi_static_volume_m3 += extra_m3;
    m.volume_m3 += extra_m3;
    if (m.volume_follows) {
      m.volume_slope_m3_per_pa += setup.rest_volume_m3 * softer_.Slope() / span_pa_;
    }
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = first_ ? T(m.pressure_rate_pa_per_s / span_pa_) : T(0.0);
  }

  // At the highest pressure so far: until it turns. Below: until it is reached again.
  int guards() const override { return 2; }
  void Guards(const Moment<T>& m, const T* x, T* guards) const override {
    guards[0] = first_ ? T(m.pressure_rate_pa_per_s / span_pa_) : softer_.Above(Share(m) / x[0]);
    guards[1] = first_ ? T(1.0) : softer_.Below(Share(m) / x[0]);
  }
  void Settle(const Moment<T>& m, const T* x) override {
    const double rate = ValueOf(m.pressure_rate_pa_per_s);
    const double share = ValueOf(Share(m));
    const double highest = ValueOf(x[0]);
    first_ = !(highest > 0.0) || (rate > 0.0 && share >= highest - 1e-9);
    if (!first_) softer_.Settle(share / highest, rate);
  }

 private:
  T Share(const Moment<T>& m) const { return (m.volume_pressure_pa - ambient_pa_) / span_pa_; }
  static std::vector<T> WithEnds(std::span<const T> inner) {
    std::vector<T> values = {T(0.0)};
    values.insert(values.end(), inner.begin(), inner.end());
    values.push_back(T(0.0));
    return values;
  }

  LearnedCurve<T> softer_;
  T span_pa_, ambient_pa_;
  bool first_ = true;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VOLUME_H_
