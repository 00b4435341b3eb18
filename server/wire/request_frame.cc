#include "server/wire/request_frame.h"

#include <algorithm>
#include <charconv>

#include "server/call/service_limits.h"

namespace plenum::server {
namespace {

constexpr std::size_t kChunkLineMax = 256;
// Each chunk costs a line; a body in single bytes would be seven times its size.
constexpr std::size_t kChunkedBytesMax = 2 * kBodyBytesMax;

bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

// RFC 9110, 5.6.2.
bool IsToken(std::string_view text) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

// Control characters of ASCII but those that are allowed (RFC 9110, 5.5; RFC 9112, 2.2).
bool HasControl(std::string_view text, std::string_view allowed) {
  return std::any_of(text.begin(), text.end(), [&](char c) {
    return (static_cast<unsigned char>(c) < ' ' || c == 0x7f) &&
           allowed.find(c) == std::string_view::npos;
  });
}

std::string_view Trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

// Of the request line.
bool IsImport(std::string_view line) {
  constexpr std::string_view kImport = "POST /v1/parts/import";
  return line.starts_with(kImport) && line.substr(kImport.size()).find_first_of("? ") == 0;
}

bool ReadWhole(std::string_view text, int base, std::size_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  return error == std::errc() && end == text.data() + text.size() && !text.empty();
}

// The line that begins at `at`, without its end; nothing if the end has not come.
bool LineAt(std::string_view bytes, std::size_t at, std::string_view& line) {
  const auto end = bytes.find(kLineEnd, at);
  if (end == std::string_view::npos) return false;
  line = bytes.substr(at, end - at);
  return true;
}

}  // namespace

RequestFrame::State RequestFrame::Refuse(int status, std::string limit, std::string detail) {
  refusal_ = {status, std::move(limit), std::move(detail)};
  return state_ = State::kRefused;
}

RequestFrame::State RequestFrame::Look(std::string_view bytes) {
  if (state_ == State::kHead) {
    constexpr std::string_view kHeadEnd = "\r\n\r\n";
    const auto end = bytes.find(kHeadEnd, seen_ < 3 ? 0 : seen_ - 3);
    seen_ = bytes.size();
    const bool found = end != std::string_view::npos;
    if ((found ? end : bytes.size()) > kHeadBytesMax)
      return Refuse(431, "head_bytes_max", "the request line and headers are too long");
    if (!found) return state_;
    head_size_ = end + kHeadEnd.size();
    ReadHead(bytes.substr(0, end));
  }
  if (state_ == State::kBody && chunked_) LookAtChunks(bytes);
  if (state_ == State::kBody && !chunked_ && bytes.size() >= end_) state_ = State::kComplete;
  return state_;
}

RequestFrame::State RequestFrame::ReadHead(std::string_view head) {
  end_ = head_size_;
  std::size_t at = std::min(head.find(kLineEnd), head.size());
  const std::string_view first = head.substr(0, at);
  if (HasControl(first, "") || !IsToken(first.substr(0, first.find(' '))))
    return Refuse(400, "", "the request line is not one of HTTP/1.1");
  for (int count = 1; at < head.size(); ++count) {
    if (count > kHeadersMax) return Refuse(431, "headers_max", "there are too many headers");
    at += kLineEnd.size();
    const auto end = std::min(head.find(kLineEnd, at), head.size());
    const std::string_view line = head.substr(at, end - at);
    at = end;
    const auto colon = line.find(':');
    if (colon == std::string_view::npos || !IsToken(line.substr(0, colon)) ||
        HasControl(line, "\t"))
      return Refuse(400, "", "a header is not of the form \"Name: value\"");
    if (!ReadField(line.substr(0, colon), Trim(line.substr(colon + 1)))) return state_;
  }
  if (chunked_ && has_length_)
    return Refuse(400, "", "Content-Length and Transfer-Encoding exclude each other");
  const std::size_t length = end_ - head_size_;
  if (IsImport(first) && length > kImportBytesMax)
    return Refuse(413, "import_bytes_max", "the table is too large; send it in parts");
  if (!IsImport(first) && length > kBodyBytesMax)
    return Refuse(413, "body_bytes_max", "the body is too large");
  return state_ = State::kBody;
}

bool RequestFrame::ReadField(std::string_view name, std::string_view value) {
  if (EqualsIgnoringCase(name, "Content-Length")) {
    std::size_t length = 0;
    const bool digits =
        std::all_of(value.begin(), value.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (has_length_ || !digits || value.size() > 15 || !ReadWhole(value, 10, length))
      return Refuse(400, "", "Content-Length must be one whole number"), false;
    has_length_ = true;
    end_ = head_size_ + length;
  } else if (EqualsIgnoringCase(name, "Transfer-Encoding")) {
    if (chunked_ || !EqualsIgnoringCase(value, "chunked"))
      return Refuse(400, "", "the only Transfer-Encoding understood is chunked"), false;
    chunked_ = true;
  } else if (EqualsIgnoringCase(name, "Host")) {
    if (has_host_) return Refuse(400, "", "Host must be given once"), false;
    has_host_ = true;
  } else if (EqualsIgnoringCase(name, "Expect")) {
    expects_continue_ = EqualsIgnoringCase(value, "100-continue");
  }
  return true;
}

RequestFrame::State RequestFrame::LookAtChunks(std::string_view bytes) {
  std::string_view line;
  while (end_ < bytes.size() && LineAt(bytes, end_, line)) {
    std::size_t length = 0;
    if (line.size() > kChunkLineMax || HasControl(line, "\t") ||
        !ReadWhole(line.substr(0, line.find(';')), 16, length))
      return Refuse(400, "", "a chunk of the body does not begin with its length");
    if (length > kBodyBytesMax - body_size_ || end_ > kChunkedBytesMax)
      return Refuse(413, "body_bytes_max", "the body is too large");
    const std::size_t data = end_ + line.size() + kLineEnd.size();
    const std::size_t next = data + length + kLineEnd.size();
    if (bytes.size() < next) return state_;
    if (bytes.substr(data + length, kLineEnd.size()) != kLineEnd)
      return Refuse(400, "",
                    length == 0 ? "fields after the last chunk are not understood"
                                : "a chunk of the body does not end where it should");
    end_ = next;
    body_size_ += length;
    if (length == 0) return state_ = State::kComplete;
  }
  if (bytes.size() >= end_ + kChunkLineMax + kLineEnd.size())  // and no end of a line in it
    return Refuse(400, "", "a chunk of the body does not begin with its length");
  return state_;
}

bool RequestFrame::is_large_import() const {
  return state_ >= State::kBody && !chunked_ && end_ - head_size_ > kBodyBytesMax;
}

std::string RequestFrame::TakeHead(std::string& bytes) const {
  std::string head = bytes.substr(0, head_size_);
  bytes.erase(0, head_size_);
  return head;
}

std::string RequestFrame::TakeBody(std::string& bytes) const {
  const std::size_t length = end_ - head_size_;
  std::string body;
  if (!chunked_ && bytes.size() == length) {
    body.swap(bytes);  // without a second copy of what may be large
    return body;
  }
  if (!chunked_) body = bytes.substr(0, length);
  std::string_view line;
  for (std::size_t at = 0; chunked_ && at < length && LineAt(bytes, at, line);) {
    std::size_t chunk = 0;
    ReadWhole(line.substr(0, line.find(';')), 16, chunk);
    at += line.size() + kLineEnd.size();
    body.append(bytes, at, chunk);
    at += chunk + kLineEnd.size();
  }
  bytes.erase(0, length);
  return body;
}

}  // namespace plenum::server
