// learned_valve of learned.h: a valve whose strokes come late, each by a time of its own.
#ifndef PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VALVE_H_
#define PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VALVE_H_

#include "model/effects/learned/learned.h"

namespace plenum::model {

template <class T>
class LearnedLateStrokes final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{kLatenessName, 0.0, 10.0}};
  static constexpr EffectSpec kSpec = {"learned_valve", "late", EffectPlace::kValve, kParameters};

  explicit LearnedLateStrokes(std::span<const T> p) : lateness_s_(p[0]) {}

  void Prepare(GroupSetup<T>& setup) override { setup.valve_delay_s += lateness_s_; }

 private:
  T lateness_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_LEARNED_LEARNED_VALVE_H_
