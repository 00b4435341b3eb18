// The measurement that an answer was made from, as the answer carries it: the document itself, in
// which lists of readings with more than kInputsListed values stand as { "values", "sha256" }.
#ifndef PLENUM_API_MEASURE_INPUTS_DOCUMENT_H_
#define PLENUM_API_MEASURE_INPUTS_DOCUMENT_H_

#include <cstddef>

#include "api/json/json.h"

namespace plenum::api {

inline constexpr std::size_t kInputsListed = 20'000;

Json InputsOf(const Json& measurement);

// The whole document again, with the lists that `inputs` lacks from `measurement`; null: there is
// none. Lists that are not those of which the hash stands are errors.
Parsed<Json> WithReadings(Json inputs, const Json* measurement);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_INPUTS_DOCUMENT_H_
