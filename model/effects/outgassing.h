// Outgassing: gas that comes out of walls, seals or trapped pockets after an evacuation, at a rate
// that decays,
//   Q(t) = Q_0·e^(−t/τ), m³/s ANR into the actuator, from the start of the run on.
// A leak goes on at the same rate for as long as the chamber is far below the ambient pressure.
// Source: O'Hanlon, A User's Guide to Vacuum Technology (2003), chapter 4; one exponential of what
// is a sum of many.
#ifndef PLENUM_MODEL_EFFECTS_OUTGASSING_H_
#define PLENUM_MODEL_EFFECTS_OUTGASSING_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class Outgassing final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"initial_flow_m3_per_s", 0.0, 1e-3},
                                                  {"time_constant_s", 1e-3, 1e6}};
  static constexpr EffectSpec kSpec = {"outgassing", "", EffectPlace::kChamber, kParameters};

  explicit Outgassing(std::span<const T> p)
      : initial_flow_m3_per_s_(p[0]), time_constant_s_(p[1]) {}

  int states() const override { return 1; }
  void Start(const GroupSetup<T>&, const Moment<T>&, T* x, double* size) override {
    x[0] = T(1.0);  // Q over Q_0
    size[0] = 1.0;
  }
  void AfterFlow(const GroupSetup<T>&, const T* x, Moment<T>& m) const override {
    const T flow_m3_per_s = initial_flow_m3_per_s_ * x[0];
    m.leak_m3_per_s -= flow_m3_per_s;  // in one account with leaks
    m.in_m3_per_s += flow_m3_per_s;
  }
  void Rates(const GroupSetup<T>&, const Moment<T>&, const T* x, T* dxdt) const override {
    dxdt[0] = -x[0] / time_constant_s_;
  }

 private:
  T initial_flow_m3_per_s_;
  T time_constant_s_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_OUTGASSING_H_
