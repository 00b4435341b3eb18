// Dead time of the valve: every command acts that much later. Source: response times of on/off
// valves, 1 to 200 ms.
#ifndef PLENUM_MODEL_EFFECTS_VALVE_DELAY_H_
#define PLENUM_MODEL_EFFECTS_VALVE_DELAY_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class ValveDelay final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"delay_s", 0.0, 10.0}};
  static constexpr EffectSpec kSpec = {"valve_delay", "", EffectPlace::kValve, kParameters};

  explicit ValveDelay(std::span<const T> p) : delay_s_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override { setup.valve_delay_s += delay_s_; }

 private:
  T delay_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_VALVE_DELAY_H_
