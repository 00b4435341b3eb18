// A saved answer, designs/1, checked from scratch: verification/1.
#ifndef PLENUM_API_DESIGN_VERIFICATION_H_
#define PLENUM_API_DESIGN_VERIFICATION_H_

#include <optional>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "catalog/store/store.h"
#include "verify/verify.h"

namespace plenum::api {

// { "schema": "verification/1", "accepted", "checks": [{ "check", "ok", "detail" }],
//   "not_rechecked": [{ "what", "combinations" }], "stopped" }. Errors where `result` is no answer
//   of
// one list by one objective, or its echoed request does not fit the catalogue. `revision` names
// `parts`. Once `stop` says so, what is left is not looked at: "stopped", and never accepted.
//
// With `brute_force` every combination is looked at, and "brute_force" counts them by outcome;
// "cancelled" where that was stopped. An error where there are more than `combinations_max`.
struct BruteForce {
  long long combinations_max = verify::kBruteForceMax;
  std::function<void(double share)> progress;
};
Parsed<Json> VerifyAnswer(const Json& result, const std::vector<catalog::Part>& parts,
                          const catalog::Revision& revision,
                          const std::optional<BruteForce>& brute_force = std::nullopt,
                          const std::function<bool()>& stop = {});

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_VERIFICATION_H_
