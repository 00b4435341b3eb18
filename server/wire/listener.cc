#include "server/wire/listener.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <memory>
#include <thread>

namespace plenum::server {
namespace {

constexpr int kListenBacklog = 1024;
constexpr std::chrono::milliseconds kNoRoomPause{10};

// A socket that listens at the address, or -1. It shares its port with nobody who listens there.
int ListenAt(const addrinfo& address) {
  const int fd = socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd < 0) return -1;
  const int on = 1, off = 0;
  setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  if (address.ai_family == AF_INET6) setsockopt(fd, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof off);
  if (bind(fd, address.ai_addr, address.ai_addrlen) == 0 && listen(fd, kListenBacklog) == 0)
    return fd;
  close(fd);
  return -1;
}

int PortOf(int fd) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  if (getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length) != 0) return 0;
  return ntohs(address.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6*>(&address)->sin6_port
                                             : reinterpret_cast<sockaddr_in*>(&address)->sin_port);
}

}  // namespace

Listener::~Listener() {
  for (const int fd : {socket_, wake_})
    if (fd >= 0) close(fd);
}

int Listener::Bind(const std::string& host, int port) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_ < 0 || getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found) != 0)
    return 0;
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> all(found, &freeaddrinfo);
  for (const addrinfo* one = found; one != nullptr && socket_ < 0; one = one->ai_next)
    socket_ = ListenAt(*one);
  return socket_ < 0 ? 0 : PortOf(socket_);
}

void Listener::Run(const std::function<void(int socket)>& admit) {
  while (!stopping_) {
    pollfd waited[] = {{socket_, POLLIN, 0}, {wake_, POLLIN, 0}};
    if (poll(waited, 2, -1) < 0 && errno != EINTR) std::this_thread::sleep_for(kNoRoomPause);
    while (!stopping_) {
      const int fd = accept4(socket_, nullptr, nullptr, SOCK_CLOEXEC);
      if (fd >= 0) {
        const int on = 1;
        setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
        admit(fd);
        continue;
      }
      if (errno == EAGAIN || errno == EWOULDBLOCK) break;
      // A client that left at once, or no room: EMFILE, ENFILE, ENOBUFS, ENOMEM.
      if (errno != EINTR && errno != ECONNABORTED) std::this_thread::sleep_for(kNoRoomPause);
    }
  }
  close(socket_);  // whoever still comes is told so
  socket_ = -1;
}

void Listener::Stop() {
  stopping_ = true;
  if (wake_ >= 0) eventfd_write(wake_, 1);
}

}  // namespace plenum::server
