// A request to read a recording, for the service: table and rig in, measurement out.
#ifndef PLENUM_API_MEASURE_CSV_RECORDING_REQUEST_H_
#define PLENUM_API_MEASURE_CSV_RECORDING_REQUEST_H_

#include "api/json/json.h"

namespace plenum::api {

// { "schema": "recording/1", "csv" (text) or "csv_base64" (bytes in any encoding), "rig" (a rig, or
// a measurement without readings; may be missing), "table" (table_options.h) } gives
// { "schema": "recording_answer/1", "measurement", "understood", "questions" }. The measurement is
// null while questions are open but for those of option "valve".
Parsed<Json> ReadRecordingRequest(const Json& request);

// Schema and example of the request, schema of the answer.
Json DescribeRecording();
Json ExampleRecording();
Json DescribeRecordingAnswer();

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_CSV_RECORDING_REQUEST_H_
