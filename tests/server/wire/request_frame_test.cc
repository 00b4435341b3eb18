// Where one request ends; all that a client may send is in http_cases.txt.
#include "server/wire/request_frame.h"

#include <gtest/gtest.h>

#include <string>

#include "server/call/service_limits.h"

namespace plenum::server {
namespace request_frame_test {

TEST(Frame, FindsTheEndOfARequest) {
  const std::string two =
      "POST / HTTP/1.1\r\nHost: a\r\nContent-Length: 3\r\n\r\nabcGET / HTTP/1.1\r\n\r\n";
  for (std::size_t size = 0; size < two.size(); ++size) {
    RequestFrame frame;
    const auto state = frame.Look(two.substr(0, size));
    EXPECT_EQ(state == RequestFrame::State::kComplete, size >= two.find("GET")) << size;
  }
  RequestFrame frame;
  std::string bytes = two;
  ASSERT_EQ(frame.Look(bytes), RequestFrame::State::kComplete);
  const RequestHead head = frame.TakeHead(bytes);
  EXPECT_EQ(head.method, "POST");
  EXPECT_EQ(head.Field("host"), "a");
  EXPECT_EQ(frame.TakeBody(bytes), "abc");
  EXPECT_EQ(bytes, "GET / HTTP/1.1\r\n\r\n");
}

TEST(Frame, JoinsChunksHoweverTheyCome) {
  const std::string whole =
      "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n"
      "3;x=y\r\nabc\r\nA\r\n0123456789\r\n0\r\nDigest: x\r\nA: b\r\n\r\n";
  RequestFrame frame;
  for (std::size_t size = 1; size < whole.size(); ++size)
    ASSERT_LT(frame.Look(whole.substr(0, size)), RequestFrame::State::kComplete) << size;
  ASSERT_EQ(frame.Look(whole), RequestFrame::State::kComplete);
  std::string bytes = whole + "rest";
  frame.TakeHead(bytes);
  EXPECT_EQ(frame.TakeBody(bytes), "abc0123456789");
  EXPECT_EQ(bytes, "rest");
}

TEST(Frame, RefusesWhatNeighboursMightReadAsAnother) {
  const auto status = [](const std::string& fields, const std::string& body = "") {
    RequestFrame frame;
    const auto state = frame.Look("POST / HTTP/1.1\r\n" + fields + "\r\n" + body);
    return state == RequestFrame::State::kRefused ? frame.refusal().status : 0;
  };
  EXPECT_EQ(status("Content-Length: 1\r\nContent-Length: 1\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 1, 1\r\n"), 400);
  EXPECT_EQ(status("Host: localhost\r\nHost: localhost\r\n"), 400);
  EXPECT_EQ(status("Host: localhost\r\nhost: other\r\n"), 400);
  EXPECT_EQ(status("Content-Length: +1\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 0x1\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 99999999999999999999\r\n"), 400);
  EXPECT_EQ(status("Content-Length: 99999999999\r\n"), 413);
  EXPECT_EQ(status("Content-Length: 1\r\nTransfer-Encoding: chunked\r\n"), 400);
  EXPECT_EQ(status("Transfer-Encoding: gzip, chunked\r\n"), 501);
  EXPECT_EQ(status("Transfer-Encoding : chunked\r\n"), 400);
  EXPECT_EQ(status("A: b\r\n c\r\n"), 400);
  EXPECT_EQ(status("A: b\nB: c\r\n"), 400);
  EXPECT_EQ(status(std::string("A: \0\r\n", 6)), 400);
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", "-1\r\n"), 400);
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", "1\r\nab\r\n"), 400);
  for (const char c : {'\n', '\r', '\0', '\x1b', '\x7f'}) {
    EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", std::string("2;a") + c + "b\r\n"), 400);
    EXPECT_EQ(status(std::string("A: b") + c + "c\r\n"), 400);
  }
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", "0\r\nTrailer : x\r\n\r\n"), 400);
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n",
                   "0\r\nTrailer: " + std::string(kHeadBytesMax, 'x') + "\r\n\r\n"),
            431);
  EXPECT_EQ(status("Transfer-Encoding: chunked\r\n", "FFFFFFFFFFFFFFFF\r\n"), 413);
  EXPECT_EQ(status("A: " + std::string(kHeadBytesMax, 'a') + "\r\n"), 431);
  std::string many;
  for (int i = 0; i < 101; ++i) many += "A: b\r\n";
  EXPECT_EQ(status(many), 431);
}

}  // namespace request_frame_test
}  // namespace plenum::server
