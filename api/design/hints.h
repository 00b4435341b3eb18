// What a request leaves out by naming its configurations.
#ifndef PLENUM_API_DESIGN_HINTS_H_
#define PLENUM_API_DESIGN_HINTS_H_

#include <vector>

#include "api/design/read/requirements_reader.h"

namespace plenum::api {

// Adds `hints` to an answer: configurations that the request did not name, one of which would do
// with a tenth less of the objective, or has a design where the named ones have none.
// Configurations that are named are never extended. Looked for in so much work at most, so that a
// hint may be missing, and never after the time limit; none for evacuated actuators, fronts and
// draws, whose configurations are not named, or whose list is not of one objective.
void AddHints(const DesignRequest& request, const optimizer::Answer& answer,
              const optimizer::SearchOptions& options, const std::vector<catalog::Part>& parts,
              Json& document);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_HINTS_H_
