// Long work off the request threads: a bounded queue, a few workers, progress, cancel. Clients take
// turns: the next job is of the one with the fewest at work and, of these, of the one who has
// waited longest for a turn; the jobs of one client are begun in the order in which they came.
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

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/call/service_limits.h"
#include "server/jobs/client_turns.h"
#include "server/jobs/job_turns.h"
#include "server/jobs/stored_results.h"

namespace plenum::server {

using catalog::JobStatus;

// A job at one moment.
struct Job {
  std::int64_t number = 0;  // grows from job to job
  std::string id;
  std::string name;
  JobStatus status = JobStatus::kQueued;
  api::Json progress;  // null until the first report
  Bytes result;        // JSON, where there is one: a cancelled job may have one, too
  std::string failure;
  int attempts = 0;        // how often it was begun and not stopped in an orderly way
  int crashes = 0;         // how often its computation ended the program
  std::string crash;       // what is known of the last one
  bool alone = false;      // no other job may run beside it
  long long revision = 0;  // another one after every change; of no other ending
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
  std::size_t queued_max = 512;
  std::size_t queued_per_client_max = 32;
};

inline JobQuota QuotaOf(const JobOptions& options) {
  return {options.workers, options.queued_max, options.queued_per_client_max};
}

struct Submitted {
  // kClientRefused: as many jobs of this client wait as may.
  enum { kAccepted, kRepeated, kKeyReused, kRefused, kClientRefused } status = kAccepted;
  std::string id;  // kAccepted; kRepeated: of the job that has the key
};

// What became of a request to do a job again.
enum class Asked {
  kQueued,
  kUnknown,   // there is no such job
  kUnderWay,  // it has not ended
  kDone,      // its result stands
  kRefused,   // the queue is full or the service is stopping
  kClientRefused
};

class Jobs {
 public:
  // Takes up what is unfinished of `kind` in the store. `turns` are those of all kinds.
  Jobs(catalog::JobStore& store, JobTurns& turns, std::string kind, Work work,
       const JobOptions& options);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // `changed` is called whenever a job has changed. It must not call back.
  void OnChange(std::function<void()> changed);

  // Refused when the queue is full or the service is stopping. Throws StoreError when the job
  // cannot be written to disk. `order.kind` is set here.
  Submitted Submit(catalog::JobOrder order);
  std::optional<Job> Get(const std::string& id) const;
  // The same without the result of a job that ended, and that result put into it.
  std::optional<Job> Look(const std::string& id) const;
  void AddResult(Job& job) const;
  std::vector<Job> List() const;  // newest first, without results
  // Asks the job to stop; no effect on one that has ended. False if there is none.
  bool Cancel(const std::string& id);
  // Queues a job that failed or was cancelled once more, as it was ordered, without its outcome.
  // Throws StoreError when that cannot be written to disk.
  Asked Again(const std::string& id);

  // Interrupts what runs and joins the workers. What has not ended is queued on disk.
  void Stop();
  bool Stopping() const;
  const JobOptions& options() const { return options_; }

 private:
  struct Entry {
    Job job;
    std::string client;  // who takes turns with others
    bool at_work = false;
    std::atomic<bool> cancelled = false;    // somebody asked
    std::atomic<bool> interrupted = false;  // the work saw that the service stops
  };
  using EntryPtr = std::shared_ptr<Entry>;

  EntryPtr Enqueue(const catalog::JobRecord& record);
  EntryPtr Next();
  EntryPtr TakeFromQueue();
  std::optional<Submitted> RefuseToQueue(const std::string& client) const;
  void Changed() const;
  void WorkLoop();
  void Run(Entry& entry);
  api::Parsed<api::Json> Outcome(Entry& entry);
  void End(Entry& entry, JobStatus status, const api::Json& result, const std::string& failure);
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
  mutable StoredResults results_;
  std::map<std::string, EntryPtr> entries_;  // unfinished, or not on disk as ended
  std::deque<EntryPtr> queue_;               // those that run alone first
  ClientTurns clients_;
  std::atomic<bool> stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOBS_H_
