#include "server/call/reply.h"

#include <algorithm>

#include "api/json/problem_document.h"

namespace plenum::server {

std::string Dump(const api::Json& json, int indent) {
  return json.dump(indent, ' ', false, api::Json::error_handler_t::replace);
}

std::size_t Reply::body_size() const {
  std::size_t size = body.size();
  for (const Bytes& piece : tail) size += piece->size();
  return size;
}

Reply Shared(Reply reply) {
  reply.tail.insert(reply.tail.begin(),
                    std::make_shared<const std::string>(std::exchange(reply.body, {})));
  return reply;
}

Reply JsonReply(int status, const api::Json& json) {
  return {status, "application/json", Dump(json) + "\n", {}, {}};
}

Reply ProblemReply(int status, const api::Errors& errors) {
  return {status,
          "application/problem+json",
          Dump(api::ProblemDocument(status, errors)) + "\n",
          {},
          {}};
}

Reply ProblemReply(int status, const std::string& detail) {
  return {status,
          "application/problem+json",
          Dump(api::ProblemDocument(status, detail)) + "\n",
          {},
          {}};
}

api::Errors CheckQuery(const Call& call, const std::vector<std::string_view>& known,
                       const std::vector<std::string_view>& repeated) {
  std::string list;
  for (const auto* names : {&known, &repeated})
    for (const auto name : *names) list += (list.empty() ? "" : ", ") + std::string(name);
  api::Errors errors;
  for (auto it = call.query.begin(); it != call.query.end();
       it = call.query.upper_bound(it->first)) {
    if (std::find(repeated.begin(), repeated.end(), it->first) != repeated.end()) continue;
    if (std::find(known.begin(), known.end(), it->first) == known.end()) {
      errors.push_back({"/" + it->first, "unknown query parameter; known are: " +
                                             (list.empty() ? std::string("none") : list)});
    } else if (call.query.count(it->first) > 1) {
      errors.push_back({"/" + it->first, "query parameter given more than once"});
    }
  }
  return errors;
}

std::optional<std::string> QueryValue(const Call& call, const std::string& name) {
  const auto it = call.query.find(name);
  if (it == call.query.end()) return std::nullopt;
  return it->second;
}

bool ReadFlag(const Call& call, const std::string& name, api::Errors& errors) {
  const std::string text = QueryValue(call, name).value_or("false");
  if (text != "true" && text != "false")
    errors.push_back({"/" + name, "must be true or false, not \"" + text + "\""});
  return text == "true";
}

}  // namespace plenum::server
