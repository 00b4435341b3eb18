// A body in chunks (RFC 9112, 7.1). Fields after it are read and dropped (6.5.1 of RFC 9110 allows
// it); what they and the lines of chunks may take has limits.
#ifndef PLENUM_SERVER_WIRE_CHUNKED_BODY_H_
#define PLENUM_SERVER_WIRE_CHUNKED_BODY_H_

#include <cstddef>
#include <string>
#include <string_view>

#include "server/wire/refusal.h"

namespace plenum::server {

class ChunkedBody {
 public:
  enum class State { kMore, kWhole, kRefused };

  // Looks at all that has arrived of the body; remembers how far it has looked before.
  State Look(std::string_view bytes);
  // With the lines of chunks and what follows the last: of a whole body, else what is known of.
  std::size_t size() const { return next_; }
  const Refusal& refusal() const { return refusal_; }

 private:
  State Refuse(int status, std::string limit, std::string detail);
  State ReadChunk(std::string_view bytes, std::string_view line);
  State ReadTrailer(std::string_view line);
  State LookAtRest(std::string_view rest);

  State state_ = State::kMore;
  std::size_t next_ = 0;  // the line of a chunk or of the trailer that is read next
  std::size_t data_size_ = 0;
  bool in_trailer_ = false;
  std::size_t trailer_begin_ = 0;
  int trailer_fields_ = 0;
  Refusal refusal_;
};

// The data of a whole body.
std::string JoinChunks(std::string_view body);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_CHUNKED_BODY_H_
