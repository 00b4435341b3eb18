// "valve" of a measured run: commands whose instants may be known to an uncertainty, or not at all.
//   { "t_s": 0.3, "state": "inflate", "uncertainty_s": 0.02 }: fitted, 0.02 one standard deviation
//   { "t_s": 0.3, "state": "inflate", "uncertainty_s": "unknown" }: found, from 0.3 on
//   { "t_s": "unknown", "state": "inflate" }: found in the readings
#ifndef PLENUM_API_MEASURE_VALVE_MEASURED_VALVE_H_
#define PLENUM_API_MEASURE_VALVE_MEASURED_VALVE_H_

#include "api/json/reader.h"
#include "calibration/values/dataset.h"

namespace plenum::api {

// "valve" or "cycle" of the run. Instants that are not known are NaN.
void ReadMeasuredValve(Reader& owner, calibration::Run& run);

// Gives those a first guess, once the run has its readings.
void FindInstants(Reader& owner, calibration::Run& run);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_VALVE_MEASURED_VALVE_H_
