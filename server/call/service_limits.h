// How much one client may take of the service. RenderLimits gives all of it at /v1/limits, under
// the names that refusals carry.
#ifndef PLENUM_SERVER_CALL_SERVICE_LIMITS_H_
#define PLENUM_SERVER_CALL_SERVICE_LIMITS_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "server/call/reply.h"

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
inline constexpr std::size_t kBufferedBytesMax = 16 << 20;
// What takes much memory, one at a time: a larger body, a page of more parts, a table of parts.
inline constexpr std::size_t kLargeBodyBytes = 256 << 10;
inline constexpr int kLargePageParts = 200;
inline constexpr int kLargeMax = 1;
inline constexpr int kLargeWaitingMax = 8;
inline constexpr int kLargeWaitSeconds = 10;
// A table of parts may be longer than other bodies, one such at a time.
inline constexpr std::size_t kImportBytesMax = 32 << 20;
inline constexpr int kLargeImportsMax = 1;
inline constexpr std::size_t kImportRowsMax = 150'000;
// Requests and jobs that wait for their turn at the catalogue's file.
inline constexpr int kCatalogueWaitingMax = 16;
inline constexpr int kCatalogueWaitSeconds = 10;
inline constexpr int kComputingMax = 8;  // simulations and maps at a time
inline constexpr int kWaitingMax = 8;    // requests that wait for their job
inline constexpr int kWaitSecondsMax = 300;
inline constexpr int kStreamsMax = 8;  // open event streams
// A diagnosis takes about 1.2 kB a sample while it runs: of longer ones one at a time.
inline constexpr std::size_t kLargeDiagnosisSamples = 50'000;
inline constexpr int kLargeDiagnosesMax = 1;

// Everything that limits a request, by name: { "body_bytes_max": 8388608, … }.
struct JobQuota {  // of one kind
  int running_max = 0;
  std::size_t queued_max = 0;
};
api::Json RenderLimits(const JobQuota& jobs, const catalog::JobsKept& kept);

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

// Lets `max` in at a time; others wait for their turn.
class Gate {
 public:
  Gate(int max, int waiting_max) : free_(max), waiting_free_(waiting_max) {}
  // Leaves when the last copy goes; nothing when too many wait or the turn does not come in time.
  std::shared_ptr<void> Enter(std::chrono::milliseconds patience);

 private:
  void Leave();

  std::mutex mutex_;
  std::condition_variable left_;
  int free_, waiting_free_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_SERVICE_LIMITS_H_
