// The pressure at which a flow is a given one.
#ifndef PLENUM_MODEL_INTEGRATE_PRESSURE_AT_H_
#define PLENUM_MODEL_INTEGRATE_PRESSURE_AT_H_

#include <cmath>

#include "model/flow/scalar.h"
#include "model/integrate/simulate_root.h"

namespace plenum::model {

inline constexpr double kInletTolerancePa = 1e-5, kInletStepPa = 1.0;

// Where between two pressures a monotone flow is this one; by a step of Newton's method with the
// derivatives of T.
template <class T, class Flow>
T PressureAt(const Flow& flow_at, const T& flow, const T& low_pa, const T& high_pa) {
  const auto above = [&](double pressure_pa) { return ValueOf(T(flow_at(T(pressure_pa)) - flow)); };
  const double low = ValueOf(low_pa), high = ValueOf(high_pa);
  const double above_low = above(low), above_high = above(high);
  if ((above_low > 0.0) == (above_high > 0.0))
    return std::abs(above_low) < std::abs(above_high) ? low_pa : high_pa;
  const double root = RootBetween(above, low, above_low, high, above_high, kInletTolerancePa);
  const double slope =
      (above(root + kInletStepPa) - above(root - kInletStepPa)) / (2.0 * kInletStepPa);
  return slope == 0.0 ? T(root) : T(root - (flow_at(T(root)) - flow) / slope);
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_INTEGRATE_PRESSURE_AT_H_
