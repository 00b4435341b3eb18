// A connection to the service without any HTTP library.
#ifndef PLENUM_TESTS_SERVER_RAW_H_
#define PLENUM_TESTS_SERVER_RAW_H_

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <string>

namespace plenum::server {

// A connection of bytes.
class Raw {
 public:
  explicit Raw(int port) : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(fd_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (connect(fd_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0)
      ADD_FAILURE() << "no connection";
  }
  ~Raw() { close(fd_); }
  Raw(const Raw&) = delete;

  void Send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
  }
  // Until the service closes, or `end` has come.
  std::string Receive(const std::string& end = "\n\n\n") const {
    std::string answer;
    char buffer[4096];
    for (ssize_t n;
         answer.find(end) == std::string::npos && (n = recv(fd_, buffer, sizeof buffer, 0)) > 0;)
      answer.append(buffer, static_cast<std::size_t>(n));
    return answer;
  }

 private:
  int fd_;
};

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_RAW_H_
