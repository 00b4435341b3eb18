// evaluation/1 becomes a functional mock-up unit: the given design, for a robot's simulator.
#ifndef PLENUM_API_DESIGN_GIVEN_UNIT_OF_DESIGN_H_
#define PLENUM_API_DESIGN_GIVEN_UNIT_OF_DESIGN_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "catalog/fields/part.h"
#include "catalog/store/model_revision.h"

namespace plenum::api {

// The bytes of the file (fmu/unit_file.h). Refused where the design does not work at its settings,
// and with a saved model, whose effects a unit does not hold.
Parsed<std::string> MakeUnitFile(const Json& request, const std::vector<catalog::Part>& parts,
                                 const std::vector<catalog::ModelRevision>& models,
                                 double seconds_max = kEvaluationSecondsMax);

// evaluation/1 of the design of that rank of an answer, designs/1.
Parsed<Json> EvaluationOfRank(const Json& answer, int rank);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_GIVEN_UNIT_OF_DESIGN_H_
