// Curves of a diagnosis: simulation/1 with "from" becomes curves/1.
//   { "schema": "simulation/1", "from": the diagnosis/1, "run": "r1", "model": "after",
//     "measurement": the measurement/1, where the answer names readings by hash alone }
// Without "run" every run, without "model" that of "after".
#ifndef PLENUM_API_MEASURE_CURVES_H_
#define PLENUM_API_MEASURE_CURVES_H_

#include "api/json/json.h"
#include "api/json/request_limits.h"

namespace plenum::api {

bool AsksForCurves(const Json& request);

// The pressures at the readings as the sensor should have read them, simulated from the numbers
// that the answer states, and their errors beside those that it states.
Parsed<Json> RunCurves(const Json& request, double seconds_max = kSimulationSecondsMax);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CURVES_H_
