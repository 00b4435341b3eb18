// How far one way through a valve is open, as commands turn it.
#ifndef PLENUM_MODEL_SIMULATE_OPENING_H_
#define PLENUM_MODEL_SIMULATE_OPENING_H_

#include "model/flow/scalar.h"

namespace plenum::model {

// From `start` at `since_s` at a constant rate to `end`.
template <class T>
struct Opening {
  T since_s = T(0.0);
  T start = T(0.0);
  double end = 0.0;
  T ramp_s = T(0.0);  // for the whole way between 0 and 1; 0: at once

  T At(const T& time_s) const {
    if (!(ramp_s > 0.0) || time_s >= EndTime()) return T(end);
    const T way = (time_s - since_s) / ramp_s;
    return end > start ? T(start + way) : T(start - way);
  }
  // When it comes to rest.
  T EndTime() const { return since_s + ramp_s * (end > start ? T(end - start) : T(start - end)); }
  void Turn(const T& time_s, double to) { start = At(time_s), since_s = time_s, end = to; }
  bool Closed(double time_s) const { return end == 0.0 && time_s >= ValueOf(EndTime()); }
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_OPENING_H_
