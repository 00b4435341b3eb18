// A source whose pressure over time is given, such as the record of a sensor at the source.
//   p_s(t) = p_a + factor·(p(t) − p_a)
// with p(t) the monotone interpolation of the record, and its first and last value outside. Steps
// of the simulator end at every knot, so that no feature of the record is passed over: a noisy
// record costs a step or more a sample and should be condensed first. The check in the line passes
// what noise lifts and holds what it drops, so noise also biases a line near equal pressures.
#ifndef PLENUM_MODEL_DRIVEN_SOURCE_H_
#define PLENUM_MODEL_DRIVEN_SOURCE_H_

#include "model/monotone_curve.h"
#include "model/scalar.h"

namespace plenum::model {

struct DrivenSource {
  MonotoneCurve pressure_pa;  // absolute, over the time in s
  double factor = 1.0;        // on the gauge pressure
  bool operator==(const DrivenSource&) const = default;
};

// p(t) of the record.
template <class T>
T RecordedPressure(const MonotoneCurve& record, const T& time_s) {
  if (time_s <= record.front()) return T(record.y().front());
  if (time_s >= record.back()) return T(record.y().back());
  return CurveAt(record, time_s);
}

}  // namespace plenum::model

#endif  // PLENUM_MODEL_DRIVEN_SOURCE_H_
