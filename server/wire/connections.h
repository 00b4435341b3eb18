// Many connections on a few threads. A connection has no thread while its request arrives or its
// answer leaves: it waits in one epoll set, from which a thread takes it when there is something to
// do. So slow clients cost a little memory each and hold up nobody. Who is slower than the limits
// allow (service_limits.h) is closed, and where all of them together take too much, who has waited
// longest.
#ifndef PLENUM_SERVER_WIRE_CONNECTIONS_H_
#define PLENUM_SERVER_WIRE_CONNECTIONS_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <unordered_map>
#include <vector>

#include "server/call/service_limits.h"
#include "server/wire/request_frame.h"

namespace plenum::server {

// One whole request.
struct Incoming {
  std::string head;  // request line and headers, with the empty line
  std::string body;
  std::string peer;      // the client's address
  bool is_last = false;  // the connection closes after it
};

// Where an answer goes. Nothing blocks: what the client does not take yet is kept.
class Outgoing {
 public:
  virtual ~Outgoing() = default;
  virtual void Write(std::string_view bytes) = 0;
  // Sends what can be sent now; false when the client is gone or takes too little.
  virtual bool Flush() = 0;
};

// Answers a request; false: the connection is to be closed after the answer.
using HandleRequest = std::function<bool(Incoming, Outgoing&)>;
// The whole refusal, as text, of a request whose body is still to come; empty: let it come.
using ExamineHead = std::function<std::string(const std::string& head, const std::string& peer)>;
// The whole answer, as text, to what is no request that is served.
using RenderRefusal = std::function<std::string(const Refusal&, const std::string& peer)>;

class Connections {
 public:
  Connections(HandleRequest handle, ExamineHead examine, RenderRefusal refuse);
  ~Connections();

  void Start(int threads);
  // Takes over a connected socket.
  void Admit(int socket);
  // Lets answers under way end, then closes everything.
  void Stop();

  std::size_t open() const;
  std::size_t buffered_bytes() const { return buffered_; }
  // Connections that were closed because they waited too long or to make room.
  long long closed_early() const { return closed_early_; }

 private:
  struct Connection;
  enum class Next { kRead, kWrite, kClose };

  void WorkLoop();
  void SweepLoop();
  Next Advance(Connection& connection);
  Next Receive(Connection& connection);
  Next ServeArrived(Connection& connection);
  Next AwaitBody(Connection& connection);
  Next Refuse(Connection& connection, const Refusal& refusal);
  Next RefuseWith(Connection& connection, const std::string& answer);
  Next Send(Connection& connection);
  Next AfterSending(Connection& connection);
  void Rearm(Connection& connection, Next next);
  void Close(Connection& connection);
  // Counts what the connection holds.
  void Account(Connection& connection);
  void MakeRoom();

  const HandleRequest handle_;
  const ExamineHead examine_;
  const RenderRefusal refuse_;
  int epoll_ = -1, wake_ = -1;
  std::atomic<bool> stopping_ = false;
  mutable std::mutex mutex_;
  std::unordered_map<int, std::unique_ptr<Connection>> connections_;  // by socket
  std::atomic<std::size_t> buffered_ = 0;
  std::atomic<long long> closed_early_ = 0;
  Turnstile large_imports_{kLargeImportsMax};
  std::vector<std::thread> workers_;
  std::thread sweeper_;
  std::condition_variable stop_sweeping_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_CONNECTIONS_H_
