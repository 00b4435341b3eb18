// /v1/sweeps: many designs at once, one job each, one table as their answer.
#ifndef PLENUM_SERVER_RESOURCES_SWEEPS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_SWEEPS_RESOURCE_H_

#include "server/call/shared_catalog.h"
#include "server/resources/jobs_resource.h"

namespace plenum::server {

// `designs` are the jobs of which a sweep is made.
//
// 202 with { id, status, links }, or with "Prefer: wait=N" 200 with the table when all jobs end
// within N seconds. Nothing is stored where one patch is invalid (422) or not all of its jobs find
// a place in the queue (429). With "validate_only=true" in the query nothing is started.
Reply PostSweep(SharedCatalog& catalog, const JobsResource& designs, const Call& call);
// { sweeps: [{ id, name, status, submitted_at, ended_at, catalogue_revision, jobs, links }] };
// `jobs` counts its jobs by status. The status is queued until the first job begins, running until
// the last one has ended; then cancelled or failed where a job is, else done.
Reply ListSweeps(const JobsResource& designs);
// One of them, with its jobs: patches: [{ name, id, status, link }], null where a job is no longer
// kept.
Reply GetSweep(const JobsResource& designs, const Call& call);
// sweep_table/1, as it is now; as CSV with "format=csv" in the query or where Accept prefers it.
Reply GetSweepTable(const JobsResource& designs, const Call& call);
// Ends its jobs that have not ended; what is done stays.
Reply CancelSweep(const JobsResource& designs, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_SWEEPS_RESOURCE_H_
