// The jobs of a service: its own beside a file, those of all services on a server.
#ifndef PLENUM_SERVER_JOBS_SERVICE_JOBS_H_
#define PLENUM_SERVER_JOBS_SERVICE_JOBS_H_

#include <filesystem>
#include <functional>
#include <memory>

#include "server/jobs/job_queue.h"

namespace plenum::server {

struct ServiceWorks {
  Work design, diagnosis;
};

class ServiceJobs {
 public:
  virtual ~ServiceJobs() = default;
  virtual JobQueue& designs() = 0;
  virtual JobQueue& diagnoses() = 0;
  virtual catalog::QueueState Queue() const = 0;  // of all kinds
  // `changed` is called whenever a job has changed, on a server some tenths of a second later. It
  // must not call back. None: no longer.
  virtual void OnChange(std::function<void()> changed) = 0;
  // Interrupts what runs; it is queued for whoever comes next.
  virtual void Stop() = 0;
};

// Opens the jobs of the catalogue, goes on with those that did not end, and begins to work. Throws
// StoreError.
std::unique_ptr<ServiceJobs> OpenServiceJobs(const std::filesystem::path& catalogue,
                                             const ServiceWorks& works, const JobOptions& options,
                                             const catalog::JobsKept& kept);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_SERVICE_JOBS_H_
