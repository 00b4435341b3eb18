// The limits of limits.h as JSON, by name.
#ifndef PLENUM_API_RENDER_LIMITS_H_
#define PLENUM_API_RENDER_LIMITS_H_

#include "api/json.h"

namespace plenum::api {

Json RenderRequestLimits();

}  // namespace plenum::api

#endif  // PLENUM_API_RENDER_LIMITS_H_
