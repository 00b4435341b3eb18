// How much one client may take of the service. RenderLimits gives all of it at /v1/limits, under
// the names that refusals carry.
#ifndef PLENUM_SERVER_CALL_SERVICE_LIMITS_H_
#define PLENUM_SERVER_CALL_SERVICE_LIMITS_H_

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "server/call/reply.h"

namespace plenum::server {

inline constexpr int kRequestThreads = 32;
inline constexpr int kConnectionsMax = 2048;  // beyond it the longest waiting one goes
inline constexpr int kHeadSecondsMax = 10;    // for a request's line and headers to arrive
inline constexpr int kIdleSecondsMax = 30;    // between two requests of a connection
// After ten seconds.
inline constexpr std::size_t kBytesPerSecondMin = 256 << 10;  // of bodies
inline constexpr std::size_t kAnswerBytesPerSecondMin = 32 << 10;
inline constexpr std::size_t kHeadBytesMax = 16 << 10;  // request line and headers
inline constexpr int kHeadersMax = 100;
inline constexpr std::size_t kPathBytesMax = 1024;
inline constexpr std::size_t kBodyBytesMax = 8 << 20;
// Requests on their way, of all connections together; beyond it the connection whose request has
// been on its way longest is closed.
inline constexpr std::size_t kBufferedBytesMax = 16 << 20;
// Large answers on their way that were built in one piece; another is refused, none is cut off.
inline constexpr std::size_t kAnswerBytesMax = 64 << 20;
// What takes much memory, one at a time: a larger body, a page of more parts, a table of parts.
inline constexpr std::size_t kLargeBodyBytes = 256 << 10;
inline constexpr int kLargePageParts = 200;
inline constexpr int kLargeMax = 1;
inline constexpr int kLargeWaitingMax = 64;
inline constexpr int kLargeWaitSeconds = 10;
// A table of parts may be longer than other bodies, one such at a time.
inline constexpr std::size_t kImportBytesMax = 32 << 20;
// So may the file of a document of a part; both have their turn together.
inline constexpr std::size_t kDocumentBytesMax = catalog::kFileBytesMax;
inline constexpr int kLargeImportsMax = 1;
inline constexpr std::size_t kImportRowsMax = 150'000;
// Requests and jobs that wait for their turn at the catalogue's file.
inline constexpr int kCatalogueWaitingMax = 16;
inline constexpr int kCatalogueWaitSeconds = 10;
inline constexpr int kComputingMax = 8;       // simulations and maps at a time,
inline constexpr int kLargeComputingMax = 2;  // of large requests
inline constexpr int kSweepsReadMax = 2;      // sweeps that are checked at a time
inline constexpr int kWaitingMax = 256;       // requests that wait for their job
inline constexpr int kWaitSecondsMax = 300;
inline constexpr int kStreamsMax = 64;  // open event streams
// Of all searches together, beyond what the service has without them: then one of them ends.
inline constexpr std::size_t kJobMemoryBytesMax = 768 << 20;
// A diagnosis takes about 1.2 kB a sample while it runs: of longer ones one at a time.
inline constexpr std::size_t kLargeDiagnosisSamples = 50'000;
inline constexpr int kLargeDiagnosesMax = 1;

// Everything that limits a request, by name: { "body_bytes_max": 8388608, … }.
struct JobQuota {  // of one kind
  int running_max = 0;
  std::size_t queued_max = 0, queued_per_client_max = 0;
  std::size_t swept_queued_max = 0, swept_queued_per_client_max = 0;
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

// Lets `max` in at a time; others wait for their turn without a thread: they take a ticket and ask
// again, and are let in in the order of their tickets. A ticket is given back when it is destroyed.
class Gate {
 public:
  using Ticket = std::shared_ptr<const int>;
  // `on_leave` is called when somebody may enter.
  Gate(int max, int waiting_max, std::function<void()> on_leave)
      : free_(max), waiting_max_(waiting_max), on_leave_(std::move(on_leave)) {}

  // The turn, which ends when its last copy goes. Nothing where others are inside or were first;
  // then `ticket` is set, unless too many wait.
  std::shared_ptr<void> Enter(Ticket& ticket);

 private:
  void Leave();

  std::mutex mutex_;
  int free_;
  const std::size_t waiting_max_;
  const std::function<void()> on_leave_;
  std::deque<std::weak_ptr<const int>> waiting_;
};

// Bytes of answers that are on their way, up to a limit of all together; one alone may be larger.
class ByteBudget {
 public:
  explicit ByteBudget(std::size_t max) : max_(max) {}
  // The text, counted until its last copy goes; nothing where there is no room.
  Bytes Hold(std::string text);
  std::size_t held() const { return *held_; }

 private:
  const std::size_t max_;
  // Outlives the budget where an answer does.
  const std::shared_ptr<std::atomic<std::size_t>> held_ =
      std::make_shared<std::atomic<std::size_t>>(0);
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_SERVICE_LIMITS_H_
