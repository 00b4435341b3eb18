// Does jobs of a catalogue on a server: in a service and in `plenum worker`.
//
// Each thread claims a job, computes it and ends it with its attempt token. One more thread, with a
// connection of its own, extends the leases, writes progress, sees who cancelled, and gives jobs of
// lost workers back to the queue. The server may go and come back: what was computed is kept until
// it is written or the lease was lost.
#ifndef PLENUM_SERVER_JOBS_JOB_WORKER_H_
#define PLENUM_SERVER_JOBS_JOB_WORKER_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/jobs/job_queue.h"

namespace plenum::server {

struct WorkerOptions {
  int threads = 2;
  std::chrono::milliseconds lease{30'000};
  std::chrono::milliseconds pause{1'000};  // between two looks at an empty queue
  catalog::JobsKept kept;
};

class JobWorker {
 public:
  // `works` by kind. Throws StoreError where the server cannot be reached.
  JobWorker(const std::string& address, std::map<std::string, Work> works,
            const WorkerOptions& options);
  ~JobWorker();
  JobWorker(const JobWorker&) = delete;
  JobWorker& operator=(const JobWorker&) = delete;

  void Wake();   // a job was queued
  void Drain();  // takes no more jobs
  bool Idle() const;
  // Gives back what runs and joins the threads.
  void Stop();

 private:
  struct Attempt {
    catalog::JobClaim claim;
    std::string progress;      // not yet written
    bool asked = false;        // somebody cancelled it
    bool lost = false;         // another has it
    bool interrupted = false;  // the work saw that this worker stops
    std::chrono::steady_clock::time_point extended = std::chrono::steady_clock::now();
  };
  using AttemptPtr = std::shared_ptr<Attempt>;

  void WorkLoop(catalog::SharedJobStore& store);
  void Run(catalog::SharedJobStore& store, const AttemptPtr& attempt);
  api::Parsed<api::Json> Compute(const AttemptPtr& attempt);
  void End(catalog::SharedJobStore& store, Attempt& attempt, catalog::JobRecord outcome);
  void KeepLoop(catalog::SharedJobStore& store);
  // When what is done now and then was done last.
  struct LastTimes {
    std::chrono::steady_clock::time_point seen{}, dropped{};
  };
  void Keep(catalog::SharedJobStore& store, LastTimes& last);
  bool Pause(std::chrono::milliseconds time);  // false where the threads end

  const std::map<std::string, Work> works_;
  std::vector<std::string> kinds_;
  const WorkerOptions options_;
  catalog::WorkerRecord self_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<AttemptPtr> attempts_;  // at work
  long long wakes_ = 0;
  bool draining_ = false;
  std::atomic<bool> stopping_ = false;                            // what runs is interrupted
  std::atomic<bool> over_ = false;                                // nothing runs any more
  std::vector<std::unique_ptr<catalog::SharedJobStore>> stores_;  // of each thread
  std::vector<std::thread> threads_;
  std::thread keeper_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_WORKER_H_
