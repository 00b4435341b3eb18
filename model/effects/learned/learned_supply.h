// learned_supply of learned.h: a source that swings.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SUPPLY_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SUPPLY_H_

#include <numbers>

#include "model/effects/learned/learned.h"

namespace plenum::model {

template <class T>
class LearnedSwingOfSupply final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {
      {"amplitude", 0.0, 0.5}, {"frequency_hz", 1e-4, 1e4}, kPhaseSpec};
  static constexpr EffectSpec kSpec = {"learned_supply", "swing", EffectPlace::kSupply,
                                       kParameters};

  explicit LearnedSwingOfSupply(std::span<const T> p)
      : amplitude_(p[0]), turn_rad_per_s_(2.0 * std::numbers::pi * p[1]), phase_rad_(p[2]) {}

  bool acts_on_source() const override { return true; }
  void Source(const T& t_s, T& pressure_pa) const override {
    using std::sin;
    pressure_pa *= 1.0 + amplitude_ * sin(turn_rad_per_s_ * t_s + phase_rad_);
  }

 private:
  T amplitude_, turn_rad_per_s_, phase_rad_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_SUPPLY_H_
