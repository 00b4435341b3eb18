#include "server/wire/connections.h"

#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <utility>

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using For = PollSet::For;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kSpareThreads = 4;
constexpr int kRequestsAtOnce = 16;  // of one connection before others have a turn
constexpr std::size_t kReadBytes = 64 << 10;
constexpr std::size_t kDrainBytesMax = 64 << 20;
constexpr milliseconds kSweepPeriod{500};
constexpr milliseconds kUnparkPause{5};  // between two looks at who waits
constexpr milliseconds kConnectionsStopPatience{1000};
constexpr milliseconds kAskAgain{1000};  // of an answer whose next piece is waited for

// Time to move so many bytes.
seconds TimeFor(std::size_t bytes, std::size_t per_second) {
  return seconds(kHeadSecondsMax + bytes / per_second);
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

Connections::Connections(Handlers handlers) : handlers_(std::move(handlers)) { RaiseFileLimit(); }

Connections::~Connections() { Stop(); }

void Connections::Start(int places) {
  places_.Open(places);
  for (int i = 0; i < places + kSpareThreads; ++i) workers_.emplace_back([this] { WorkLoop(); });
  sweeper_ = std::thread([this] { SweepLoop(); });
}

void Connections::Stop() {
  // Who waits for a job is told where it can be found.
  for (const auto until = Clock::now() + kConnectionsStopPatience;
       !workers_.empty() && Clock::now() < until;) {
    Wake();
    std::this_thread::sleep_for(kUnparkPause);
    const std::lock_guard lock(mutex_);
    if (parked_.empty()) break;
  }
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  attention_.notify_all();
  poll_set_.WakeAll();
  for (auto& worker : workers_) worker.join();
  workers_.clear();
  if (sweeper_.joinable()) sweeper_.join();
  decltype(connections_) closed;  // after the lock
  const std::lock_guard lock(mutex_);
  parked_.clear();
  closed.swap(connections_);
}

std::size_t Connections::open() const {
  const std::lock_guard lock(mutex_);
  return connections_.size();
}

void Connections::Admit(int socket) {
  std::unique_ptr<ClientConnection> connection;
  try {
    connection = std::make_unique<ClientConnection>(socket);
    ClientConnection& admitted = *connection;
    const std::lock_guard lock(mutex_);
    connections_[socket] = std::move(connection);
    if (!poll_set_.Add(socket, &admitted)) connections_.erase(socket);
    if (connections_.size() > kConnectionsMax) MakeRoom();
  } catch (const std::exception&) {
    if (!connection) close(socket);
  }
}

void Connections::WorkLoop() {
  while (!stopping_) {
    auto* const taken = static_cast<ClientConnection*>(poll_set_.Take());
    if (taken == nullptr) continue;
    ClientConnection& connection = *taken;
    connection.attention.busy = true;
    Next next = Next::kClose;
    try {
      next = Advance(connection);
    } catch (const std::exception&) {  // no memory: this client is let go, others are served
    }
    Account(connection);
    try {
      HandOver(connection, next);
    } catch (const std::exception&) {  // it is in no list yet
      Close(connection);
    }
  }
}

// The last that a thread does with a connection: another may have it then.
void Connections::HandOver(ClientConnection& connection, Next next) {
  switch (next) {
    case Next::kGoOn:
    case Next::kAgain:
      return Arm(connection, For::kWriting);
    case Next::kPark:
      return Park(connection);
    case Next::kQueue:
      if (places_.TakeOrQueue(connection)) Arm(connection, For::kWriting);
      return;
    case Next::kClose:
      return Close(connection);
    case Next::kRead:
    case Next::kWrite:
      break;
  }
  connection.attention.busy = false;
  Arm(connection, next == Next::kRead ? For::kReading : For::kWriting);
  if (buffered_ <= kBufferedBytesMax) return;
  const std::lock_guard lock(mutex_);
  MakeRoom();
}

void Connections::Arm(ClientConnection& connection, For what) {
  poll_set_.Arm(connection.socket, &connection, what);
}

void Connections::Close(ClientConnection& connection) {
  LeavePlace(connection);
  buffered_ -= connection.attention.counted.exchange(0);
  std::unique_ptr<ClientConnection>
      closed;  // after the lock: what it holds may call Wake when it goes
  const std::lock_guard lock(mutex_);
  const auto place = connections_.find(connection.socket);
  closed = std::move(place->second);
  connections_.erase(place);
}

void Connections::Account(ClientConnection& connection) {
  const std::size_t held = connection.held_bytes();
  buffered_ += held - connection.attention.counted.exchange(held);  // modulo 2^64
}

// As far as it goes without waiting for anybody.
Connections::Next Connections::Advance(ClientConnection& connection) {
  for (int served = 0; served < kRequestsAtOnce;) {
    switch (connection.answer.SendTo(connection.socket)) {
      case Answer::Sent::kAll:
        break;
      case Answer::Sent::kSome:
        return Next::kAgain;
      case Answer::Sent::kBlocked:
        connection.attention.Extend(TimeFor(connection.answer.due(), kAnswerBytesPerSecondMin));
        connection.attention.active = Clock::now().time_since_epoch().count();
        return Next::kWrite;
      case Answer::Sent::kWaits:
        connection.attention.Await(seconds(kHeadSecondsMax));
        connection.waiting.wake_at = Clock::now() + kAskAgain;
        connection.waiting.on_change = true;
        return Next::kPark;
      case Answer::Sent::kBroken:
        return Next::kClose;
    }
    served += connection.HasRequest();
    const Next next = connection.answer.moved() > 0 ? AfterSending(connection)
                      : connection.HasRequest()     ? Serve(connection)
                                                    : Receive(connection);
    if (next != Next::kGoOn) return next;
  }
  return Next::kAgain;
}

Connections::Next Connections::AfterSending(ClientConnection& connection) {
  connection.answer = {};
  connection.attention.Await(seconds(connection.closing ? kHeadSecondsMax : kIdleSecondsMax));
  if (!connection.closing)
    return connection.arriving.bytes.empty() ? Next::kGoOn : TakeRequest(connection);
  // What the client still sends is read and thrown away: a reset would take the answer from it.
  shutdown(connection.socket, SHUT_WR);
  connection.thrown_away = 0;
  connection.arriving.bytes = {};
  return Next::kRead;
}

Connections::Next Connections::Receive(ClientConnection& connection) {
  thread_local std::string piece(kReadBytes, '\0');
  const ssize_t n = recv(connection.socket, piece.data(), piece.size(), MSG_DONTWAIT);
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR)) return Next::kRead;
  if (n <= 0) {
    if (!connection.attention.expired || connection.arriving.bytes.empty() ||
        connection.thrown_away)
      return Next::kClose;
    const bool in_head = connection.arriving.frame.head_size() == 0;
    Refuse(connection, {408, in_head ? "head_seconds_max" : "body_bytes_per_second_min",
                        "the request did not arrive in time"});
    return Next::kGoOn;
  }
  if (connection.thrown_away) {
    *connection.thrown_away += static_cast<std::size_t>(n);
    return *connection.thrown_away > kDrainBytesMax ? Next::kClose : Next::kRead;
  }
  if (connection.arriving.bytes.empty()) connection.attention.Await(seconds(kHeadSecondsMax));
  connection.arriving.bytes.append(piece, 0, static_cast<std::size_t>(n));
  return TakeRequest(connection);
}

