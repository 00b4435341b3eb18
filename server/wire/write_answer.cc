#include "server/wire/write_answer.h"

#include <cstdio>
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

std::string HeadOf(const Reply& reply, const AnswerForm& form) {
  std::string head =
      "HTTP/1.1 " + std::to_string(reply.status) + " " + TitleOf(reply.status) + "\r\n";
  const auto add = [&](const std::string& name, const std::string& value) {
    head.append(name).append(": ").append(value).append("\r\n");
  };
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
