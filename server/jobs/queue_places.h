// Who may queue more jobs.
#ifndef PLENUM_SERVER_JOBS_QUEUE_PLACES_H_
#define PLENUM_SERVER_JOBS_QUEUE_PLACES_H_

#include <cstddef>
#include <optional>

#include "server/jobs/job_queue.h"

namespace plenum::server {

// The last eighth of a queue is for clients who have fewer than two jobs in it, so that a client
// finds a place however many others fill theirs.
inline constexpr std::size_t kFewJobs = 2;
inline constexpr std::size_t kKeptShare = 8;

// Why `count` more jobs of a client cannot be queued; `waiting` is what the queue holds.
inline std::optional<Submitted> RefuseMore(const QueueLimits& limits, const QueueLimits& waiting,
                                           std::size_t count) {
  const std::size_t kept = waiting.of_client < kFewJobs ? 0 : limits.all / kKeptShare;
  if (waiting.all + count > limits.all - kept) return Submitted{Submitted::kRefused, ""};
  if (waiting.of_client + count > limits.of_client) return Submitted{Submitted::kClientRefused, ""};
  return std::nullopt;
}

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_QUEUE_PLACES_H_
