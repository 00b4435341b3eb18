// How much one client may take of the service.
#ifndef PLENUM_SERVER_LIMITS_H_
#define PLENUM_SERVER_LIMITS_H_

#include <atomic>
#include <cstddef>
#include <memory>

namespace plenum::server {

inline constexpr int kRequestThreads = 32;          // one per open connection
inline constexpr int kWaitingMax = 8;               // requests that wait for their job
inline constexpr int kStreamsMax = 8;               // open event streams
inline constexpr std::size_t kPathBytesMax = 1024;  // httplib matches it with a recursive regex
inline constexpr std::size_t kBodyBytesMax = 8 << 20;
// A body over the limit is read to its end up to here, so that the client sees the answer; beyond
// it the connection is closed.
inline constexpr std::size_t kBodyBytesRead = 64 << 20;

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
