// Long work over HTTP: one kind of job, its path and what people call it.
#ifndef PLENUM_SERVER_RESOURCES_JOBS_RESOURCE_H_
#define PLENUM_SERVER_RESOURCES_JOBS_RESOURCE_H_

#include <memory>
#include <string>

#include "server/call/reply.h"
#include "server/jobs/job_queue.h"

namespace plenum::server {

struct JobsResource {
  JobQueue* jobs;
  std::string path;  // "/v1/designs"
  std::string noun;  // "design"
};

// The query's `priority`, which may put a job behind those of others: -100 to 0, its default.
int ReadPriority(const Call& call, api::Errors& errors);
// Seconds of "Prefer: wait=N"; 0 without one.
int WaitSeconds(const Call& call);
// A place among those who wait for their job, until its last copy goes; none where too many do.
std::shared_ptr<void> EnterWaiting();
// 429: the queue is full, or so many jobs of the client wait.
Reply FullQueue(const JobsResource& resource, bool of_client, bool as_sweep = false);

// A new job, or the one that has the order's key. 202 with { id, status, links }, or with "Prefer:
// wait=N" 200 with the result when it comes within N seconds. Who waits holds no thread; beyond
// kWaitingMax it is 202 at once. 429 when the queue is full, 422 when the key stands for another
// request.
Reply StartJob(const JobsResource& resource, const Call& call, catalog::JobOrder order);
// { waiting, running, workers, threads, oldest }: when the one that waits longest was posted, null
// without one.
Reply GetQueue(const catalog::QueueState& queue);
Reply ListJobs(const JobsResource& resource);
// { id, name, status, submitted_at, ended_at, attempts, crashes, last_crash, catalogue_revision,
// progress, links, result }, and `detail` where it failed. With an ETag, and 304, once it has
// ended.
Reply GetJob(const JobsResource& resource, const Call& call);
// 202 with { id, status, links } and Location; 409 for a job that is under way or done, 429 when
// the queue is full.
Reply DoJobAgain(const JobsResource& resource, const Call& call);
Reply CancelJob(const JobsResource& resource, const Call& call);
// Server-sent events: `progress` at every change, `end` when the job has ended. 429 when too many
// streams are open.
Reply JobEvents(const JobsResource& resource, const Call& call);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_RESOURCES_JOBS_RESOURCE_H_
