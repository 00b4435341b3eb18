#include "server/call/request_log.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <ctime>
#include <string>

#include "server/call/printable.h"
#include "server/call/reply.h"

namespace plenum::server {
namespace {

std::atomic<long long> dropped = 0;

// A pipe that is ready takes that much at once (PIPE_BUF).
constexpr std::size_t kLineBytesMax = 4096;

std::string Now() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  std::tm utc{};
  gmtime_r(&now.tv_sec, &utc);
  char day[24], text[40];
  std::strftime(day, sizeof day, "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text, sizeof text, "%s.%03dZ", day, static_cast<int>(now.tv_nsec / 1'000'000));
  return text;
}

}  // namespace

void Log(const api::Json& fields) {
  api::Json line = {{"time", Now()}};
  line.update(fields);
  const std::string text = Printable(Dump(line)) + "\n";
  pollfd ready{STDERR_FILENO, POLLOUT, 0};
  if (text.size() > kLineBytesMax || poll(&ready, 1, 0) != 1 || (ready.revents & POLLOUT) == 0 ||
      write(STDERR_FILENO, text.data(), text.size()) < 0)
    ++dropped;
}

long long DroppedLogLines() { return dropped; }

}  // namespace plenum::server
