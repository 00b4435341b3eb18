#include "server/call/protection.h"

#include <arpa/inet.h>

#include <algorithm>
#include <string_view>

namespace plenum::server {
namespace {

std::string LowerCase(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + ('a' - 'A'));
  return text;
}

// The name in "LocalHost:8080" or "[::1]:8080", in lower case; empty where it is none and a port.
std::string NameIn(std::string_view authority) {
  const bool bracketed = authority.starts_with('[');
  const auto end = std::min(authority.find(bracketed ? ']' : ':'), authority.size());
  if (bracketed && end == authority.size()) return "";
  std::string_view port = authority.substr(end + (bracketed ? 1 : 0));
  if (port.starts_with(':')) {
    port.remove_prefix(1);
    if (port.find_first_not_of("0123456789") != std::string_view::npos) return "";
  } else if (!port.empty()) {
    return "";
  }
  const std::size_t begin = bracketed ? 1 : 0;
  return LowerCase(std::string(authority.substr(begin, end - begin)));
}

// The name in an Origin such as "http://localhost:8080"; empty for "null".
std::string NameOfOrigin(std::string_view origin) {
  const auto start = origin.find("://");
  return start == std::string_view::npos ? "" : NameIn(origin.substr(start + 3));
}

bool IsServed(const std::string& name, const std::vector<std::string>& hosts) {
  return IsLoopback(name) || std::any_of(hosts.begin(), hosts.end(), [&](const std::string& host) {
           return LowerCase(host) == name;
         });
}

Reply Unauthorized(const std::string& detail) {
  Reply reply = ProblemReply(401, detail);
  reply.headers.emplace_back("WWW-Authenticate", "Bearer realm=\"plenum\"");
  return reply;
}

}  // namespace

bool IsLoopback(const std::string& host) {
  if (host == "localhost" || host == "::1") return true;
  in_addr address{};
  return inet_pton(AF_INET, host.c_str(), &address) == 1 && ntohl(address.s_addr) >> 24 == 127;
}

std::optional<Reply> RefuseForeign(const Header& header, const std::vector<std::string>& hosts) {
  const auto host = header("Host");
  if (!host) return ProblemReply(400, "a Host header is needed");
  if (!IsServed(NameIn(*host), hosts))
    return ProblemReply(403, "the Host is none that is served here; serve --allow-host adds one");
  const auto origin = header("Origin");
  const bool foreign = origin && !IsServed(NameOfOrigin(*origin), hosts);
  // Following a link to the page is no request of the other site's page.
  const bool embedded =
      header("Sec-Fetch-Site") == "cross-site" && header("Sec-Fetch-Mode") != "navigate";
  if (foreign || embedded)
    return ProblemReply(403, "requests from pages of another site are refused");
  return std::nullopt;
}

std::variant<Token, Reply> Authorize(const Header& header, Access access, TokenKeeper& tokens) {
  constexpr std::string_view kScheme = "Bearer ";
  const auto given = header("Authorization");
  if (!given) return Unauthorized("a token is needed: Authorization: Bearer …");
  const bool bearer = given->starts_with(kScheme);
  const auto token = bearer ? tokens.Find(given->substr(kScheme.size())) : std::nullopt;
  if (!token) return Unauthorized("the token is not known");
  if (access == Access::kWrite && token->scope == Scope::kRead)
    return ProblemReply(403, "this token may read, not write");
  return *token;
}

}  // namespace plenum::server
