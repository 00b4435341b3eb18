// The service's log: one JSON object a line on standard error. It names routes and callers, never
// queries, bodies or tokens.
#ifndef PLENUM_SERVER_CALL_REQUEST_LOG_H_
#define PLENUM_SERVER_CALL_REQUEST_LOG_H_

#include <string>

#include "api/json/json.h"

namespace plenum::server {

// Adds the time to `fields` and writes the line, or drops it where the reader of the log does not
// keep up: a request never waits for the log.
void Log(const api::Json& fields);

// Lines that were dropped.
long long DroppedLogLines();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_REQUEST_LOG_H_
