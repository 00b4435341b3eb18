// One connection: what has arrived of it, and what is still to leave.
#ifndef PLENUM_SERVER_WIRE_CLIENT_CONNECTION_H_
#define PLENUM_SERVER_WIRE_CLIENT_CONNECTION_H_

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <optional>
#include <string>

#include "server/wire/exchange.h"
#include "server/wire/request_frame.h"

namespace plenum::server {

// What has been sent of an answer, piece by piece: of one that is made as the client takes it, no
// more than a piece is in memory.
class Answer {
 public:
  enum class Sent {
    kAll,
    kSome,     // the client may take more at once; it is the turn of other connections
    kBlocked,  // until the client reads
    kWaits,    // Flow::kWaits
    kBroken    // the client is gone, or the rest cannot be made
  };
  void Add(Bytes bytes);
  void Follow(Produce produce) { produce_ = std::move(produce); }
  Sent SendTo(int socket);
  bool pending() const { return !pieces_.empty() || produce_; }
  // Bytes that left, and those that did with what can be sent now.
  std::size_t moved() const { return moved_; }
  std::size_t due() const { return moved_ + (pieces_.empty() ? 0 : pieces_.front()->size()); }

 private:
  Sent SendFront(int socket);

  std::deque<Bytes> pieces_;
  Produce produce_;
  std::size_t sent_ = 0;   // of the front
  std::size_t moved_ = 0;  // of all
};

// What has arrived of requests.
struct Arriving {
  // Drops one empty line before the request, which old clients send after a body (RFC 9112, 2.2).
  bool SkipEmptyLine();

  std::string bytes;
  RequestFrame frame;                // of the first
  bool skipped_line = false;         // an empty one before it
  bool examined = false;             // its head, while its body is to come
  std::shared_ptr<void> large_turn;  // while its body is a large table or file
};

// A request that waits without a thread.
struct Waiting {
  std::function<Handled(Outgoing&)> resume;
  std::size_t held_bytes = 0;  // by it
  std::chrono::steady_clock::time_point wake_at{};
  bool on_change = false;
  long long changes_seen = 0;
};

// What the sweeper may read while a thread has the connection.
struct Attention {
  using Clock = std::chrono::steady_clock;

  // Begins a wait for the client, and gives the one that goes on another end.
  void Await(Clock::duration patience);
  void Extend(Clock::duration patience) { deadline = since + patience.count(); }

  std::atomic<std::size_t> counted = 0;  // bytes of requests
  std::atomic<Clock::rep> since = 0, deadline = 0;
  std::atomic<Clock::rep> active = 0;  // when it last moved bytes or began to wait
  std::atomic<bool> busy = false;      // the client is not waited for
  std::atomic<bool> expired = false;   // waited too long, or
  std::atomic<bool> evicted = false;   // had to make room
};

// Belongs to the thread that took it from the poll set, or to none.
struct ClientConnection final : Outgoing {
  explicit ClientConnection(int fd);
  ~ClientConnection() override;
  ClientConnection(const ClientConnection&) = delete;
  ClientConnection& operator=(const ClientConnection&) = delete;

  void Write(std::string bytes) override;
  void Give(Bytes bytes) override { answer.Add(std::move(bytes)); }
  void Follow(Produce produce) override { answer.Follow(std::move(produce)); }
  // A whole request that is not answered.
  bool HasRequest() const { return request || waiting.resume; }
  // Bytes of requests that it holds.
  std::size_t held_bytes() const;

  const int socket;
  const std::string peer;
  Arriving arriving;
  std::optional<Incoming> request;
  Waiting waiting;
  bool is_urgent = false;  // the request needs no place
  bool has_place = false;
  Answer answer;
  bool closing = false;                    // after the answer
  std::optional<std::size_t> thrown_away;  // bytes that came after the last answer
  Attention attention;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_CLIENT_CONNECTION_H_
