// A saved answer, designs/1, checked from scratch: verification/1.
#ifndef PLENUM_API_VERIFY_H_
#define PLENUM_API_VERIFY_H_

#include "api/services.h"

namespace plenum::api {

// { "schema": "verification/1", "accepted", "checks": [{ "check", "ok", "detail" }],
//   "not_rechecked": [{ "what", "combinations" }] }. Errors where `result` is no answer of one list
// by one objective, or its echoed request does not fit the catalogue. `revision` names `parts`.
Parsed<Json> VerifyAnswer(const Json& result, const std::vector<catalog::Part>& parts,
                          const catalog::Revision& revision);

}  // namespace plenum::api

#endif  // PLENUM_API_VERIFY_H_
