// POST /v1/designs: a search as a job.
#ifndef PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_

#include "server/call/shared_catalog.h"
#include "server/jobs/job_memory.h"
#include "server/resources/jobs_resource.h"

namespace plenum::server {

// Ranks the designs of an order.
Work DesignWork(SharedCatalog& catalog, JobMemory& memory);

// With "validate_only=true" in the query nothing is started: 200 with { "valid": true }, or the 422
// that the request would get.
Reply PostDesign(SharedCatalog& catalog, const JobsResource& designs, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_DESIGNS_RESOURCE_H_
