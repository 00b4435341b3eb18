// evaluation/1 becomes evaluation_answer/1: one given design.
#ifndef PLENUM_API_DESIGN_EVALUATION_H_
#define PLENUM_API_DESIGN_EVALUATION_H_

#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"

namespace plenum::api {

// How a combination of parts (combination.h) does at given settings, whatever it meets: no search.
// `works` is false, without figures, where the parts do not stand the source pressure (its range is
// given, null where there is none) or where a stroke takes longer than half of the period.
Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_EVALUATION_H_
