#include "server/wire/chunked_body.h"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "server/call/service_limits.h"
#include "server/wire/grammar.h"

namespace plenum::server {
namespace {

constexpr std::size_t kChunkLineMax = 256;
// Each chunk costs a line; a body in single bytes would be seven times its size.
constexpr std::size_t kChunkedBytesMax = 2 * kBodyBytesMax;

// What is left after the token, or the quoted string, that a text begins with; nothing where it
// begins with neither.
std::optional<std::string_view> AfterWord(std::string_view text) {
  if (!text.starts_with('"')) {
    std::size_t end = 0;
    while (end < text.size() && IsToken(text.substr(end, 1))) ++end;
    return end == 0 ? std::nullopt : std::optional(text.substr(end));
  }
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == '"') return text.substr(i + 1);
    if (text[i] == '\\') ++i;
  }
  return std::nullopt;
}

// Extensions: nothing, or ";name" and ";name=value" (RFC 9112, 7.1.1). They are ignored.
bool AreExtensions(std::string_view text) {
  while (!text.empty()) {
    text = Trim(text);
    if (!text.starts_with(';')) return false;
    text = Trim(text.substr(1));
    auto rest = text.starts_with('"') ? std::nullopt : AfterWord(text);
    if (!rest) return false;
    if (const auto next = Trim(*rest); next.starts_with('=')) {
      rest = AfterWord(Trim(next.substr(1)));
      if (!rest) return false;
    }
    text = *rest;
  }
  return true;
}

// The length that the line of a chunk gives; the largest number where it is beyond all.
std::optional<std::size_t> LengthIn(std::string_view line) {
  std::size_t length = 0;
  const char* const begin = line.data();
  const auto [end, error] = std::from_chars(begin, begin + line.size(), length, 16);
  if (error == std::errc::invalid_argument) return std::nullopt;
  if (!AreExtensions(line.substr(static_cast<std::size_t>(end - begin)))) return std::nullopt;
  return error == std::errc() ? length : std::numeric_limits<std::size_t>::max();
}

// The line that begins at `at`, without its end; nothing if the end has not come.
std::optional<std::string_view> LineAt(std::string_view bytes, std::size_t at) {
  const auto end = bytes.find(kLineEnd, at);
  if (end == std::string_view::npos) return std::nullopt;
  return bytes.substr(at, end - at);
}

}  // namespace

ChunkedBody::State ChunkedBody::Refuse(int status, std::string limit, std::string detail) {
  refusal_ = {status, std::move(limit), std::move(detail)};
  return state_ = State::kRefused;
}

ChunkedBody::State ChunkedBody::Look(std::string_view bytes) {
  while (state_ == State::kMore && next_ < bytes.size()) {
    const auto line = LineAt(bytes, next_);
    if (!line) return LookAtRest(bytes.substr(next_));
    const std::size_t before = next_;
    if (in_trailer_)
      ReadTrailer(*line);
    else
      ReadChunk(bytes, *line);
    if (next_ == before) break;  // the chunk has not come
  }
  return state_;
}

ChunkedBody::State ChunkedBody::ReadChunk(std::string_view bytes, std::string_view line) {
  const auto length =
      line.size() > kChunkLineMax || HasControl(line, "\t") ? std::nullopt : LengthIn(line);
  if (!length) return Refuse(400, "", "a chunk of the body does not begin with its length");
  if (*length > kBodyBytesMax - data_size_ || next_ > kChunkedBytesMax)
    return Refuse(413, "body_bytes_max", "the body is too large");
  const std::size_t data = next_ + line.size() + kLineEnd.size();
  if (*length == 0) {
    in_trailer_ = true;
    next_ = trailer_begin_ = data;
    return state_;
  }
  const std::size_t end = data + *length;
  const std::string_view after = bytes.substr(std::min(end, bytes.size()), kLineEnd.size());
  if (!kLineEnd.starts_with(after))
    return Refuse(400, "", "a chunk of the body does not end where it should");
  if (after.size() < kLineEnd.size()) return state_;
  next_ = end + kLineEnd.size();
  data_size_ += *length;
  return state_;
}

ChunkedBody::State ChunkedBody::ReadTrailer(std::string_view line) {
  if (!line.empty() && !ReadFieldLine(line))
    return Refuse(400, "", "a field after the last chunk is not of the form \"Name: value\"");
  if (!line.empty() && ++trailer_fields_ > kHeadersMax)
    return Refuse(431, "headers_max", "there are too many fields after the last chunk");
  next_ += line.size() + kLineEnd.size();
  if (next_ - trailer_begin_ > kHeadBytesMax)
    return Refuse(431, "head_bytes_max", "the fields after the last chunk are too long");
  return line.empty() ? state_ = State::kWhole : state_;
}

// Of a line whose end has not come.
ChunkedBody::State ChunkedBody::LookAtRest(std::string_view rest) {
  const std::size_t limit = in_trailer_ ? kHeadBytesMax : kChunkLineMax;
  if (rest.ends_with('\r')) rest.remove_suffix(1);
  if (HasControl(rest, "\t"))
    return Refuse(400, "", "a line of the body's chunks does not end with CR and LF");
  if (rest.size() <= limit) return state_;
  if (in_trailer_)
    return Refuse(431, "head_bytes_max", "the fields after the last chunk are too long");
  return Refuse(400, "", "a chunk of the body does not begin with its length");
}

std::string JoinChunks(std::string_view body) {
  std::string data;
  for (std::size_t at = 0;;) {
    const auto line = LineAt(body, at);
    const auto length = line ? LengthIn(*line) : std::nullopt;
    if (!length || *length == 0) return data;
    at += line->size() + kLineEnd.size();
    data.append(body, at, *length);
    at += *length + kLineEnd.size();
  }
}

}  // namespace plenum::server
