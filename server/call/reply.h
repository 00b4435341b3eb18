// What a route gets and gives, free of any HTTP library.
#ifndef PLENUM_SERVER_CALL_REPLY_H_
#define PLENUM_SERVER_CALL_REPLY_H_

#include <functional>
#include <map>
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
  std::string user = {};  // the name of the caller's token; empty where none was needed
};

using Write = std::function<bool(std::string_view)>;  // false: the client is gone

struct Reply {
  int status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  // Set for an event stream: called again and again until it gives false.
  std::function<bool(const Write&)> stream;
};

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
