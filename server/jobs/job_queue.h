// Long work off the request threads, as those see it who ask for it: jobs of one kind.
#ifndef PLENUM_SERVER_JOBS_JOB_QUEUE_H_
#define PLENUM_SERVER_JOBS_JOB_QUEUE_H_

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/call/service_limits.h"
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
  catalog::Revision catalogue;  // its number and hash
  std::string sweep;            // the id of the sweep that it belongs to, empty for none
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
  // The same of jobs of sweeps, which count by themselves.
  std::size_t swept_queued_max = 4096;
  std::size_t swept_queued_per_client_max = 512;
};

inline JobQuota QuotaOf(const JobOptions& options) {
  return {options.workers, options.queued_max, options.queued_per_client_max,
          options.swept_queued_max, options.swept_queued_per_client_max};
}

struct QueueLimits {
  std::size_t all = 0, of_client = 0;
};
inline QueueLimits LimitsOf(const JobOptions& options, bool as_sweep) {
  return as_sweep ? QueueLimits{options.swept_queued_max, options.swept_queued_per_client_max}
                  : QueueLimits{options.queued_max, options.queued_per_client_max};
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

// Beside a file a service has its own jobs (server/jobs/jobs.h); services of a catalogue on a
// server share them (server/jobs/shared_jobs.h).
// The sweep that has the key of this one, if there is one.
template <typename Store>
std::optional<Submitted> KnownSweep(const Store& store, const catalog::SweepRecord& sweep) {
  if (sweep.by.key.empty()) return std::nullopt;
  const auto known = store.FindSweepKey(sweep.kind, sweep.by.key);
  if (!known) return std::nullopt;
  if (known->by.request != sweep.by.request) return Submitted{Submitted::kKeyReused, ""};
  return Submitted{Submitted::kRepeated, known->id};
}

// How many sweeps a list holds.
inline constexpr int kSweepsListed = 200;

class JobQueue {
 public:
  virtual ~JobQueue() = default;

  // Refused when the queue is full or the service is stopping. Throws StoreError when the job
  // cannot be written to disk. `order.kind` is set here.
  virtual Submitted Submit(catalog::JobOrder order) = 0;
  // All jobs of a sweep or none of them; `sweep` says who asks, of which catalogue, and its plan.
  // The id is that of the sweep.
  virtual Submitted SubmitSweep(catalog::SweepRecord sweep,
                                std::vector<catalog::JobOrder> orders) = 0;
  virtual std::optional<catalog::SweepRecord> FindSweep(const std::string& id) const = 0;
  virtual std::vector<catalog::SweepRecord> Sweeps() const = 0;  // newest first, without plans
  // Its jobs in the order of the patches; those that are no longer kept are missing.
  virtual std::vector<catalog::JobRecord> OfSweep(const std::string& id) const = 0;
  // The job without the result of one that ended, and that result put into it.
  virtual std::optional<Job> Look(const std::string& id) const = 0;
  virtual void AddResult(Job& job) const = 0;
  // The result of a job that has one, compressed once for all who read it; nothing where it is not
  // to be had at once.
  std::shared_ptr<const Deflated> Compressed(const Job& job) const {
    return results_.Compressed(job.result);
  }
  std::optional<Job> Get(const std::string& id) const {  // both
    auto job = Look(id);
    if (job) AddResult(*job);
    return job;
  }
  virtual std::vector<Job> List() const = 0;  // newest first, without results
  virtual std::size_t Count(JobStatus status) const = 0;
  // Asks the job to stop; no effect on one that has ended. False if there is none.
  virtual bool Cancel(const std::string& id) = 0;
  // The same of all jobs of a sweep; what waits is cancelled at once and together.
  virtual void CancelSweep(const std::string& id) = 0;
  // Queues a job that failed or was cancelled once more, as it was ordered, without its outcome.
  // Throws StoreError when that cannot be written to disk.
  virtual Asked Again(const std::string& id) = 0;
  virtual bool Stopping() const = 0;
  virtual const JobOptions& options() const = 0;

 protected:
  mutable StoredResults results_;
};

// Without the result; its revision is that of its ending, if it has ended.
Job ToJob(const catalog::JobRecord& record);
std::string TextOf(const api::Json& json);  // empty for null
std::string RandomId();                     // 64 random bits
// With ids of their own, as those of the sweep.
std::vector<catalog::NewJob> JobsOf(catalog::SweepRecord& sweep,
                                    std::vector<catalog::JobOrder> orders);

// The outcome of the work, whatever it throws.
api::Parsed<api::Json> OutcomeOf(const Work& work, const catalog::JobOrder& order,
                                 const std::string& id, const JobControl& control);
// In one line, for people.
std::string WordsOf(const api::Errors& errors);

// False, and a line of the log that begins with `about`, where a store cannot do it now: the
// service goes on without.
bool TryStore(const api::Json& about, const std::function<void()>& act);

// Requests go before this thread, however nice the service itself is.
void WorkBehindRequests();
// Runs `work`; what it had goes back to the system where that was much.
void ReturnMemoryAfter(const std::function<void()>& work);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_QUEUE_H_
