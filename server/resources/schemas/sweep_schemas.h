// Schemas of sweeps and their tables.
#ifndef PLENUM_SERVER_RESOURCES_SCHEMAS_SWEEP_SCHEMAS_H_
#define PLENUM_SERVER_RESOURCES_SCHEMAS_SWEEP_SCHEMAS_H_

#include "api/json/json.h"

namespace plenum::server {

// By name: Sweep, SweepAccepted, Sweeps, SweepWithJobs, SweepTable, SweepTableOrValid.
api::Json SweepSchemas();
// One that is valid with the catalogue that comes with plenum.
api::Json ExampleSweep();

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SCHEMAS_SWEEP_SCHEMAS_H_
