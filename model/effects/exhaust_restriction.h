// One more element at the end of the way out: silencer, clogged port, shared exhaust manifold.
// ISO 6358 (C, b) in series after the line when deflating; a ramp of the valve does not act on it.
#ifndef PLENUM_MODEL_EFFECTS_EXHAUST_RESTRICTION_H_
#define PLENUM_MODEL_EFFECTS_EXHAUST_RESTRICTION_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class ExhaustRestriction final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"sonic_conductance_m3_per_s_pa", 1e-14, 1e-4},
                                                  {"critical_ratio", 0.0, 0.95}};
  static constexpr EffectSpec kSpec = {"exhaust_restriction", "", EffectPlace::kLine, kParameters};

  explicit ExhaustRestriction(std::span<const T> p)
      : sonic_conductance_m3_per_s_pa_(p[0]), critical_ratio_(p[1]) {}

  void Prepare(GroupSetup<T>& setup) override {
    if (setup.exhaust.empty()) return;
    setup.exhaust.push_back(
        {.sonic_conductance_m3_per_s_pa = sonic_conductance_m3_per_s_pa_ * setup.flow_factor,
         .critical_ratio = critical_ratio_});
    ++setup.exhaust_fixed;
  }

 private:
  T sonic_conductance_m3_per_s_pa_;
  T critical_ratio_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_EXHAUST_RESTRICTION_H_
