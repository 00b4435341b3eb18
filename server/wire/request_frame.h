// Finds where one HTTP/1.1 request ends in the bytes of a connection (RFC 9112, sections 2 to 7),
// and reads what stands before its body, line by line as they come. Strict where a lenient reader
// could be led to see another request than its neighbour: one length, given once, no folded lines,
// no bare line feeds. docs/reference/http.md lists what it does where the standard leaves a choice.
#ifndef PLENUM_SERVER_WIRE_REQUEST_FRAME_H_
#define PLENUM_SERVER_WIRE_REQUEST_FRAME_H_

#include <cstddef>
#include <string>
#include <string_view>

#include "server/wire/chunked_body.h"
#include "server/wire/refusal.h"
#include "server/wire/request_head.h"

namespace plenum::server {

class RequestFrame {
 public:
  enum class State { kHead, kBody, kComplete, kRefused };

  // Looks at all that has arrived of the request, which begins with `bytes`; remembers how far it
  // has looked before. kHead and kBody: more must come.
  State Look(std::string_view bytes);

  // How many bytes of the request are known of: all of a complete one.
  std::size_t size() const { return end_; }
  // Of the line and fields with the empty line, once they have come, and what they say.
  std::size_t head_size() const { return head_size_; }
  const RequestHead& head() const { return head_; }
  // Whether the body is larger than all but a table of parts or the file of a document may be:
  // kBody or kComplete.
  bool is_large_import() const;
  // Takes a complete request from the beginning of `bytes`: what stands before the body, and the
  // body with its chunks joined.
  RequestHead TakeHead(std::string& bytes);
  std::string TakeBody(std::string& bytes) const;  // after the head
  // Whether the client waits for "100 Continue" before it sends the body.
  bool expects_continue() const { return expects_continue_; }
  const Refusal& refusal() const { return refusal_; }

 private:
  State Refuse(int status, std::string limit, std::string detail);
  State Refuse(Refusal refusal);
  State LookAtHead(std::string_view bytes);
  State ReadLine(std::string_view line);
  State ReadLength();
  State ReadCodings(const std::string& codings);
  State ReadContentLength(const std::string& text);

  State state_ = State::kHead;
  std::size_t seen_ = 0;        // of the head
  std::size_t line_begin_ = 0;  // of its line that is read
  bool has_request_line_ = false;
  RequestHead head_;
  std::size_t head_size_ = 0;
  std::size_t end_ = 0;  // of the request
  bool chunked_ = false, expects_continue_ = false;
  ChunkedBody chunks_;
  Refusal refusal_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_REQUEST_FRAME_H_
