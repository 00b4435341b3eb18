#include "server/commands/memory_patience.h"

#include <chrono>
#include <new>
#include <thread>

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kMemoryPatience{100}, kMemoryPause{1};
constexpr milliseconds kApart{20};  // refusals further apart are of two requests

void OnNoMemory() {
  thread_local Clock::time_point since, last;
  const auto now = Clock::now();
  if (now - last > kApart) since = now;
  last = now;
  if (now - since > kMemoryPatience) {
    since = now;  // what unwinding asks for has its own time
    throw std::bad_alloc();
  }
  std::this_thread::sleep_for(kMemoryPause);
}

}  // namespace

void WaitForMemory() { std::set_new_handler(OnNoMemory); }

}  // namespace plenum::server
