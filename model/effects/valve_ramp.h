// Opening time of the valve: each way through it opens and closes at a constant rate, the full
// stroke taking `duration_s`, and the conductance of the line goes in proportion to the opening.
// The ramps of filling and exhaust may overlap. Source: openings of on/off valves measured as
// straight lines, 2 to 200 ms.
#ifndef PLENUM_MODEL_EFFECTS_VALVE_RAMP_H_
#define PLENUM_MODEL_EFFECTS_VALVE_RAMP_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class ValveRamp final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"duration_s", 0.0, 10.0}};
  static constexpr EffectSpec kSpec = {"valve_ramp", "", EffectPlace::kValve, kParameters};

  explicit ValveRamp(std::span<const T> p) : duration_s_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override { setup.valve_ramp_s += duration_s_; }

 private:
  T duration_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_VALVE_RAMP_H_
