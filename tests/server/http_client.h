// The real service on a free loopback port, and what its tests ask of it.
#ifndef PLENUM_TESTS_SERVER_HTTP_CLIENT_H_
#define PLENUM_TESTS_SERVER_HTTP_CLIENT_H_

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>
#include <string>

#include "tests/server/service.h"
#include "tests/server/workbench.h"

namespace plenum::server {

inline constexpr char kJson[] = "application/json";
inline constexpr char kProblem[] = "application/problem+json";

class Http : public testing::Test {
 protected:
  Http() { client_->set_read_timeout(60); }

  static api::Json Body(const httplib::Result& result) {
    auto parsed = api::ParseJson(result ? result->body : "");
    return std::holds_alternative<api::Json>(parsed) ? std::get<api::Json>(parsed) : api::Json();
  }

  // A problem document of that status with an error at `pointer` ("" asks for none).
  static void ExpectProblem(const httplib::Result& result, int status,
                            const std::string& pointer = "") {
    ASSERT_TRUE(result) << httplib::to_string(result.error());
    EXPECT_EQ(result->status, status) << result->body;
    EXPECT_EQ(result->get_header_value("Content-Type"), kProblem);
    const auto body = Body(result);
    EXPECT_EQ(body["status"], status);
    if (pointer.empty()) return;
    std::string pointers;
    for (const auto& error : body["errors"]) pointers += error["pointer"].get<std::string>() + " ";
    EXPECT_THAT(pointers, testing::HasSubstr(pointer));
  }

  // Sends bytes as they are and gives all that comes back until the service closes.
  std::string Raw(const std::string& bytes) const {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(service_.port()));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval patience{20, 0};
    setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    std::string answer;
    if (connect(fd, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) {
      send(fd, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      char buffer[4096];
      for (ssize_t n; (n = recv(fd, buffer, sizeof buffer, 0)) > 0;)
        answer.append(buffer, static_cast<std::size_t>(n));
    }
    close(fd);
    return answer;
  }

  const Service service_{OneJobAtATime()};
  const Workbench& bench_ = service_.bench();
  const std::unique_ptr<httplib::Client> client_ =
      std::make_unique<httplib::Client>("127.0.0.1", service_.port());
};

}  // namespace plenum::server

#endif  // PLENUM_TESTS_SERVER_HTTP_CLIENT_H_
