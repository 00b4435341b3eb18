// POST /v1/designs: a search as a job.
#ifndef PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_

#include <string>

#include "server/call/shared_catalog.h"
#include "server/jobs/job_memory.h"
#include "server/resources/jobs_resource.h"

namespace plenum::server {

// Ranks the designs of an order.
Work DesignWork(SharedCatalog& catalog, JobMemory& memory);

// With "validate_only=true" in the query nothing is started: 200 with { "valid": true }, or the 422
// that the request would get.
Reply PostDesign(SharedCatalog& catalog, const JobsResource& designs, const Call& call);

// A unit (FMU) as a file to keep.
Reply UnitReply(const std::string& unit);
// "ID/RANK" in the path: that design of a job's answer as a unit for co-simulation, of the parts as
// they were when the job was posted. 404 without such a job or design, 409 while it has no answer.
Reply GetUnit(SharedCatalog& catalog, const JobsResource& designs, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_
