#include "server/wire/request_frame.h"

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <variant>

#include "server/call/service_limits.h"
#include "server/wire/grammar.h"

namespace plenum::server {
namespace {

struct BodyLimit {
  std::size_t bytes;
  const char *name, *detail;
};

// Of a body whose length is said.
BodyLimit LimitOf(const RequestHead& head) {
  const std::string_view path = head.path;
  if (head.method == "POST" && path == "/v1/parts/import")
    return {kImportBytesMax, "import_bytes_max", "the table is too large; send it in parts"};
  if (head.method == "POST" && path.starts_with("/v1/parts/") && path.ends_with("/documents"))
    return {kDocumentBytesMax, "document_bytes_max", "the file of a document has at most 20 MiB"};
  return {kBodyBytesMax, "body_bytes_max", "the body is too large"};
}

}  // namespace

RequestFrame::State RequestFrame::Refuse(int status, std::string limit, std::string detail) {
  return Refuse({status, std::move(limit), std::move(detail)});
}

RequestFrame::State RequestFrame::Refuse(Refusal refusal) {
  refusal_ = std::move(refusal);
  return state_ = State::kRefused;
}

RequestFrame::State RequestFrame::Look(std::string_view bytes) {
  if (state_ == State::kHead) LookAtHead(bytes);
  if (state_ != State::kBody) return state_;
  if (!chunked_) return bytes.size() >= end_ ? state_ = State::kComplete : state_;
  const auto chunks = chunks_.Look(bytes.substr(head_size_));
  end_ = head_size_ + chunks_.size();
  if (chunks == ChunkedBody::State::kRefused) return Refuse(chunks_.refusal());
  return chunks == ChunkedBody::State::kWhole ? state_ = State::kComplete : state_;
}

// Up to the empty line. Bytes that can stand in no head are refused as soon as they come.
RequestFrame::State RequestFrame::LookAtHead(std::string_view bytes) {
  for (; state_ == State::kHead && seen_ < bytes.size(); ++seen_) {
    const char c = bytes[seen_];
    const bool after_return = seen_ > line_begin_ && bytes[seen_ - 1] == '\r';
    if (seen_ >= kHeadBytesMax)
      return Refuse(has_request_line_ ? 431 : 414, "head_bytes_max",
                    has_request_line_ ? "the request line and headers are too long"
                                      : "the request line is too long");
    if (after_return != (c == '\n') || (IsControl(c) && c != '\t' && c != '\r' && c != '\n'))
      return Refuse(400, "", "lines end with CR and LF, and hold no control characters");
    if (c != '\n') continue;
    ReadLine(bytes.substr(line_begin_, seen_ - 1 - line_begin_));
    line_begin_ = seen_ + 1;
  }
  return state_;
}

RequestFrame::State RequestFrame::ReadLine(std::string_view line) {
  if (!std::exchange(has_request_line_, true)) {
    auto read = ReadRequestLine(line);
    if (auto* refusal = std::get_if<Refusal>(&read)) return Refuse(std::move(*refusal));
    head_ = std::get<RequestHead>(std::move(read));
    return state_;
  }
  if (line.empty()) {
    head_size_ = end_ = seen_ + 1;
    return ReadLength();
  }
  const auto field = ReadFieldLine(line);
  if (!field) return Refuse(400, "", "a header is not of the form \"Name: value\"");
  if (head_.fields.size() >= kHeadersMax)
    return Refuse(431, "headers_max", "there are too many headers");
  head_.fields.emplace_back(field->name, field->value);
  return state_;
}

// What the fields say of the body (RFC 9112, 6).
RequestFrame::State RequestFrame::ReadLength() {
  const auto host = head_.Field("Host");
  if (host && !IsHost(*host)) return Refuse(400, "", "Host must be given once, as name or address");
  TakeHostOfTarget(head_);
  expects_continue_ =
      head_.minor_version > 0 && HasMember(head_.Field("Expect").value_or(""), "100-continue");
  const auto codings = head_.Field("Transfer-Encoding");
  const auto length = head_.Field("Content-Length");
  if (codings && length)
    return Refuse(400, "", "Content-Length and Transfer-Encoding exclude each other");
  state_ = State::kBody;
  if (codings) return ReadCodings(*codings);
  return length ? ReadContentLength(*length) : state_;
}

RequestFrame::State RequestFrame::ReadCodings(const std::string& codings) {
  const auto list = Members(codings);
  const auto chunked = std::count_if(list.begin(), list.end(), [](std::string_view one) {
    return EqualsIgnoringCase(one, "chunked");
  });
  if (head_.minor_version == 0) return Refuse(400, "", "HTTP/1.0 knows no Transfer-Encoding");
  if (chunked != 1 || !EqualsIgnoringCase(list.back(), "chunked"))
    return Refuse(400, "", "the last Transfer-Encoding must be chunked, once");
  if (list.size() > 1) return Refuse(501, "", "the only Transfer-Encoding understood is chunked");
  chunked_ = true;
  return state_;
}

RequestFrame::State RequestFrame::ReadContentLength(const std::string& text) {
  constexpr std::size_t kDigitsMax = 15;
  if (text.empty() || text.size() > kDigitsMax ||
      text.find_first_not_of("0123456789") != std::string::npos)
    return Refuse(400, "", "Content-Length must be one whole number");
  const std::size_t length = std::strtoull(text.c_str(), nullptr, 10);
  end_ = head_size_ + length;
  const BodyLimit limit = LimitOf(head_);
  return length > limit.bytes ? Refuse(413, limit.name, limit.detail) : state_;
}

bool RequestFrame::is_large_import() const {
  return state_ >= State::kBody && !chunked_ && end_ - head_size_ > kBodyBytesMax;
}

RequestHead RequestFrame::TakeHead(std::string& bytes) {
  bytes.erase(0, head_size_);
  return std::move(head_);
}

std::string RequestFrame::TakeBody(std::string& bytes) const {
  const std::size_t length = end_ - head_size_;
  std::string body;
  if (!chunked_ && bytes.size() == length) {
    body.swap(bytes);  // without a second copy of what may be large
    return body;
  }
  const auto whole = std::string_view(bytes).substr(0, length);
  body = chunked_ ? JoinChunks(whole) : std::string(whole);
  bytes.erase(0, length);
  return body;
}

}  // namespace plenum::server
