#include "server/wire/client_connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "server/call/service_limits.h"
#include "server/wire/grammar.h"

namespace plenum::server {
namespace {

constexpr int kSendBufferBytes = 256 << 10;   // of the system, whose own choice are megabytes
constexpr std::size_t kBurstBytes = 1 << 20;  // to one connection before others have a turn

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

}  // namespace

void Answer::Add(Bytes bytes) {
  if (bytes && !bytes->empty()) pieces_.push_back(std::move(bytes));
}

Answer::Sent Answer::SendFront(int socket) {
  const std::string& front = *pieces_.front();
  const ssize_t n =
      send(socket, front.data() + sent_, front.size() - sent_, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (n < 0 && errno == EINTR) return Sent::kSome;
  if (n < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return Sent::kBlocked;
  if (n <= 0) return Sent::kBroken;
  sent_ += static_cast<std::size_t>(n);
  moved_ += static_cast<std::size_t>(n);
  if (sent_ == front.size()) pieces_.pop_front(), sent_ = 0;
  return Sent::kSome;
}

Answer::Sent Answer::SendTo(int socket) {
  for (const std::size_t end = moved_ + kBurstBytes; moved_ < end;) {
    if (!pieces_.empty()) {
      if (const Sent sent = SendFront(socket); sent != Sent::kSome) return sent;
      continue;
    }
    if (!produce_) return Sent::kAll;
    std::string piece;
    const Flow flow = produce_(piece);
    if (flow == Flow::kBroken) return Sent::kBroken;
    if (flow == Flow::kEnds) produce_ = nullptr;
    if (flow == Flow::kWaits && piece.empty()) return Sent::kWaits;
    Add(std::make_shared<const std::string>(std::move(piece)));
  }
  return Sent::kSome;
}

bool Arriving::SkipEmptyLine() {
  if (skipped_line || !bytes.starts_with(kLineEnd)) return false;
  bytes.erase(0, kLineEnd.size());
  frame = {};
  return skipped_line = true;
}

ClientConnection::ClientConnection(int fd) : socket(fd), peer(PeerOf(fd)) {
  attention.Await(std::chrono::seconds(kHeadSecondsMax));
  setsockopt(fd, SOL_SOCKET, SO_SNDBUF, &kSendBufferBytes, sizeof kSendBufferBytes);
}

ClientConnection::~ClientConnection() {
  // A client that is cut off hears of it at once, also while it sends.
  const linger at_once{1, 0};
  if (attention.evicted) setsockopt(socket, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close(socket);
}

void ClientConnection::Write(std::string bytes) {
  answer.Add(std::make_shared<const std::string>(std::move(bytes)));
}

std::size_t ClientConnection::held_bytes() const {
  constexpr std::size_t kSmall = 4 << 10;  // not worth counting
  if (arriving.large_turn) return 0;       // a large table or file has a limit of its own
  std::size_t held = waiting.held_bytes + (request ? request->body.size() : 0);
  if (!answer.pending()) held += arriving.bytes.size();
  return held <= kSmall ? 0 : held;
}

void Attention::Await(Clock::duration patience) {
  const auto now = Clock::now().time_since_epoch().count();
  since = active = now;
  deadline = now + patience.count();
}

}  // namespace plenum::server
