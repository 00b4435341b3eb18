// What a route gets and gives, free of any HTTP library.
#ifndef PLENUM_SERVER_CALL_REPLY_H_
#define PLENUM_SERVER_CALL_REPLY_H_

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/json/json.h"

namespace plenum::server {

struct Call {
  std::string argument;  // the variable part of the path: an id
  std::multimap<std::string, std::string> query;
  std::function<std::optional<std::string>(const char*)> header;
  std::string_view body;  // lives as long as the call is answered
  std::string path;
  std::string user = {};    // the name of the caller's token; empty where none was needed
  std::string client = {};  // the id of the token, or the address where none was needed
  // Of a large request, while its body is read and its answer built: a route that then computes
  // gives the turn back (service_limits.h).
  mutable std::shared_ptr<void> turn = {};
};

using Bytes = std::shared_ptr<const std::string>;  // of an answer, shared by all who read it

// What becomes of a body that is made as the client takes it.
enum class Flow {
  kMore,    // there is a piece, and more to come
  kWaits,   // nothing more yet: asked again when something has changed, and at least once a second
  kEnds,    // with this piece, if any
  kBroken,  // cannot be completed: the connection is cut
};
// Appends the next piece, of about kPieceBytes. It never waits.
using Produce = std::function<Flow(std::string& piece)>;
inline constexpr std::size_t kPieceBytes = 32 << 10;

struct Reply {
  int status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  // Of a body of unknown length, in place of `body`.
  Produce produce;
  std::vector<Bytes> tail = {};  // of the body
  // Set where there is no answer yet: asked again as kWaits is, until it gives one.
  std::function<std::optional<Reply>()> later = {};

  std::size_t body_size() const;
};

// The same with a body that is shared by all copies.
Reply Shared(Reply reply);

// Text of a JSON value on one line, or indented. Bytes that are not UTF-8 are replaced.
std::string Dump(const api::Json& json, int indent = -1);

Reply JsonReply(int status, const api::Json& json);
Reply ProblemReply(int status, const api::Errors& errors);
Reply ProblemReply(int status, const std::string& detail);

// Errors on query parameters that are not known, or given twice and not among `repeated`.
api::Errors CheckQuery(const Call& call, const std::vector<std::string_view>& known,
                       const std::vector<std::string_view>& repeated = {});
std::optional<std::string> QueryValue(const Call& call, const std::string& name);
// "true" or "false", anything else is an error; false where it is missing.
bool ReadFlag(const Call& call, const std::string& name, api::Errors& errors);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_REPLY_H_
