// The records of a run that drive its model instead of being compared with it: the source's
// pressure or setpoint, the valve's opening, an imposed volume. Each is condensed to few points
// (source_record.h), with the noise that its readings show.
#ifndef PLENUM_CALIBRATION_FIT_RECORDED_DRIVING_H_
#define PLENUM_CALIBRATION_FIT_RECORDED_DRIVING_H_

#include "calibration/values/dataset.h"
#include "model/simulate/told/told.h"

namespace plenum::calibration {

// Each empty where no record drives it. Times from the run's start.
struct DrivingRecords {
  model::TimeCourse source_pa;  // of a supply `measured`, or the setpoint of a regulated one
  model::TimeCourse opening;    // within [0, 1]
  model::TimeCourse volume_m3;
  bool dense = false;  // pressures were measured at which gas is not ideal (flow/dense_gas.h)
};
DrivingRecords DrivingRecordsOf(const Run& run);

}  // namespace plenum::calibration

#endif  // PLENUM_CALIBRATION_FIT_RECORDED_DRIVING_H_
