#include "server/wire/protocol.h"

#include <strings.h>
#include <sys/socket.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

#include "server/wire/request_frame.h"

namespace plenum::server {
namespace {

constexpr int kListenBacklog = 1024;
constexpr int kCannotRead = 400;

// A head to read from. What httplib answers to it is kept: its status tells why it cannot be read.
class HeadStream : public httplib::Stream {
 public:
  explicit HeadStream(const Incoming& request) : request_(request) {}

  bool is_readable() const override { return read_ < request_.head.size(); }
  bool is_writable() const override { return true; }
  ssize_t read(char* to, std::size_t size) override {
    const std::size_t n = request_.head.copy(to, size, read_);
    read_ += n;
    return static_cast<ssize_t>(n);
  }
  ssize_t write(const char* from, std::size_t size) override {
    answer_.append(from, size);
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

  int status() const {
    constexpr std::size_t kStatusAt = std::string_view("HTTP/1.1 ").size();
    const int status = answer_.size() > kStatusAt ? std::atoi(answer_.c_str() + kStatusAt) : 0;
    return status >= 400 ? status : kCannotRead;
  }

 private:
  const Incoming& request_;
  std::size_t read_ = 0;
  std::string answer_;
};

bool BeginsWith(std::string_view text, std::string_view beginning) {
  return text.size() >= beginning.size() &&
         strncasecmp(text.data(), beginning.data(), beginning.size()) == 0;
}

void DropFields(std::string& head, std::string_view name) {
  for (std::size_t at = head.find(kLineEnd); at != std::string::npos;) {
    const std::size_t line = at + kLineEnd.size(), end = head.find(kLineEnd, line);
    if (end != std::string::npos && BeginsWith(std::string_view(head).substr(line), name))
      head.erase(line, end + kLineEnd.size() - line);
    else
      at = end;
  }
}

// "GET http://host/path" as "GET /path" with that Host.
void ToOriginForm(std::string& head) {
  const std::size_t target = head.find(' ') + 1;
  const std::size_t end = head.find(' ', target);
  if (target == 0 || end == std::string::npos) return;
  const std::string_view text = std::string_view(head).substr(target, end - target);
  const bool absolute = BeginsWith(text, "http://") || BeginsWith(text, "https://");
  if (!absolute) return;
  const std::size_t begin = text.find("//") + 2;
  const std::size_t path = std::min(text.find_first_of("/?", begin), text.size());
  const std::string authority(text.substr(begin, path - begin));
  std::string rest(text.substr(path));
  if (!rest.starts_with('/')) rest.insert(0, "/");
  head.replace(target, end - target, rest);
  DropFields(head, "host:");
  head.insert(head.find(kLineEnd) + kLineEnd.size(), "Host: " + authority + std::string(kLineEnd));
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
  set_pre_routing_handler(
      [](const auto&, auto&) { return httplib::Server::HandlerResponse::Handled; });
}

std::variant<httplib::Request, int> Protocol::Read(Incoming request) {
  // Answers are whole, which RFC 9110 allows (14.2); httplib would refuse some ranges.
  DropFields(request.head, "range:");
  ToOriginForm(request.head);
  HeadStream stream(request);
  std::optional<httplib::Request> read;
  const auto take = [&](httplib::Request& parsed) {
    read = std::move(parsed);
    parsed = {};
  };
  bool closed = false;
  process_request(stream, true, closed, take);
  if (!read) return stream.status();
  read->body = std::move(request.body);
  return *std::move(read);
}

void Protocol::WidenBacklog() { ::listen(svr_sock_, kListenBacklog); }

bool Protocol::process_and_close_socket(socket_t socket) {
  admit(socket);
  return true;
}

bool ClosesAfter(const httplib::Request& request) {
  bool close = false, keep_alive = false;
  const auto [begin, end] = request.headers.equal_range("Connection");
  for (auto field = begin; field != end; ++field) {
    std::string_view rest = field->second;
    while (!rest.empty()) {
      const std::size_t comma = std::min(rest.find(','), rest.size());
      std::string_view option = rest.substr(0, comma);
      rest.remove_prefix(std::min(comma + 1, rest.size()));
      const std::size_t first = std::min(option.find_first_not_of(" \t"), option.size());
      option.remove_prefix(first);
      option = option.substr(0, option.find_last_not_of(" \t") + 1);
      close = close || (option.size() == 5 && BeginsWith(option, "close"));
      keep_alive = keep_alive || (option.size() == 10 && BeginsWith(option, "keep-alive"));
    }
  }
  return close || (request.version == "HTTP/1.0" && !keep_alive);
}

}  // namespace plenum::server
