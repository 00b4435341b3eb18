// map/1 becomes map_answer/1.
#ifndef PLENUM_API_SIMULATE_MAP_H_
#define PLENUM_API_SIMULATE_MAP_H_

#include "api/json/json.h"

namespace plenum::api {

// At most 100,000 grid points, 2,000 with a compressor; an error if they take more than 60 s.
Parsed<Json> RunMap(const Json& request);

}  // namespace plenum::api

#endif  // PLENUM_API_SIMULATE_MAP_H_
