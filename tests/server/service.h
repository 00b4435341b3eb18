// The real service on a free loopback port, in this process.
#ifndef PLENUM_TESTS_SERVER_SERVICE_H_
#define PLENUM_TESTS_SERVER_SERVICE_H_

#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "server/http.h"
#include "tests/server/workbench.h"

namespace plenum::server {

class Service {
 public:
  explicit Service(HttpOptions options = {}) {
    if (options.catalog == "catalog.db") options.catalog = bench_.catalog();
    options.port = 0;
    options.log = false;
    service_ = std::make_unique<HttpService>(options);
    thread_ = std::thread([this] { service_->Run(); });
  }
  ~Service() {
    service_->Stop();
    thread_.join();
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;

  int port() const { return service_->port(); }
  const Workbench& bench() const { return bench_; }

 private:
  const Workbench bench_;
  std::unique_ptr<HttpService> service_;
  std::thread thread_;
};

// One job at a time and one that waits.
inline HttpOptions OneJobAtATime() {
  HttpOptions options;
  options.jobs.workers = 1;
  options.jobs.queued_max = 1;
  return options;
}

// The JSON of a text; null where it is none.
inline api::Json JsonOf(const std::string& text) {
  auto parsed = api::ParseJson(text);
  return std::holds_alternative<api::Json>(parsed) ? std::get<api::Json>(parsed) : api::Json();
}

// The client waits for the end of the connection where an answer has no body, a 304, say.
inline const std::pair<const std::string, std::string> kClose{"Connection", "close"};

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_SERVICE_H_
