// How much a client wants one of several forms of an answer (RFC 9110, 12.4.2, 12.5.1, 12.5.3).
#ifndef PLENUM_SERVER_CALL_CODING_ACCEPTED_H_
#define PLENUM_SERVER_CALL_CODING_ACCEPTED_H_

#include <string_view>
#include <vector>

#include "server/call/reply.h"

namespace plenum::server {

// The weight, 0 to 1, that the list of a header gives to the first of `names` that it holds; 0
// where it holds none.
double Wanted(std::string_view list, const std::vector<std::string_view>& names);

// Whether Accept-Encoding prefers gzip, or takes it as well as any other.
bool WantsGzip(const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_CODING_ACCEPTED_H_
