// Readings that may be absolute, where no heading says so.
#ifndef PLENUM_API_MEASURE_CSV_GAUGE_CHECK_H_
#define PLENUM_API_MEASURE_CSV_GAUGE_CHECK_H_

#include "api/measure/csv/recording.h"

namespace plenum::api {

// A column of pressures whose heading says neither gauge nor absolute is gauge, which is noted.
// It is asked for
//   if it is the actuator's and no reading lies below 0.8 times the ambient pressure, unless
//   `is_settled`: an assumption of the measurement says it;
//   if another column of pressures says absolute.
void CheckGauge(bool is_settled, Recording& recording);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_GAUGE_CHECK_H_
