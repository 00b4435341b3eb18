// Long work off the request threads: a bounded queue, a few workers, progress, cancel.
// Jobs live in memory; of those that ended the newest are kept.
#ifndef PLENUM_SERVER_JOBS_H_
#define PLENUM_SERVER_JOBS_H_

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

#include "api/json.h"

namespace plenum::server {

enum class JobStatus { kQueued, kRunning, kDone, kCancelled, kFailed };
const char* Name(JobStatus status);
bool Ended(JobStatus status);

// A job at one moment.
struct Job {
  std::string id;
  std::string name;
  JobStatus status = JobStatus::kQueued;
  api::Json progress;  // null until the first report
  api::Json result;    // null until there is one; a cancelled job may have one
  std::string failure;
  long long revision = 0;  // grows with every change
};

// What the work of a job sees of its job.
struct JobControl {
  std::function<bool()> cancelled;
  std::function<void(api::Json)> report;
};
using Work = std::function<api::Json(const JobControl&)>;

struct JobOptions {
  int workers = 2;
  std::size_t queued_max = 32;
  std::size_t ended_kept = 256;
};

class Jobs {
 public:
  explicit Jobs(const JobOptions& options);
  ~Jobs();
  Jobs(const Jobs&) = delete;
  Jobs& operator=(const Jobs&) = delete;

  // The new job's id, or nothing when the queue is full or the service is stopping.
  std::optional<std::string> Submit(std::string name, Work work);
  std::optional<Job> Get(const std::string& id) const;
  std::vector<Job> List() const;  // newest first, without results
  // Asks the job to stop; no effect on one that has ended. False if there is none.
  bool Cancel(const std::string& id);

  // Waits until the job has ended or passed `revision`, at most `timeout`; then the job as it is.
  std::optional<Job> WaitForChange(const std::string& id, long long revision,
                                   std::chrono::milliseconds timeout) const;
  // Waits until the job has ended, at most `timeout`.
  std::optional<Job> WaitForEnd(const std::string& id, std::chrono::milliseconds timeout) const;

  // Cancels everything, releases who waits, joins the workers.
  void Stop();
  bool Stopping() const;
  const JobOptions& options() const { return options_; }

 private:
  struct Entry {
    Job job;
    Work work;
    long long number = 0;
    std::atomic<bool> cancelled = false;
  };
  using EntryPtr = std::shared_ptr<Entry>;

  void WorkLoop();
  void Run(Entry& entry);
  void CancelLocked(Entry& entry);
  void End(Entry& entry, JobStatus status);
  template <typename Predicate>
  std::optional<Job> WaitUntil(const std::string& id, std::chrono::milliseconds timeout,
                               Predicate done) const;

  const JobOptions options_;
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::condition_variable work_ready_;
  std::map<std::string, EntryPtr> entries_;
  std::deque<EntryPtr> queue_;
  std::deque<std::string> ended_;  // oldest first
  long long submitted_ = 0;
  bool stopping_ = false;
  std::vector<std::thread> workers_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_H_
