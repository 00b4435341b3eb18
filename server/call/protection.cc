#include "server/call/protection.h"

#include <arpa/inet.h>

#include <algorithm>
#include <string_view>

#include "server/call/lower_case.h"

namespace plenum::server {
namespace {

// The name and the port of "LocalHost:8080" or "[::1]:8080", the name in lower case; no name where
// it is none.
struct Authority {
  std::string name, port;
};

Authority AuthorityIn(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  const auto end = std::min(text.find(bracketed ? ']' : ':'), text.size());
  if (bracketed && end == text.size()) return {};
  std::string_view port = text.substr(end + (bracketed ? 1 : 0));
  if (port.starts_with(':')) {
    port.remove_prefix(1);
    if (port.find_first_not_of("0123456789") != std::string_view::npos) return {};
  } else if (!port.empty()) {
    return {};
  }
  const std::size_t begin = bracketed ? 1 : 0;
  return {LowerCase(std::string(text.substr(begin, end - begin))), std::string(port)};
}

bool IsNamed(const std::string& name, const std::vector<std::string>& hosts) {
  return std::any_of(hosts.begin(), hosts.end(),
                     [&](const std::string& host) { return LowerCase(host) == name; });
}

bool IsServed(const std::string& name, const std::vector<std::string>& hosts) {
  return IsLoopback(name) || IsNamed(name, hosts);
}

// Whether a page of that Origin is one of the service's own, asked for under that Host.
bool IsOwnPage(std::string_view origin, const Authority& host,
               const std::vector<std::string>& hosts) {
  const auto start = origin.find("://");
  if (start == std::string_view::npos) return false;
  const std::string scheme = LowerCase(std::string(origin.substr(0, start)));
  const bool secure = scheme == "https" && IsNamed(host.name, hosts);
  if (scheme != "http" && !secure) return false;
  const Authority page = AuthorityIn(origin.substr(start + 3));
  const auto port = [&](const Authority& authority) {
    return authority.port.empty() ? secure ? "443" : "80" : authority.port;
  };
  return page.name == host.name && port(page) == port(host);
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
  const Authority authority = AuthorityIn(*host);
  if (!IsServed(authority.name, hosts))
    return ProblemReply(403, "the Host is none that is served here; serve --allow-host adds one");
  const auto origin = header("Origin");
  const bool foreign = origin && !IsOwnPage(*origin, authority, hosts);
  // Following a link to the page is no request of the other site's page.
  const std::string from = header("Sec-Fetch-Site").value_or("");
  const bool embedded =
      (from == "cross-site" || from == "same-site") && header("Sec-Fetch-Mode") != "navigate";
  if (foreign || embedded)
    return ProblemReply(403, "requests from pages of another site or port are refused");
  return std::nullopt;
}

std::optional<Reply> RefuseContentType(const Header& header,
                                       const std::vector<std::string_view>& types) {
  const std::string given = header("Content-Type").value_or("");
  std::string type = LowerCase(given.substr(0, given.find(';')));
  type.erase(
      std::find_if(type.rbegin(), type.rend(), [](char c) { return c != ' ' && c != '\t'; }).base(),
      type.end());
  std::string known;
  for (const auto one : types) {
    if (type == one) return std::nullopt;
    known += (known.empty() ? "" : ", ") + std::string(one);
  }
  return ProblemReply(415, "the body needs its Content-Type, here " + known);
}

std::variant<Token, Reply> Authorize(const Header& header, Access access, TokenKeeper& tokens) {
  constexpr std::string_view kScheme = "bearer ";
  const auto given = header("Authorization");
  if (!given) return Unauthorized("a token is needed: Authorization: Bearer …");
  const bool bearer = LowerCase(given->substr(0, kScheme.size())) == kScheme;
  const auto text = std::min(given->find_first_not_of(' ', kScheme.size()), given->size());
  const auto token = bearer ? tokens.Find(given->substr(text)) : std::nullopt;
  if (!token) return Unauthorized("the token is not known");
  if (access == Access::kWrite && token->scope == Scope::kRead)
    return ProblemReply(403, "this token may read, not write");
  return *token;
}

}  // namespace plenum::server
