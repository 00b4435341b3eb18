// Waiting for jobs, as tests do.
#ifndef PLENUM_TESTS_SERVER_JOBS_WAITING_H_
#define PLENUM_TESTS_SERVER_JOBS_WAITING_H_

#include <chrono>
#include <optional>
#include <string>
#include <thread>

#include "api/json/json.h"
#include "server/jobs/job_queue.h"

namespace plenum::server {

template <typename Predicate>
std::optional<Job> WaitUntil(const JobQueue& jobs, const std::string& id,
                             std::chrono::milliseconds timeout, Predicate holds) {
  for (const auto until = std::chrono::steady_clock::now() + timeout;;) {
    auto job = jobs.Get(id);
    if (!job || holds(*job) || jobs.Stopping() || std::chrono::steady_clock::now() > until)
      return job;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

// The job when it has ended or passed `revision`, or as it is after `timeout`.
inline std::optional<Job> WaitForChange(const JobQueue& jobs, const std::string& id,
                                        long long revision, std::chrono::milliseconds timeout) {
  return WaitUntil(jobs, id, timeout, [revision](const Job& job) {
    return job.revision > revision || Ended(job.status);
  });
}

inline std::optional<Job> WaitForEnd(const JobQueue& jobs, const std::string& id,
                                     std::chrono::milliseconds timeout) {
  return WaitUntil(jobs, id, timeout, [](const Job& job) { return Ended(job.status); });
}

inline api::Json Result(const std::optional<Job>& job) {
  return job && job->result ? api::Json::parse(*job->result) : api::Json();
}

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_JOBS_WAITING_H_
