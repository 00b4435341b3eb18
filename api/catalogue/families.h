// The families of parts and their fields as JSON.
#ifndef PLENUM_API_CATALOGUE_FAMILIES_H_
#define PLENUM_API_CATALOGUE_FAMILIES_H_

#include "api/json/json.h"

namespace plenum::api {

// { "families": [{ "name", "numbers": [{ "name", "min", "max", "required", "meaning" }], "texts":
// [{ "name", "allowed": texts, none for any, "required", "meaning" }], "has_curve" }] }.
Json RenderFamilies();

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_FAMILIES_H_
