// Entity tags (RFC 9110, 8.8.3) and the conditions that name them.
#ifndef PLENUM_SERVER_CALL_ENTITY_TAG_H_
#define PLENUM_SERVER_CALL_ENTITY_TAG_H_

#include <string>

#include "server/call/reply.h"

namespace plenum::server {

// Strong: equal texts only, and no two texts in practice, have the same tag.
std::string ETag(const std::string& text);

// The tag of the same text in gzip, which is another representation (8.8.3.3).
std::string OfGzip(const std::string& etag);

enum class Compare { kStrong, kWeak };

// Whether a list of entity tags holds `etag`. If-Match compares strongly, where no weak tag
// matches; If-None-Match weakly, where W/ does not count (8.8.3.2).
bool Holds(const std::string& list, const std::string& etag, Compare compare);

// Whether If-None-Match holds it: the client has what it asks for.
bool IsKnown(const Call& call, const std::string& etag);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_ENTITY_TAG_H_
