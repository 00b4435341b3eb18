// The way in conducts `fill_factor` times what the declared elements say; the way out is unchanged.
// Elements in series pass up to 7 % more in one order than in the other, and seats differ by side.
#ifndef PLENUM_MODEL_EFFECTS_DIRECTIONAL_CONDUCTANCE_H_
#define PLENUM_MODEL_EFFECTS_DIRECTIONAL_CONDUCTANCE_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class DirectionalConductance final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"fill_factor", 0.1, 10.0}};
  static constexpr EffectSpec kSpec = {"directional_conductance", "", EffectPlace::kLine,
                                       kParameters};

  explicit DirectionalConductance(std::span<const T> p) : fill_factor_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override {
    for (LineElement<T>& element : setup.fill)
      element.sonic_conductance_m3_per_s_pa *= fill_factor_;
  }

 private:
  T fill_factor_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_DIRECTIONAL_CONDUCTANCE_H_
