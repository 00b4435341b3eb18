// Which job a thread works for, and the mark that it leaves when it crashes.
#ifndef PLENUM_SERVER_JOBS_CRASH_MARKS_H_
#define PLENUM_SERVER_JOBS_CRASH_MARKS_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace plenum::server {

// While it lives, this thread works for the job of that number, and so do all threads that are made
// in it or in them: on Linux a new thread has the name of the one that makes it, here "job 12".
class WorksFor {
 public:
  explicit WorksFor(std::int64_t job);
  ~WorksFor();
  WorksFor(const WorksFor&) = delete;
  WorksFor& operator=(const WorksFor&) = delete;

 private:
  char former_[16] = {};  // the length of a thread's name
};

struct CrashMark {
  std::int64_t job = 0;  // its number
  int signal = 0;
  std::int64_t at_s = 0;  // Unix time
};
// "SIGSEGV (invalid access to memory) at 2026-01-31T12:00:00Z"
std::string Describe(const CrashMark& mark);

// The file beside the jobs of a catalogue.
std::filesystem::path CrashFile(const std::filesystem::path& catalog);

// What the threads of the last program left in the file; none where there is no file.
std::vector<CrashMark> ReadCrashMarks(const std::filesystem::path& file);

// While it lives, a thread that works for a job and crashes (SIGSEGV, SIGABRT, SIGBUS, SIGFPE)
// writes a mark to the file. The program then ends as it would without: by the same signal, with
// the same core dump. The file begins empty. One at a time in a process: the newest counts.
class CrashMarks {
 public:
  // Throws catalog::StoreError where the file cannot be written.
  explicit CrashMarks(const std::filesystem::path& file);
  ~CrashMarks();
  CrashMarks(const CrashMarks&) = delete;
  CrashMarks& operator=(const CrashMarks&) = delete;

 private:
  int descriptor_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_CRASH_MARKS_H_
