// Answers out of the project's catalogue, and what `verify` says of them.
#ifndef PLENUM_TESTS_API_VERIFIED_H_
#define PLENUM_TESTS_API_VERIFIED_H_

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/reader.h"

namespace plenum::api {

struct Catalogue {
  catalog::Revision revision;
  std::vector<catalog::Part> parts;
};
const Catalogue& Project();

Json Example(const std::string& name);  // a request
Json Answered(const Json& request);     // as it is read back from a file

// The pointers of what is wrong with a request, each with a space behind it.
std::string Pointers(const Json& request);

// A request for pumps that may be without a reservoir: pairs of slow fingers.
Json SlowFingers(int groups);

// A design beside the request that it is to meet, as `plenum evaluate` takes them.
Parsed<Json> Evaluated(const Json& request, const Json& design);

Json Verified(const Json& answer);
// Stopped the time after it has been asked so often whether to stop.
Json VerifiedWithin(const Json& answer, int looks);
// Names of the checks that refuse, and what they say.
std::string RefusalsIn(const Json& verified);
std::string Refusals(const Json& answer);

struct Tampering {
  const char* name;
  const char* check;  // that must refuse
  std::function<void(Json&)> tamper;
};
// Each changes the answer and is refused by its check.
void ExpectRefused(const Json& answer, std::span<const Tampering> tamperings);

}  // namespace plenum::api

#endif  // PLENUM_TESTS_API_VERIFIED_H_
