// evaluation/1 becomes evaluation_answer/1: one given design.
#ifndef PLENUM_API_DESIGN_GIVEN_EVALUATION_H_
#define PLENUM_API_DESIGN_GIVEN_EVALUATION_H_

#include <vector>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"

namespace plenum::api {

// How a combination of parts (combination.h) does at given settings, whatever it meets: no search.
// `works` is false, without figures, where the parts do not stand the source pressure (its range is
// given, null where there is none) or where a stroke takes longer than half of the period. Where
// the simulator does not find that out, or not in time, `works` is null and `detail` says why.
// With a design of a ranked list as `beside` the answer says in `why_not_first` (why_not_first.h)
// why the given one is not before it.
Parsed<Json> RunEvaluation(const Json& request, const std::vector<catalog::Part>& parts,
                           const std::vector<catalog::ModelRevision>& models,
                           double seconds_max = kEvaluationSecondsMax);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_EVALUATION_H_
