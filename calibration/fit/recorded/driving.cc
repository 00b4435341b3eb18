#include "calibration/fit/recorded/driving.h"

#include <algorithm>
#include <vector>

#include "calibration/fit/source_record.h"
#include "calibration/noise/noise.h"
#include "model/flow/dense_gas.h"

namespace plenum::calibration {
namespace {

model::TimeCourse Condensed(const Run& run, const std::vector<double>& record) {
  if (record.empty()) return {};
  model::TimeCourse course =
      CondenseRecord(run.t_s, record, EstimateNoise({run.t_s, record, {}, {}}).sigma_pa);
  for (double& time_s : course.time_s) time_s -= StartOf(run);
  return course;
}

bool HoldsDenseGas(const Run& run) {
  const auto dense = [](double pressure_pa) { return pressure_pa >= model::kDenseFromPa; };
  const auto any = [&](const std::vector<double>& record) {
    return std::any_of(record.begin(), record.end(), dense);
  };
  return dense(run.source_pressure_pa) || any(run.pressure_pa) ||
         any(run.channels.source_pressure_pa);
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
  records.dense = HoldsDenseGas(run);
  return records;
}

}  // namespace plenum::calibration
