#include "server/wire/write_answer.h"

#include <array>
#include <cstdio>
#include <ctime>
#include <utility>

#include "api/json/problem_document.h"

namespace plenum::server {
namespace {

constexpr std::size_t kTogetherBytes = 16
                                       << 10;  // of a body that leaves in one piece with the head

// RFC 9110, 15.3.5 and 15.4.5.
bool HasBody(int status) { return status != 204 && status != 304; }

std::string TitleOf(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 201:
      return "Created";
    case 202:
      return "Accepted";
    case 204:
      return "No Content";
    case 308:
      return "Permanent Redirect";
    case 304:
      return "Not Modified";
    default:
      return api::ProblemDocument(status, "")["title"].get<std::string>();
  }
}

// Now, as "Sun, 06 Nov 1994 08:49:37 GMT" (RFC 9110, 5.6.7), whatever the locale.
std::string HttpDate() {
  constexpr std::array kDays = {"Sun", "Mon", "Tue", "Wed", "Thu", "Fri", "Sat"};
  constexpr std::array kMonths = {"Jan", "Feb", "Mar", "Apr", "May", "Jun",
                                  "Jul", "Aug", "Sep", "Oct", "Nov", "Dec"};
  const std::time_t now = std::time(nullptr);
  std::tm t{};
  gmtime_r(&now, &t);
  char text[64];
  std::snprintf(text, sizeof text, "%s, %02d %s %04d %02d:%02d:%02d GMT",
                kDays[static_cast<std::size_t>(t.tm_wday)], t.tm_mday,
                kMonths[static_cast<std::size_t>(t.tm_mon)], t.tm_year + 1900, t.tm_hour, t.tm_min,
                t.tm_sec);
  return text;
}

std::string HeadOf(const Reply& reply, const AnswerForm& form) {
  std::string head =
      "HTTP/1.1 " + std::to_string(reply.status) + " " + TitleOf(reply.status) + "\r\n";
  const auto add = [&](const std::string& name, const std::string& value) {
    head.append(name).append(": ").append(value).append("\r\n");
  };
  add("Date", HttpDate());
  add("Accept-Ranges", "none");
  for (const auto& [name, value] : reply.headers) add(name, value);
  if (HasBody(reply.status) && !reply.content_type.empty()) add("Content-Type", reply.content_type);
  if (reply.produce && form.may_chunk) add("Transfer-Encoding", "chunked");
  if (!reply.produce && HasBody(reply.status))
    add("Content-Length", std::to_string(reply.body_size()));
  add("Connection", form.closes ? "close" : "Keep-Alive");
  return head + "\r\n";
}

// RFC 9112, 7.1.
Produce InChunks(Produce produce) {
  return [produce = std::move(produce)](std::string& piece) {
    std::string data;
    const Flow flow = produce(data);
    char size[24];
    std::snprintf(size, sizeof size, "%zx\r\n", data.size());
    if (!data.empty()) piece.append(size).append(data).append("\r\n");
    if (flow == Flow::kEnds) piece += "0\r\n\r\n";
    return flow;
  };
}

}  // namespace

void WriteAnswer(Reply reply, const AnswerForm& form, Outgoing& out) {
  std::string head = HeadOf(reply, form);
  const bool has_body = HasBody(reply.status) && !form.is_head;
  if (has_body && reply.body.size() <= kTogetherBytes) head += std::exchange(reply.body, {});
  out.Write(std::move(head));
  if (!has_body) return;
  out.Write(std::move(reply.body));
  for (Bytes& piece : reply.tail) out.Give(std::move(piece));
  if (reply.produce)
    out.Follow(form.may_chunk ? InChunks(std::move(reply.produce)) : std::move(reply.produce));
}

std::string AnswerText(const Reply& reply) { return HeadOf(reply, {.closes = true}) + reply.body; }

}  // namespace plenum::server
