#include "server/wire/connections.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <stdexcept>
#include <utility>

#include "server/call/service_limits.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr std::size_t kReadBytes = 64 << 10;
constexpr std::size_t kSmallBuffer = 4 << 10;         // not worth counting
constexpr std::size_t kStreamBacklogMax = 256 << 10;  // of an answer that is still being made
constexpr std::size_t kDrainBytesMax = 64 << 20;
constexpr auto kSweepPeriod = std::chrono::milliseconds(500);

// Time to move so many bytes.
seconds TimeFor(std::size_t bytes) { return seconds(kHeadSecondsMax + bytes / kBytesPerSecondMin); }

std::string PeerOf(int socket) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  char text[INET6_ADDRSTRLEN] = "";
  if (getpeername(socket, reinterpret_cast<sockaddr*>(&address), &length) != 0) return text;
  if (address.ss_family == AF_INET)
    inet_ntop(AF_INET, &reinterpret_cast<sockaddr_in*>(&address)->sin_addr, text, sizeof text);
  if (address.ss_family == AF_INET6)
    inet_ntop(AF_INET6, &reinterpret_cast<sockaddr_in6*>(&address)->sin6_addr, text, sizeof text);
  return text;
}

// Room for all connections beside the files of the program.
void RaiseFileLimit() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur =
      std::max(limit.rlim_cur, std::min<rlim_t>(limit.rlim_max, kConnectionsMax + 256));
  setrlimit(RLIMIT_NOFILE, &limit);
}

}  // namespace

// Belongs to the thread that took it from the epoll set, or to none. What the sweeper reads while
// another thread may write is atomic.
struct Connections::Connection final : Outgoing {
  explicit Connection(int fd) : socket(fd), peer(PeerOf(fd)) { Await(seconds(kHeadSecondsMax)); }
  ~Connection() override {
    // A client that is cut off hears of it at once, also while it sends.
    const linger at_once{1, 0};
    if (evicted) setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
    close(socket);
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void Await(seconds patience) {
    const auto now = Clock::now().time_since_epoch().count();
    since = now;
    deadline = now + Clock::duration(patience).count();
  }
  // Of the wait that goes on.
  void Extend(seconds patience) { deadline = since + Clock::duration(patience).count(); }
  std::size_t unsent() const { return out.size() - sent; }

  void Write(std::string_view bytes) override {
    if (broken) return;
    out.append(bytes);
    if (unsent() > kStreamBacklogMax) Flush();
  }
  bool Flush() override {
    while (!broken && sent < out.size()) {
      const ssize_t n =
          send(socket, out.data() + sent, out.size() - sent, MSG_DONTWAIT | MSG_NOSIGNAL);
      if (n < 0 && errno == EINTR) continue;
      if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
      if (n <= 0) broken = true;
      if (n > 0) sent += static_cast<std::size_t>(n);
    }
    if (sent == out.size()) out.clear(), sent = 0;
    return !broken && unsent() <= kStreamBacklogMax;
  }

  const int socket;
  const std::string peer;
  std::string in;
  std::string out;
  std::size_t sent = 0;  // of out
  RequestFrame frame;
  bool examined = false;             // the head of the request whose body is to come
  std::shared_ptr<void> large_turn;  // while the body is a large table
  bool broken = false;
  bool closing = false;     // after what is in `out`
  std::size_t drained = 0;  // bytes thrown away after the last answer
  bool draining = false;
  std::atomic<std::size_t> accounted = 0;
  std::atomic<Clock::rep> since = 0, deadline = 0;
  std::atomic<bool> busy = false;
  std::atomic<bool> expired = false;  // waited too long, or
  std::atomic<bool> evicted = false;  // had to make room
};

Connections::Connections(HandleRequest handle, ExamineHead examine, RenderRefusal refuse)
    : handle_(std::move(handle)), examine_(std::move(examine)), refuse_(std::move(refuse)) {
  RaiseFileLimit();
  epoll_ = epoll_create1(EPOLL_CLOEXEC);
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (epoll_ < 0 || wake_ < 0) throw std::runtime_error("no epoll set");
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.ptr = nullptr;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event);
}

