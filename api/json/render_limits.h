// The limits of request_limits.h as JSON, by name.
#ifndef PLENUM_API_JSON_RENDER_LIMITS_H_
#define PLENUM_API_JSON_RENDER_LIMITS_H_

#include "api/json/json.h"

namespace plenum::api {

Json RenderRequestLimits();

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_RENDER_LIMITS_H_
