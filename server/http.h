// The HTTP service.
#ifndef PLENUM_SERVER_HTTP_H_
#define PLENUM_SERVER_HTTP_H_

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/jobs/job_queue.h"

namespace plenum::server {

struct HttpOptions {
  std::filesystem::path catalog = "catalog.db";  // the jobs are kept in <catalog>-jobs,
                                                 // crashes of theirs marked in <catalog>-jobs-crash
  std::filesystem::path docs;                    // the built documentation, if any
  std::filesystem::path seed;                    // the catalogue that was installed, if any
  std::string host = "127.0.0.1";
  int port = 8080;  // 0: any free one
  // Names beside those of the loopback by which the service is reached, as behind a proxy.
  std::vector<std::string> allow_hosts;
  JobOptions jobs;         // of designs, and as many of diagnoses
  catalog::JobsKept kept;  // of each
  bool log = true;
};

// Whether every request needs a token: wherever others than this machine can send one.
bool NeedsToken(const HttpOptions& options);

// Thrown by the constructor when it cannot listen at the address.
class ListenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class HttpService {
 public:
  // Opens the catalogue and the jobs (StoreError), goes on with those that did not end and binds
  // the port (ListenError). Connections wait until Run.
  explicit HttpService(const HttpOptions& options);
  ~HttpService();

  int port() const;
  // Serves until Stop, which any thread may call: it lets answers under way end and leaves jobs
  // that did not end to the next service.
  void Run();
  void Stop();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_HTTP_H_
