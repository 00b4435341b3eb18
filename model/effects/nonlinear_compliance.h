// Volume law that is not a straight line: with x = (p − p_a)/(p_op − p_a),
//   V_qs = V0·[1 + (ε−1)·(x + a·x·(x−1) + s·sin(2πx)/(2π))].
// On a measured volume curve the same bend is laid on the pressure at which the curve is read.
// V + p·dV/dp must stay positive over the run; the run ends with a status where it does not.
// Source: smooth two-parameter form that keeps V(p_a) and V(p_op).
#ifndef PLENUM_MODEL_EFFECTS_NONLINEAR_COMPLIANCE_H_
#define PLENUM_MODEL_EFFECTS_NONLINEAR_COMPLIANCE_H_

#include "model/effects/unit.h"

namespace plenum::model {

template <class T>
class NonlinearCompliance final : public EffectUnit<T> {
 public:
  static constexpr ParameterSpec kParameters[] = {{"curvature", -1.0, 1.0},
                                                  {"s_amplitude", -1.0, 1.0}};
  static constexpr EffectSpec kSpec = {"nonlinear_compliance", "", EffectPlace::kVolume,
                                       kParameters};

  explicit NonlinearCompliance(std::span<const T> p) : curvature_(p[0]), s_amplitude_(p[1]) {}

  void Prepare(GroupSetup<T>& setup) override {
    setup.bent = true;
    setup.curvature = curvature_;
    setup.s_amplitude = s_amplitude_;
  }

 private:
  T curvature_;
  T s_amplitude_;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_EFFECTS_NONLINEAR_COMPLIANCE_H_
