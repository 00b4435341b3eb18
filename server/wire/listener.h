// Listens at an address and hands over each connection that is accepted.
#ifndef PLENUM_SERVER_WIRE_LISTENER_H_
#define PLENUM_SERVER_WIRE_LISTENER_H_

#include <atomic>
#include <functional>
#include <string>

namespace plenum::server {

class Listener {
 public:
  Listener() = default;
  ~Listener();
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  // Binds the first address of `host` at `port`, 0 for any free one: the port, or nothing (0) where
  // it cannot be had. Connections wait until Run.
  int Bind(const std::string& host, int port);

  // Accepts until Stop, which any thread may call, before or after; `admit` owns what it is given.
  // Where the system has no room for one more, those that wait are accepted when there is.
  void Run(const std::function<void(int socket)>& admit);
  void Stop();

 private:
  int socket_ = -1;
  int wake_ = -1;
  std::atomic<bool> stopping_ = false;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_LISTENER_H_
