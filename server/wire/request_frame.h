// Finds where one HTTP/1.1 request ends in the bytes of a connection (RFC 9112, sections 2 to 7),
// before anything else of it is read. Strict where a lenient reader could be led to see another
// request than its neighbour: one length, given once, no folded lines, no bare line feeds.
#ifndef PLENUM_SERVER_WIRE_REQUEST_FRAME_H_
#define PLENUM_SERVER_WIRE_REQUEST_FRAME_H_

#include <cstddef>
#include <string>
#include <string_view>

namespace plenum::server {

inline constexpr std::string_view kLineEnd = "\r\n";

// Why bytes are no request that is served. `limit` names the limit that they exceed, if any.
struct Refusal {
  int status = 0;
  std::string limit;
  std::string detail;
};

class RequestFrame {
 public:
  enum class State { kHead, kBody, kComplete, kRefused };

  // Looks at all that has arrived of the request, which begins with `bytes`; remembers how far it
  // has looked before. kHead and kBody: more must come.
  State Look(std::string_view bytes);

  // How many bytes of the request are known of: all of a complete one.
  std::size_t size() const { return end_; }
  // Of the line and headers with the empty line, once they have come.
  std::size_t head_size() const { return head_size_; }
  // Whether the body is larger than all but a table of parts may be: kBody or kComplete.
  bool is_large_import() const;
  // Takes a complete request from the beginning of `bytes`: the line and headers with the empty
  // line, and the body with its chunks joined.
  std::string TakeHead(std::string& bytes) const;
  std::string TakeBody(std::string& bytes) const;  // after the head
  // Whether the client waits for "100 Continue" before it sends the body.
  bool expects_continue() const { return expects_continue_; }
  const Refusal& refusal() const { return refusal_; }

 private:
  State Refuse(int status, std::string limit, std::string detail);
  State ReadHead(std::string_view head);
  bool ReadField(std::string_view name, std::string_view value);
  State LookAtChunks(std::string_view bytes);

  State state_ = State::kHead;
  std::size_t seen_ = 0;       // of the head, searched for its end
  std::size_t head_size_ = 0;  // with the empty line
  std::size_t end_ = 0;        // of the request; of chunks, the place of the next one
  std::size_t body_size_ = 0;  // of the chunks so far
  bool has_length_ = false, has_host_ = false, chunked_ = false, expects_continue_ = false;
  Refusal refusal_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_REQUEST_FRAME_H_
