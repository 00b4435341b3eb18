// Cracking pressure of the line (a check valve, a stiff seat): gas flows only above this
// difference, which is lost from the upstream pressure, both ways. Source: ISO 6358-1:2013, as lost
// head.
#ifndef PLENUM_MODEL_EFFECTS_CRACKING_PRESSURE_H_
#define PLENUM_MODEL_EFFECTS_CRACKING_PRESSURE_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class CrackingPressure final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"pressure_pa", 0.0, 1e6}};
  static constexpr EffectSpec kSpec = {"cracking_pressure", "", EffectPlace::kLine, kParameters};

  explicit CrackingPressure(std::span<const T> p) : pressure_pa_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override {
    for (auto* elements : {&setup.fill, &setup.exhaust}) {
      if (!elements->empty()) elements->front().cracking_pressure_pa += pressure_pa_;
    }
  }

 private:
  T pressure_pa_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_CRACKING_PRESSURE_H_
