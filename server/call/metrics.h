// What the service did and holds, as Prometheus reads it (text format 0.0.4).
#ifndef PLENUM_SERVER_CALL_METRICS_H_
#define PLENUM_SERVER_CALL_METRICS_H_

#include <memory>
#include <string>

namespace plenum::server {

class Metrics {
 public:
  Metrics();
  ~Metrics();

  // An answered request. `route` is the pattern of its path, so that there are few.
  void Count(const std::string& method, const std::string& route, int status, double seconds,
             std::size_t bytes_in, std::size_t bytes_out);
  // What is so at this moment.
  void Set(const std::string& name, const std::string& help, double value);

  std::string Text() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_METRICS_H_
