// /v1/designs: a search as a job.
#ifndef PLENUM_SERVER_DESIGNS_RESOURCE_H_
#define PLENUM_SERVER_DESIGNS_RESOURCE_H_

#include "server/jobs.h"
#include "server/reply.h"
#include "server/shared_catalog.h"

namespace plenum::server {

// With "validate_only=true" in the query nothing is started: 200 with { "valid": true }, or the 422
// that the request would get. Otherwise 202 with { id, status, links }, or with "Prefer: wait=N"
// 200 with the result when it comes within N seconds. At most a quarter of the request threads wait
// at a time; beyond that it is 202 at once.
Reply PostDesign(SharedCatalog& catalog, Jobs& jobs, const Call& call);
Reply ListDesigns(const Jobs& jobs);
// { id, name, status, progress, result, links }.
Reply GetDesign(const Jobs& jobs, const Call& call);
Reply CancelDesign(Jobs& jobs, const Call& call);
// Server-sent events: `progress` at every change, `end` when the job has ended. 429 when too many
// streams are open.
Reply DesignEvents(const Jobs& jobs, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_DESIGNS_RESOURCE_H_
