#include "server/jobs/crash_marks.h"

#include <fcntl.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <ctime>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string_view>

#include "api/catalogue/stores.h"
#include "api/json/request_limits.h"

namespace plenum::server {
namespace {

constexpr std::string_view kPrefix = "job ";
constexpr std::int64_t kNumberMax = 99'999'999'999;  // what fits into a thread's name
constexpr std::int64_t kTimeMaxS = 253'402'300'799;  // the end of the year 9999
// Room for marks on a disk that is full when they are written.
constexpr off_t kFileBytes = 4096;

struct Crash {
  int signal;
  const char* name;
  const char* what;
};
constexpr std::array<Crash, 4> kCrashes = {{{SIGSEGV, "SIGSEGV", "invalid access to memory"},
                                            {SIGABRT, "SIGABRT", "stopped by its own check"},
                                            {SIGBUS, "SIGBUS", "memory that is not there"},
                                            {SIGFPE, "SIGFPE", "an undefined division"}}};

std::atomic<int> crash_file = -1;
std::array<struct sigaction, kCrashes.size()> former_actions;

// The job that this thread works for; 0: none.
std::int64_t JobOfThread() {
  char name[16] = {};
  if (prctl(PR_GET_NAME, name) != 0) return 0;
  const std::string_view text = name;
  std::int64_t job = 0;
  if (text.starts_with(kPrefix))
    std::from_chars(text.data() + kPrefix.size(), text.data() + text.size(), job);
  return job;
}

// "12 11 1769860800\n": the job, the signal, the time. Only calls that a signal handler may make.
void WriteMark(int file, std::int64_t job, int signal) {
  char line[64];
  char* end = line;
  for (const std::int64_t number : {job, std::int64_t{signal}, std::int64_t{std::time(nullptr)}}) {
    end = std::to_chars(end, line + sizeof line - 1, number).ptr;
    *end++ = ' ';
  }
  end[-1] = '\n';
  [[maybe_unused]] const auto written = write(file, line, static_cast<std::size_t>(end - line));
}

void OnCrash(int signal, siginfo_t* info, void*) {
  const int error = errno;
  const int file = crash_file;
  const std::int64_t job = JobOfThread();
  if (file >= 0 && job > 0) WriteMark(file, job, signal);
  for (std::size_t i = 0; i < kCrashes.size(); ++i)
    if (kCrashes[i].signal == signal) sigaction(signal, &former_actions[i], nullptr);
  // A fault comes again when its instruction does; a signal that was sent does not.
  if (info->si_code <= 0) raise(signal);
  errno = error;
}

void CatchCrashes() {
  struct sigaction action {};
  action.sa_sigaction = OnCrash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kCrashes.size(); ++i) {
    sigaction(kCrashes[i].signal, nullptr, &former_actions[i]);
    sigaction(kCrashes[i].signal, &action, nullptr);
  }
}

}  // namespace

WorksFor::WorksFor(std::int64_t job) {
  prctl(PR_GET_NAME, former_);
  if (job <= kNumberMax) prctl(PR_SET_NAME, (std::string(kPrefix) + std::to_string(job)).c_str());
}

WorksFor::~WorksFor() { prctl(PR_SET_NAME, former_); }

std::string Describe(const CrashMark& mark) {
  std::string text = "signal " + std::to_string(mark.signal);
  for (const Crash& crash : kCrashes)
    if (crash.signal == mark.signal) text = fmt::format("{} ({})", crash.name, crash.what);
  const std::int64_t at_s = std::clamp<std::int64_t>(mark.at_s, 0, kTimeMaxS);
  return text + fmt::format(" at {:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time_t(at_s)));
}

std::filesystem::path CrashFile(const std::filesystem::path& catalog) {
  return catalog.string() + "-jobs-crash";
}

std::vector<CrashMark> ReadCrashMarks(const std::filesystem::path& file) {
  std::ifstream lines(file, std::ios::binary);
  std::vector<CrashMark> marks;
  for (std::string line; std::getline(lines, line);) {
    CrashMark mark;
    std::istringstream numbers(line);
    if (numbers >> mark.job >> mark.signal >> mark.at_s) marks.push_back(mark);
  }
  return marks;
}

CrashMarks::CrashMarks(const std::filesystem::path& file)
    : descriptor_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
  if (descriptor_ < 0)
    throw catalog::StoreError(file.string() + " cannot be written: " + std::strerror(errno));
  [[maybe_unused]] const int reserved = posix_fallocate(descriptor_, 0, kFileBytes);
  static std::once_flag once;
  std::call_once(once, CatchCrashes);
  crash_file = descriptor_;
}

CrashMarks::~CrashMarks() {
  int own = descriptor_;
  crash_file.compare_exchange_strong(own, -1);
  close(descriptor_);
}

}  // namespace plenum::server
