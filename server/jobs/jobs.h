// Long work off the request threads: a bounded queue, a few workers, progress, cancel. Jobs of the
// highest priority go first; of these clients take turns: the next job is of the one with the
// fewest at work and, of these, of the one who has waited longest for a turn; the jobs of one
// client are begun in the order in which they came.
//
// A job is on disk from before its id is given out until it is old
// (catalog/store/jobs/job_store.h). One that was queued or running when the service ended, in
// whatever way, is done again by the next, unless its own computation crashed the service twice
// (server/jobs/job_recovery.h); one that ended stays readable. Only the progress of a running job
// is kept in memory alone.
#ifndef PLENUM_SERVER_JOBS_JOBS_H_
#define PLENUM_SERVER_JOBS_JOBS_H_

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/jobs/client_turns.h"
#include "server/jobs/job_queue.h"
#include "server/jobs/job_turns.h"

namespace plenum::server {

class Jobs : public JobQueue {
 public:
  // Takes up what is unfinished of `kind` in the store. `turns` are those of all kinds.
  Jobs(catalog::JobStore& store, JobTurns& turns, std::string kind, Work work,
       const JobOptions& options);
  ~Jobs() override;
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // `changed` is called whenever a job has changed. It must not call back.
  void OnChange(std::function<void()> changed);

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

  // Interrupts what runs and joins the workers. What has not ended is queued on disk.
  void Stop();
  bool Stopping() const override;
  const JobOptions& options() const override { return options_; }

 private:
  struct Entry {
    Job job;
    std::string client;  // who takes turns with others
    bool of_sweep = false;
    int priority = 0;
    bool at_work = false;
    std::atomic<bool> cancelled = false;    // somebody asked
    std::atomic<bool> interrupted = false;  // the work saw that the service stops
  };
  using EntryPtr = std::shared_ptr<Entry>;

  EntryPtr Enqueue(const catalog::JobRecord& record);
  EntryPtr Next();
  EntryPtr TakeFromQueue();
  // So many more jobs of a client, as a sweep or not.
  std::optional<Submitted> RefuseToQueue(const std::string& client, std::size_t count = 1,
                                         bool as_sweep = false) const;
  void Changed() const;
  void WorkLoop();
  void Run(const EntryPtr& entry);
  api::Parsed<api::Json> Outcome(Entry& entry);
  void CancelAll(const std::vector<std::string>& ids);
  void End(const std::vector<EntryPtr>& entries, JobStatus status, const api::Json& result,
           const std::string& failure);
  EntryPtr Find(const std::string& id) const;

  catalog::JobStore& store_;
  JobTurns& turns_;
  const std::string kind_;
  const Work work_;
  const JobOptions options_;
  std::mutex submitting_;  // taken before mutex_
  mutable std::mutex mutex_;
  std::condition_variable work_ready_;
  std::function<void()> on_change_;
  std::map<std::string, EntryPtr> entries_;  // unfinished, or not on disk as ended
  std::deque<EntryPtr> queue_;               // those that run alone first
  ClientTurns clients_;
  std::atomic<bool> stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOBS_H_
