// What a record tells of a group: how far its valve is open, and the volume of its actuators.
#ifndef PLENUM_MODEL_SIMULATE_TOLD_TOLD_H_
#define PLENUM_MODEL_SIMULATE_TOLD_TOLD_H_

#include "model/simulate/told/time_course.h"

namespace plenum::model {

// The opening, 0 to 1, is that of the way that the schedule opens; the volume in m³ is an
// actuator's, without dead volume, which is then `blocked`: it does not follow the pressure. Empty:
// not told. Equations: told_group.h.
struct Told {
  TimeCourse opening, volume_m3;
};

}  // namespace plenum::model

#endif  // PLENUM_MODEL_SIMULATE_TOLD_TOLD_H_
