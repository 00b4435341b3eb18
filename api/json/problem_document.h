// Errors as a problem document (RFC 9457, application/problem+json).
#ifndef PLENUM_API_JSON_PROBLEM_DOCUMENT_H_
#define PLENUM_API_JSON_PROBLEM_DOCUMENT_H_

#include <string>

#include "api/json/json.h"

namespace plenum::api {

// { "type": "about:blank", "title": …, "status": …, "errors": [{ "pointer", "detail" }] }. The
// title is the phrase that HTTP has for the status. Of more than 100 errors the first 100 are given
// and one more that counts the rest; without any, `errors` is left out.
Json ProblemDocument(int status, const Errors& errors);
// The same with one sentence on this occurrence in `detail`.
Json ProblemDocument(int status, const std::string& detail);

// One line for a person per error: "/actuators/0/count: must be ≥ 1 and ≤ 64, not 0".
std::string Lines(const Errors& errors);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_PROBLEM_DOCUMENT_H_
