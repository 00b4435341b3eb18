// Hysteresis of the wall, independent of the rate: the volume law is taken at the play (backlash) q
// of the pressure. q stays while |p − q| < w and is pushed along at p − w or p + w. Starts at the
// initial pressure. Source: play operator of Prandtl and Ishlinskii.
#ifndef PLENUM_MODEL_EFFECTS_HYSTERESIS_H_
#define PLENUM_MODEL_EFFECTS_HYSTERESIS_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class Hysteresis final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"half_width_pa", 0.0, 1e5}};
  static constexpr EffectSpec kSpec = {"hysteresis", "", EffectPlace::kVolume, kParameters};

  explicit Hysteresis(std::span<const T> p) : half_width_pa_(p[0]) {}

  int states() const override { return 1; }  // the play
  void Start(const GroupSetup<T>&, const Moment<T>& m, T* x, double* size) override {
    x[0] = m.pressure_pa;
    size[0] = ValueOf(m.pressure_pa);
    mode_ = Mode::kFree;
  }
  void BeforeVolume(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    m.volume_pressure_pa = mode_ == Mode::kFree ? x[0] : T(m.pressure_pa - Sign() * half_width_pa_);
    m.volume_follows = mode_ != Mode::kFree;
  }
  void Rates(const GroupSetup<T>&, const Moment<T>& m, const T*, T* dxdt) const override {
    dxdt[0] = mode_ == Mode::kFree ? T(0.0) : m.pressure_rate_pa_per_s;
  }

  // Free: until the pressure has crossed the gap either way. Pushing: until it turns.
  int guards() const override { return 2; }
  void Guards(const Moment<T>& m, const T* x, T* guards) const override {
    if (mode_ == Mode::kFree) {
      guards[0] = (x[0] + half_width_pa_ - m.pressure_pa) / kReferencePressurePa;
      guards[1] = (m.pressure_pa - x[0] + half_width_pa_) / kReferencePressurePa;
    } else {
      guards[0] = Sign() * m.pressure_rate_pa_per_s / kReferencePressurePa;
      guards[1] = T(1.0);
    }
  }
  void Settle(const Moment<T>& m, const T* x) override {
    const double rate = ValueOf(m.pressure_rate_pa_per_s);
    const double gap = ValueOf(m.pressure_pa) - ValueOf(x[0]);
    const double edge = ValueOf(half_width_pa_) - 1e-9 * ValueOf(m.pressure_pa);
    mode_ = rate > 0.0 && gap >= edge    ? Mode::kUp
            : rate < 0.0 && gap <= -edge ? Mode::kDown
                                         : Mode::kFree;
  }

 private:
  enum class Mode { kFree, kUp, kDown };
  double Sign() const { return mode_ == Mode::kUp ? 1.0 : -1.0; }
  Mode mode_ = Mode::kFree;

 private:
  T half_width_pa_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_HYSTERESIS_H_
