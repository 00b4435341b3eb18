// How much one client may take of the service. RenderLimits gives all of it at /v1/limits, under
// the names that refusals carry.
#ifndef PLENUM_SERVER_LIMITS_H_
#define PLENUM_SERVER_LIMITS_H_

#include <atomic>
#include <cstddef>
#include <memory>

#include "api/json.h"
#include "server/jobs.h"
#include "server/reply.h"

namespace plenum::server {

inline constexpr int kRequestThreads = 32;
inline constexpr int kConnectionsMax = 2048;  // beyond it the longest waiting one goes
inline constexpr int kHeadSecondsMax = 10;    // for a request's line and headers to arrive
inline constexpr int kIdleSecondsMax = 30;    // between two requests of a connection
inline constexpr std::size_t kBytesPerSecondMin = 256 << 10;  // of bodies and answers, after 10 s
inline constexpr std::size_t kHeadBytesMax = 16 << 10;        // request line and headers
inline constexpr int kHeadersMax = 100;
inline constexpr std::size_t kPathBytesMax = 1024;
inline constexpr std::size_t kBodyBytesMax = 8 << 20;
// Requests that have not arrived and answers that have not left, of all connections together;
// beyond it the connection that has waited longest is closed.
inline constexpr std::size_t kBufferedBytesMax = 24 << 20;
inline constexpr std::size_t kLargeBodyBytes = 256 << 10;
inline constexpr int kLargeBodiesMax = 2;  // requests with a larger body, worked on at a time
inline constexpr int kComputingMax = 8;    // simulations and maps at a time
inline constexpr int kWaitingMax = 8;      // requests that wait for their job
inline constexpr int kWaitSecondsMax = 300;
inline constexpr int kStreamsMax = 8;  // open event streams

// Everything that limits a request, by name: { "body_bytes_max": 8388608, … }.
api::Json RenderLimits(const JobOptions& jobs);

// A refusal that names its limit: a problem document with "limit": { "name", "value" }.
Reply LimitReply(int status, const std::string& name, const api::Json& value,
                 const std::string& detail);
// The same with Retry-After, for what another moment allows.
Reply BusyReply(const std::string& name, const api::Json& value, const std::string& detail,
                int retry_after_s);

// Counts those inside; `Enter` gives nothing when `max` are.
class Turnstile {
 public:
  explicit Turnstile(int max) : free_(max) {}
  // Leaves when the last copy goes.
  std::shared_ptr<void> Enter() {
    if (free_.fetch_sub(1) > 0) return {this, [](Turnstile* t) { t->free_.fetch_add(1); }};
    free_.fetch_add(1);
    return nullptr;
  }

 private:
  std::atomic<int> free_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_LIMITS_H_
