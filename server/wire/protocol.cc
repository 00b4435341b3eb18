#include "server/wire/protocol.h"

#include <strings.h>
#include <sys/socket.h>

#include <utility>

namespace plenum::server {
namespace {

constexpr int kListenBacklog = 1024;

// One request's bytes to read from and its connection to write to.
class RequestStream : public httplib::Stream {
 public:
  RequestStream(const Incoming& request, Outgoing& out) : request_(request), out_(out) {}

  bool is_readable() const override { return read_ < request_.head.size(); }
  bool is_writable() const override { return out_.Flush(); }
  ssize_t read(char* to, std::size_t size) override {
    const std::size_t n = request_.head.copy(to, size, read_);
    read_ += n;
    return static_cast<ssize_t>(n);
  }
  ssize_t write(const char* from, std::size_t size) override {
    out_.Write({from, size});
    return static_cast<ssize_t>(size);
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override {
    ip = request_.peer;
    port = 0;
  }
  void get_local_ip_and_port(std::string& ip, int& port) const override {
    ip.clear();
    port = 0;
  }
  socket_t socket() const override { return 0; }  // there is nothing to select on

 private:
  const Incoming& request_;
  Outgoing& out_;
  std::size_t read_ = 0;
};

// Answers are whole, which RFC 9110 allows (14.2); httplib would cut them under a status of 200.
void DropRange(std::string& head) {
  constexpr std::string_view kLineEnd = "\r\n", kName = "range:";
  for (std::size_t at = head.find(kLineEnd); at != std::string::npos;) {
    const std::size_t line = at + kLineEnd.size(), end = head.find(kLineEnd, line);
    if (end != std::string::npos &&
        strncasecmp(head.c_str() + line, kName.data(), kName.size()) == 0)
      head.erase(line, end + kLineEnd.size() - line);
    else
      at = end;
  }
}

// Runs what it is given at once: accepting a connection only hands it over.
class AtOnce : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

}  // namespace

Protocol::Protocol() {
  new_task_queue = [] { return new AtOnce; };
}

bool Protocol::Answer(Incoming request, Outgoing& out) {
  DropRange(request.head);
  RequestStream stream(request, out);
  bool closed = request.is_last;
  const auto set_body = [&](httplib::Request& parsed) {
    parsed.body = std::move(request.body);
    // "100 Continue" was said when the body was missing.
    parsed.headers.erase("Expect");
    parsed.headers.erase("Accept-Encoding");
  };
  return process_request(stream, request.is_last, closed, set_body) && !closed;
}

void Protocol::WidenBacklog() { ::listen(svr_sock_, kListenBacklog); }

bool Protocol::process_and_close_socket(socket_t socket) {
  admit(socket);
  return true;
}

}  // namespace plenum::server
