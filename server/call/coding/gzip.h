// Texts that are compressed once and then joined to whole answers in gzip (RFC 1952): a text
// becomes blocks of deflate (RFC 1951) that refer to nothing before them and end at a whole byte,
// so that the blocks of several texts one after the other are those of the texts together.
#ifndef PLENUM_SERVER_CALL_CODING_GZIP_H_
#define PLENUM_SERVER_CALL_CODING_GZIP_H_

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "server/call/reply.h"

namespace plenum::server {

struct Deflated {
  std::string blocks;  // without a last one
  unsigned long crc = 0;
  std::size_t size = 0;  // of the text
};
Deflated Deflate(std::string_view text);

// One member: head and text `before`, the blocks of `text` as they are, `after` and the end.
std::vector<Bytes> GzipOf(std::string_view before, const std::shared_ptr<const Deflated>& text,
                          std::string_view after);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_CODING_GZIP_H_