Connections::~Connections() {
  Stop();
  close(epoll_);
  close(wake_);
}

void Connections::Start(int threads) {
  for (int i = 0; i < threads; ++i) workers_.emplace_back([this] { WorkLoop(); });
  sweeper_ = std::thread([this] { SweepLoop(); });
}

void Connections::Stop() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  stop_sweeping_.notify_all();
  eventfd_write(wake_, 1);  // stays readable: every thread sees it
  for (auto& worker : workers_) worker.join();
  workers_.clear();
  if (sweeper_.joinable()) sweeper_.join();
  const std::lock_guard lock(mutex_);
  connections_.clear();
}

std::size_t Connections::open() const {
  const std::lock_guard lock(mutex_);
  return connections_.size();
}

void Connections::Admit(int socket) {
  auto connection = std::make_unique<Connection>(socket);
  Connection& admitted = *connection;
  bool full = false;
  {
    const std::lock_guard lock(mutex_);
    connections_[socket] = std::move(connection);
    full = connections_.size() > kConnectionsMax;
  }
  epoll_event event{};
  event.events = EPOLLIN | EPOLLRDHUP | EPOLLONESHOT;
  event.data.ptr = &admitted;
  epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event);
  if (full) MakeRoom();
}

void Connections::WorkLoop() {
  while (!stopping_) {
    epoll_event event{};
    if (epoll_wait(epoll_, &event, 1, -1) != 1 || event.data.ptr == nullptr) continue;
    auto& connection = *static_cast<Connection*>(event.data.ptr);
    connection.busy = true;
    const Next next = Advance(connection);
    Account(connection);
    if (next == Next::kClose)
      Close(connection);
    else
      Rearm(connection, next);
  }
}

void Connections::Rearm(Connection& connection, Next next) {
  connection.busy = false;
  epoll_event event{};
  event.events = (next == Next::kRead ? EPOLLIN | EPOLLRDHUP : EPOLLOUT) | EPOLLONESHOT;
  event.data.ptr = &connection;
  epoll_ctl(epoll_, EPOLL_CTL_MOD, connection.socket, &event);
  if (buffered_ > kBufferedBytesMax) MakeRoom();
}

void Connections::Close(Connection& connection) {
  const std::lock_guard lock(mutex_);
  buffered_ -= connection.accounted.exchange(0);
  connections_.erase(connection.socket);
}

void Connections::Account(Connection& connection) {
  // A large table has a limit of its own.
  std::size_t held = (connection.large_turn ? 0 : connection.in.size()) + connection.out.size();
  if (held <= kSmallBuffer) held = 0;
  buffered_ += held - connection.accounted.exchange(held);  // modulo 2^64
}

Connections::Next Connections::Advance(Connection& connection) {
  if (connection.unsent() > 0) return Send(connection);
  return Receive(connection);
}

