// Many connections on a few threads. A connection has no thread while its request arrives, while it
// waits for something or while its answer leaves: it waits in one epoll set or is parked, from
// which a thread takes it when there is something to do. So slow clients and those who wait cost a
// little memory each and hold up nobody. Requests are answered in `places`, fewer than there are
// threads; others wait for one in the order in which they came, but for urgent ones, which need
// none. Who is slower than the limits allow (service_limits.h) is closed, and where requests on
// their way take too much together, the one that has taken longest.
#ifndef PLENUM_SERVER_WIRE_CONNECTIONS_H_
#define PLENUM_SERVER_WIRE_CONNECTIONS_H_

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "server/call/service_limits.h"
#include "server/wire/client_connection.h"
#include "server/wire/exchange.h"
#include "server/wire/places.h"
#include "server/wire/poll_set.h"
#include "server/wire/refusal.h"
#include "server/wire/request_head.h"

namespace plenum::server {

// What the service does with requests.
struct Handlers {
  std::function<Handled(Incoming, Outgoing&)> handle;
  // The whole refusal, as text, of a request whose body is still to come; empty: let it come.
  std::function<std::string(const RequestHead& head, const std::string& peer)> examine;
  // The whole answer, as text, to what is no request that is served.
  std::function<std::string(const Refusal&, const std::string& peer)> refuse;
  // Whether a request needs no place, by its head.
  std::function<bool(const RequestHead& head)> is_urgent;
};

class Connections {
 public:
  explicit Connections(Handlers handlers);
  ~Connections();

  // As many threads as `places` and a few for urgent requests and for bytes.
  void Start(int places);
  // Takes over a connected socket; where there is no memory for it, it is closed.
  void Admit(int socket);
  // Something has changed that requests may wait for (Handled::on_change).
  void Wake();
  // Lets answers under way end, then closes everything.
  void Stop();

  std::size_t open() const;
  std::size_t buffered_bytes() const { return buffered_; }
  // Connections that were closed because they waited too long or to make room.
  long long closed_early() const { return closed_early_; }

 private:
  enum class Next { kGoOn, kRead, kWrite, kAgain, kPark, kQueue, kClose };

  void WorkLoop();
  void HandOver(ClientConnection& connection, Next next);
  Next Advance(ClientConnection& connection);
  Next AfterSending(ClientConnection& connection);
  Next Receive(ClientConnection& connection);
  Next TakeRequest(ClientConnection& connection);
  Next AwaitBody(ClientConnection& connection);
  Next Serve(ClientConnection& connection);
  void Refuse(ClientConnection& connection, const Refusal& refusal);
  void RefuseWith(ClientConnection& connection, std::string answer);

  void LeavePlace(ClientConnection& connection);
  void Park(ClientConnection& connection);
  void Arm(ClientConnection& connection, PollSet::For what);
  void Close(ClientConnection& connection);
  // Counts what requests hold.
  void Account(ClientConnection& connection);
  void MakeRoom();

  void SweepLoop();
  void Unpark();
  void CloseExpired();

  const Handlers handlers_;
  const PollSet poll_set_;
  std::atomic<bool> stopping_ = false;
  mutable std::mutex mutex_;
  std::unordered_map<int, std::unique_ptr<ClientConnection>> connections_;  // by socket
  std::vector<ClientConnection*> parked_;
  std::atomic<long long> changes_ = 0;
  std::condition_variable attention_;  // of the sweeper
  bool woken_ = false;
  Places<ClientConnection> places_;
  std::atomic<std::size_t> buffered_ = 0;
  std::atomic<long long> closed_early_ = 0;
  Turnstile large_imports_{kLargeImportsMax};
  std::vector<std::thread> workers_;
  std::thread sweeper_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_CONNECTIONS_H_
