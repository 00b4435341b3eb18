#include "calibration/fit/recorded/driving.h"

#include <algorithm>
#include <vector>

#include "calibration/fit/source_record.h"
#include "calibration/noise/noise.h"

namespace plenum::calibration {
namespace {

model::TimeCourse Condensed(const Run& run, const std::vector<double>& record) {
  if (record.empty()) return {};
  model::TimeCourse course =
      CondenseRecord(run.t_s, record, EstimateNoise({run.t_s, record, {}, {}}).sigma_pa);
  for (double& time_s : course.time_s) time_s -= StartOf(run);
  return course;
}

}  // namespace

DrivingRecords DrivingRecordsOf(const Run& run) {
  DrivingRecords records;
  const Channels& channels = run.channels;
  if (run.supply == Supply::kMeasured)
    records.source_pa = Condensed(run, channels.source_pressure_pa);
  if (FollowsSetpoint(run)) records.source_pa = Condensed(run, channels.source_setpoint_pa);
  records.opening = Condensed(run, channels.valve_opening);
  for (double& opening : records.opening.value) opening = std::clamp(opening, 0.0, 1.0);
  if (run.volume_imposed) records.volume_m3 = Condensed(run, channels.volume_m3);
  return records;
}

}  // namespace plenum::calibration
