// A folder of its own for a test, with a small catalogue, and the real command run in it.
#ifndef PLENUM_TESTS_SERVER_WORKBENCH_H_
#define PLENUM_TESTS_SERVER_WORKBENCH_H_

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "api/json/json.h"

namespace plenum::server {

class Workbench {
 public:
  Workbench();  // copies the project's catalogue into a new folder
  ~Workbench();
  Workbench(const Workbench&) = delete;
  Workbench& operator=(const Workbench&) = delete;

  std::filesystem::path Path(const std::string& name) const { return folder_ / name; }
  std::string catalog() const { return Path("catalog.db"); }
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

  struct Outcome {
    int status = -1;
    std::string out, err;
  };
  // Runs `plenum <arguments>` (as the shell reads them) in the folder.
  // `prefix` may be another command that starts it.
  Outcome Run(const std::string& arguments, const std::string& input = "",
              const std::string& prefix = "") const;

 private:
  std::filesystem::path folder_;
};

// `plenum serve --port 0` as a process of its own.
class ServeProcess {
 public:
  struct Options {
    unsigned long file_bytes_max = 0;  // of the files that it may write (RLIMIT_FSIZE); 0: any
    std::string log = {};              // the file that takes what it prints; empty: none does
    bool is_known_elsewhere = false;   // as x.example: whoever asks needs a token
  };
  explicit ServeProcess(const std::string& catalog) : ServeProcess(catalog, Options{}) {}
  ServeProcess(const std::string& catalog, const Options& options);
  ~ServeProcess();  // kills it if it still runs
  int port() const { return port_; }
  void LimitFiles(unsigned long bytes_max) const;
  // Sends `signal`; the exit status, or minus the signal that ended it.
  int End(int signal);

 private:
  pid_t pid_ = -1;
  int port_ = 0;
};

// `plenum worker` as a process of its own, one job at a time.
class WorkerProcess {
 public:
  WorkerProcess(const std::string& catalog, int lease_s);
  ~WorkerProcess();  // kills it if it still runs
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;
  // Sends `signal`; the exit status, or minus the signal that ended it.
  int End(int signal);

 private:
  pid_t pid_ = -1;
};

std::string ReadAll(const std::filesystem::path& path);
// An example of the project, two designs asked for; `time_limit_s` of its search as given.
api::Json Example(const std::string& name, double time_limit_s);
api::Json Exosuit(double time_limit_s);
// A problem that takes many seconds to prove.
api::Json SlowToProve(double time_limit_s);
// A fitting that the project's catalogue does not hold.
api::Json NewFitting(const std::string& id);

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_WORKBENCH_H_