// The first request of those that have arrived, if it is whole.
Connections::Next Connections::TakeRequest(ClientConnection& connection) {
  using State = RequestFrame::State;
  if (connection.arriving.SkipEmptyLine() && connection.arriving.bytes.empty()) {
    connection.attention.Await(seconds(kIdleSecondsMax));
    return Next::kRead;
  }
  const State state = connection.arriving.frame.Look(connection.arriving.bytes);
  if (state == State::kHead) return Next::kRead;
  if (state == State::kBody) return AwaitBody(connection);
  if (state == State::kRefused) {
    Refuse(connection, connection.arriving.frame.refusal());
    return Next::kGoOn;
  }
  connection.request.emplace();
  connection.request->head = connection.arriving.frame.TakeHead(connection.arriving.bytes);
  connection.request->body = connection.arriving.frame.TakeBody(connection.arriving.bytes);
  connection.request->peer = connection.peer;
  connection.is_urgent = handlers_.is_urgent(connection.request->head);
  connection.arriving.frame = {};
  connection.arriving.skipped_line = connection.arriving.examined = false;
  return Next::kGoOn;
}

// Who may not send it is told before the body takes a place from others.
Connections::Next Connections::AwaitBody(ClientConnection& connection) {
  const RequestFrame& frame = connection.arriving.frame;
  const bool first = !std::exchange(connection.arriving.examined, true);
  if (first) {
    std::string refusal = handlers_.examine(frame.head(), connection.peer);
    if (!refusal.empty()) {
      RefuseWith(connection, std::move(refusal));
      return Next::kGoOn;
    }
  }
  if (frame.is_large_import() && !connection.arriving.large_turn) {
    connection.arriving.large_turn = large_imports_.Enter();
    if (!connection.arriving.large_turn) {
      Refuse(connection,
             {429, "large_imports_max", "another large table or document is under way"});
      return Next::kGoOn;
    }
    connection.arriving.bytes.reserve(frame.size());
  }
  connection.attention.Extend(TimeFor(frame.size(), kBytesPerSecondMin));
  if (!first || !frame.expects_continue()) return Next::kRead;
  // So short that it leaves at once; if not, the client may send the body without it.
  constexpr std::string_view kContinue = "HTTP/1.1 100 Continue\r\n\r\n";
  send(connection.socket, kContinue.data(), kContinue.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  return Next::kRead;
}

Connections::Next Connections::Serve(ClientConnection& connection) {
  if (!connection.is_urgent && !places_.Take(connection)) return Next::kQueue;
  connection.waiting.changes_seen = changes_;
  Handled handled;
  if (connection.waiting.resume) {
    handled = std::exchange(connection.waiting.resume, nullptr)(connection);
  } else {
    connection.request->is_last = stopping_;
    Incoming request = std::move(*connection.request);
    connection.request.reset();
    handled = handlers_.handle(std::move(request), connection);
  }
  LeavePlace(connection);
  connection.waiting.held_bytes = handled.held_bytes;
  if (handled.resume) {
    connection.waiting.resume = std::move(handled.resume);
    connection.waiting.wake_at = Clock::now() + handled.patience;
    connection.waiting.on_change = handled.on_change;
    return Next::kPark;
  }
  connection.closing = !handled.keeps || stopping_;
  connection.arriving.large_turn.reset();
  connection.attention.Await(seconds(kHeadSecondsMax));
  return Next::kGoOn;
}

void Connections::Refuse(ClientConnection& connection, const Refusal& refusal) {
  RefuseWith(connection, handlers_.refuse(refusal, connection.peer));
}

void Connections::RefuseWith(ClientConnection& connection, std::string answer) {
  connection.arriving.bytes = {};
  connection.arriving.large_turn.reset();
  connection.closing = true;
  connection.Write(std::move(answer));
  connection.attention.Await(seconds(kHeadSecondsMax));
}

void Connections::LeavePlace(ClientConnection& connection) {
  if (ClientConnection* const next = places_.Leave(connection)) Arm(*next, For::kWriting);
}

void Connections::Park(ClientConnection& connection) {
  const std::lock_guard lock(mutex_);
  if (connection.waiting.on_change && connection.waiting.changes_seen != changes_) {
    connection.waiting.wake_at = {};
    woken_ = true;
  }
  parked_.push_back(&connection);
  attention_.notify_all();
}

void Connections::Wake() {
  ++changes_;
  const std::lock_guard lock(mutex_);
  if (parked_.empty()) return;
  woken_ = true;
  attention_.notify_all();
}

// Who may be able to go on.
void Connections::Unpark() {
  const auto now = Clock::now();
  std::erase_if(parked_, [&](ClientConnection* connection) {
    Waiting& waiting = connection->waiting;
    const bool changed = waiting.on_change && waiting.changes_seen != changes_;
    if (!changed && waiting.wake_at > now) return false;
    waiting.changes_seen = changes_;
    Arm(*connection, For::kWriting);
    return true;
  });
}

void Connections::SweepLoop() {
  std::unique_lock lock(mutex_);
  for (auto sweep_at = Clock::now() + kSweepPeriod; !stopping_;) {
    auto until = sweep_at;
    for (const ClientConnection* one : parked_) until = std::min(until, one->waiting.wake_at);
    attention_.wait_until(lock, until,
                          [this] { return stopping_ || std::exchange(woken_, false); });
    Unpark();
    if (Clock::now() >= sweep_at) {
      CloseExpired();
      sweep_at = Clock::now() + kSweepPeriod;
    }
    lock.unlock();
    std::this_thread::sleep_for(kUnparkPause);
    lock.lock();
  }
}

void Connections::CloseExpired() {
  const auto now = Clock::now().time_since_epoch().count();
  for (const auto& [socket, connection] : connections_) {
    Attention& attention = connection->attention;
    if (attention.busy || attention.deadline > now) continue;
    if (!attention.expired.exchange(true)) ++closed_early_;
    // Reading then ends at once, which a thread sees and answers; writing is given up later.
    const bool is_late = now - attention.deadline > Clock::duration(seconds(1)).count();
    shutdown(socket, is_late ? SHUT_RDWR : SHUT_RD);
  }
}

// With the lock held. Whoever is served or reads its answer stays.
void Connections::MakeRoom() {
  const bool many = connections_.size() > kConnectionsMax;
  ClientConnection* oldest = nullptr;
  for (const auto& [socket, connection] : connections_) {
    const Attention& attention = connection->attention;
    const bool helps = many || attention.counted > 0;
    if (!helps || attention.busy || attention.expired) continue;
    if (oldest == nullptr || attention.active < oldest->attention.active) oldest = connection.get();
  }
  if (oldest == nullptr) return;
  oldest->attention.expired = oldest->attention.evicted = true;
  buffered_ -= oldest->attention.counted.exchange(0);
  ++closed_early_;
  shutdown(oldest->socket, SHUT_RDWR);
}

}  // namespace plenum::server
