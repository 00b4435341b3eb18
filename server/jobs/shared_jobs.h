// Jobs of one kind of all services of a catalogue on a server, as one of the services sees them.
// Who does them: server/jobs/job_worker.h.
#ifndef PLENUM_SERVER_JOBS_SHARED_JOBS_H_
#define PLENUM_SERVER_JOBS_SHARED_JOBS_H_

#include <atomic>
#include <functional>
#include <string>

#include "server/jobs/job_queue.h"

namespace plenum::server {

// Ended jobs that stay on a server, of each kind; and how many a list holds.
inline constexpr catalog::JobsKept kSharedJobsKept{100'000, std::int64_t{16} << 30};
inline constexpr int kSharedJobsListed = 1'000;

class SharedJobs : public JobQueue {
 public:
  // `changed` is called when this service queued or cancelled a job.
  SharedJobs(catalog::SharedJobStore& store, std::string kind, const JobOptions& options,
             std::function<void()> changed);

  Submitted Submit(catalog::JobOrder order) override;
  Submitted SubmitSweep(catalog::SweepRecord sweep, std::vector<catalog::JobOrder> orders) override;
  std::optional<catalog::SweepRecord> FindSweep(const std::string& id) const override;
  std::vector<catalog::SweepRecord> Sweeps() const override;
  std::vector<catalog::JobRecord> OfSweep(const std::string& id) const override;
  std::optional<Job> Look(const std::string& id) const override;
  void AddResult(Job& job) const override;
  std::vector<Job> List() const override;
  std::size_t Count(JobStatus status) const override;
  bool Cancel(const std::string& id) override;
  void CancelSweep(const std::string& id) override;
  Asked Again(const std::string& id) override;

  void Stop() { stopping_ = true; }
  bool Stopping() const override { return stopping_; }
  const JobOptions& options() const override { return options_; }

 private:
  // So many more jobs of a client, as a sweep or not.
  std::optional<Submitted> RefuseToQueue(const std::string& client, std::size_t count = 1,
                                         bool as_sweep = false) const;

  catalog::SharedJobStore& store_;
  const std::string kind_;
  const JobOptions options_;
  const std::function<void()> changed_;
  std::atomic<bool> stopping_ = false;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_SHARED_JOBS_H_
