// Schemas of what a diagnosis answers and of its curves.
#ifndef PLENUM_SERVER_RESOURCES_SCHEMAS_DIAGNOSIS_SCHEMAS_H_
#define PLENUM_SERVER_RESOURCES_SCHEMAS_DIAGNOSIS_SCHEMAS_H_

#include "api/json/json.h"

namespace plenum::server {

// By name: Diagnosis, Curves, CurvesRequest, SimulationOrCurves, ResponseOrCurves.
api::Json DiagnosisSchemas();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SCHEMAS_DIAGNOSIS_SCHEMAS_H_