Connections::Next Connections::Receive(Connection& connection) {
  thread_local std::string piece(kReadBytes, '\0');
  const ssize_t n = recv(connection.socket, piece.data(), piece.size(), MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return Next::kRead;
  if (n <= 0) {
    if (!connection.expired || connection.in.empty() || connection.draining) return Next::kClose;
    const bool in_head = connection.frame.size() == 0;
    return Refuse(connection, {408, in_head ? "head_seconds_max" : "body_bytes_per_second_min",
                               "the request did not arrive in time"});
  }
  if (connection.draining) {
    connection.drained += static_cast<std::size_t>(n);
    return connection.drained > kDrainBytesMax ? Next::kClose : Next::kRead;
  }
  if (connection.in.empty()) connection.Await(seconds(kHeadSecondsMax));
  connection.in.append(piece, 0, static_cast<std::size_t>(n));
  return ServeArrived(connection);
}

Connections::Next Connections::ServeArrived(Connection& connection) {
  using State = RequestFrame::State;
  while (!connection.in.empty()) {
    const State state = connection.frame.Look(connection.in);
    if (state == State::kRefused) return Refuse(connection, connection.frame.refusal());
    if (state == State::kHead) return Next::kRead;
    if (state == State::kBody) return AwaitBody(connection);
    Incoming request{connection.frame.TakeHead(connection.in),
                     connection.frame.TakeBody(connection.in), connection.peer, stopping_};
    connection.frame = {};
    connection.examined = false;
    connection.closing = !handle_(std::move(request), connection) || stopping_;
    connection.large_turn.reset();
    connection.Await(TimeFor(connection.unsent()));
    const Next next = Send(connection);
    if (next != Next::kRead || connection.draining) return next;
  }
  return Next::kRead;
}

// Who may not send it is told before the body takes a place from others.
Connections::Next Connections::AwaitBody(Connection& connection) {
  const RequestFrame& frame = connection.frame;
  const bool first = !std::exchange(connection.examined, true);
  if (first) {
    const std::string refusal =
        examine_(connection.in.substr(0, frame.head_size()), connection.peer);
    if (!refusal.empty()) return RefuseWith(connection, refusal);
  }
  if (frame.is_large_import() && !connection.large_turn) {
    connection.large_turn = large_imports_.Enter();
    if (!connection.large_turn)
      return Refuse(connection, {429, "large_imports_max", "another large table is under way"});
    connection.in.reserve(frame.size());
  }
  if (first && frame.expects_continue()) {
    connection.Write("HTTP/1.1 100 Continue\r\n\r\n");
    connection.Flush();
  }
  connection.Extend(TimeFor(frame.size()));
  return Next::kRead;
}

Connections::Next Connections::Refuse(Connection& connection, const Refusal& refusal) {
  return RefuseWith(connection, refuse_(refusal, connection.peer));
}

Connections::Next Connections::RefuseWith(Connection& connection, const std::string& answer) {
  connection.in = {};
  connection.large_turn.reset();
  connection.closing = true;
  connection.Write(answer);
  connection.Await(TimeFor(connection.unsent()));
  return Send(connection);
}

Connections::Next Connections::Send(Connection& connection) {
  connection.Flush();
  if (connection.broken) return Next::kClose;
  return connection.unsent() == 0 ? AfterSending(connection) : Next::kWrite;
}

Connections::Next Connections::AfterSending(Connection& connection) {
  if (connection.out.capacity() > kSmallBuffer) connection.out = {};
  connection.Await(seconds(connection.closing ? kHeadSecondsMax : kIdleSecondsMax));
  if (!connection.closing) return Next::kRead;
  // What the client still sends is read and thrown away: a reset would take the answer from it.
  shutdown(connection.socket, SHUT_WR);
  connection.draining = true;
  return Next::kRead;
}

void Connections::SweepLoop() {
  std::unique_lock lock(mutex_);
  while (!stop_sweeping_.wait_for(lock, kSweepPeriod, [this] { return stopping_.load(); })) {
    const auto now = Clock::now().time_since_epoch().count();
    for (const auto& [socket, connection] : connections_) {
      if (connection->busy || connection->deadline > now) continue;
      if (!connection->expired.exchange(true)) ++closed_early_;
      // Reading then ends at once, which a thread sees and answers; writing is given up later.
      shutdown(socket, now - connection->deadline > Clock::duration(seconds(1)).count() ? SHUT_RDWR
                                                                                        : SHUT_RD);
    }
  }
}

void Connections::MakeRoom() {
  const std::lock_guard lock(mutex_);
  const bool many = connections_.size() > kConnectionsMax;
  Connection* oldest = nullptr;
  for (const auto& [socket, connection] : connections_) {
    const bool helps = many || connection->accounted > 0;
    if (!helps || connection->busy || connection->expired) continue;
    if (oldest == nullptr || connection->since < oldest->since) oldest = connection.get();
  }
  if (oldest == nullptr) return;
  oldest->expired = oldest->evicted = true;
  buffered_ -= oldest->accounted.exchange(0);
  ++closed_early_;
  shutdown(oldest->socket, SHUT_RDWR);
}

}  // namespace plenum::server
