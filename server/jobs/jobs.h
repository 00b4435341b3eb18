// Long work off the request threads: a bounded queue, a few workers, progress, cancel.
//
// A job is on disk from before its id is given out until it is old (catalog/store/job_store.h). One
// that was queued or running when the service ended, in whatever way, is done again by the next,
// unless its own computation crashed the service twice (server/jobs/job_recovery.h); one that ended
// stays readable. Only the progress of a running job is kept in memory alone.
#ifndef PLENUM_SERVER_JOBS_JOBS_H_
#define PLENUM_SERVER_JOBS_JOBS_H_

#include <atomic>
#include <chrono>
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

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/call/service_limits.h"
#include "server/jobs/job_turns.h"

namespace plenum::server {

using catalog::JobStatus;

// A job at one moment.
struct Job {
  std::int64_t number = 0;  // grows from job to job
  std::string id;
  std::string name;
  JobStatus status = JobStatus::kQueued;
  api::Json progress;  // null until the first report
  api::Json result;    // null until there is one; a cancelled job may have one
  std::string failure;
  int attempts = 0;        // how often it was begun and not stopped in an orderly way
  int crashes = 0;         // how often its computation ended the program
  std::string crash;       // what is known of the last one
  bool alone = false;      // no other job may run beside it
  long long revision = 0;  // grows with every change
  std::string submitted_at, ended_at;
  std::int64_t catalogue_revision = 0;
  std::string catalogue_hash;
};

// What the work of a job sees of its job.
struct JobControl {
  std::function<bool()> cancelled;
  std::function<void(api::Json)> report;
};
// The result, from nothing but the order; or why there can be none.
using Work =
    std::function<api::Parsed<api::Json>(const catalog::JobOrder& order, const JobControl&)>;

struct JobOptions {
  int workers = 2;
  std::size_t queued_max = 32;
};

inline JobQuota QuotaOf(const JobOptions& options) { return {options.workers, options.queued_max}; }

struct Submitted {
  enum { kAccepted, kRepeated, kKeyReused, kRefused } status = kAccepted;
  std::string id;  // kAccepted; kRepeated: of the job that has the key
};

// What became of a request to do a job again.
enum class Asked {
  kQueued,
  kUnknown,   // there is no such job
  kUnderWay,  // it has not ended
  kDone,      // its result stands
  kRefused    // the queue is full or the service is stopping
};

class Jobs {
 public:
  // Takes up what is unfinished of `kind` in the store. `turns` are those of all kinds.
  Jobs(catalog::JobStore& store, JobTurns& turns, std::string kind, Work work,
       const JobOptions& options);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // Refused when the queue is full or the service is stopping. Throws StoreError when the job
  // cannot be written to disk. `order.kind` is set here.
  Submitted Submit(catalog::JobOrder order);
  std::optional<Job> Get(const std::string& id) const;
  std::vector<Job> List() const;  // newest first, without results
  // Asks the job to stop; no effect on one that has ended. False if there is none.
  bool Cancel(const std::string& id);
  // Queues a job that failed or was cancelled once more, as it was ordered, without its outcome.
  // Throws StoreError when that cannot be written to disk.
  Asked Again(const std::string& id);

  // Waits until the job has ended or passed `revision`, at most `timeout`; then the job as it is.
  std::optional<Job> WaitForChange(const std::string& id, long long revision,
                                   std::chrono::milliseconds timeout) const;
  // Waits until the job has ended, at most `timeout`.
  std::optional<Job> WaitForEnd(const std::string& id, std::chrono::milliseconds timeout) const;

  // Interrupts what runs, releases who waits, joins the workers. What has not ended is queued on
  // disk.
  void Stop();
  bool Stopping() const;
  const JobOptions& options() const { return options_; }

 private:
  struct Entry {
    Job job;
    std::atomic<bool> cancelled = false;    // somebody asked
    std::atomic<bool> interrupted = false;  // the work saw that the service stops
  };
  using EntryPtr = std::shared_ptr<Entry>;

  EntryPtr Enqueue(const catalog::JobRecord& record);
  EntryPtr Next();
  void WorkLoop();
  void Run(Entry& entry);
  api::Parsed<api::Json> Outcome(Entry& entry);
  void End(Entry& entry, JobStatus status, api::Json result, const std::string& failure);
  EntryPtr Find(const std::string& id) const;
  template <typename Predicate>
  std::optional<Job> WaitUntil(const std::string& id, std::chrono::milliseconds timeout,
                               Predicate done) const;

  catalog::JobStore& store_;
  JobTurns& turns_;
  const std::string kind_;
  const Work work_;
  const JobOptions options_;
  std::mutex submitting_;  // taken before mutex_
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::condition_variable work_ready_;
  std::map<std::string, EntryPtr> entries_;  // unfinished, or not on disk as ended
  std::deque<EntryPtr> queue_;               // those that run alone first
  std::atomic<bool> stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOBS_H_
