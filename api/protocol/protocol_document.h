// How to measure a part, and how precise it will be: the document protocol/1.
//
// { "part", "family", "sensor", "tests": [ { "protocol", "numbers": [ fields ], "steps": [ … ],
//   "equipment": { "bottle_l", "source_pressure_kpa_gauge", "sampling_hz", "duration_s",
//   "repeats", "samples", "check_bottle_l" }, "recording": { "template", "columns", "command" },
//   "precision": [ { "field", "uncertainty", "from_noise", "from_rig", "pressure_kpa_gauge",
//   "told", "how" } ], "warnings": [ … ] } ] }
// A part with a mass ends with the test "weighing". "equipment" and "recording" are null for tests
// that are read by hand. `uncertainty` is relative, one standard deviation, of all repeats;
// `from_rig` the part of it that comes from what is declared of the rig. `told` is false where it
// is above kMostUncertain (calibration/names), so that no recording of this test could be saved.
#ifndef PLENUM_API_PROTOCOL_PROTOCOL_DOCUMENT_H_
#define PLENUM_API_PROTOCOL_PROTOCOL_DOCUMENT_H_

#include "api/json/json.h"
#include "api/protocol/test_sensor.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Relative: what is known no better than this is not told by a test.
inline constexpr double kNothingTold = 1.0;

// A part of a family without a test has an empty list of tests.
Json RenderProtocol(const catalog::Part& part, const TestSensor& sensor);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_PROTOCOL_DOCUMENT_H_
