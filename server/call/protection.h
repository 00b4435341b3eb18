// Who may ask: decided from the headers alone, before anything of a request is looked at.
//
// A page of another site may not act through its user's browser, neither under its own name
// (Origin, Sec-Fetch-Site) nor under one that it had pointed at this machine (DNS rebinding: Host).
// From anywhere but this machine a token is needed.
#ifndef PLENUM_SERVER_CALL_PROTECTION_H_
#define PLENUM_SERVER_CALL_PROTECTION_H_

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "server/call/reply.h"
#include "server/call/tokens.h"

namespace plenum::server {

// What a route asks of its caller: nothing, as it gives away nothing, or a scope.
enum class Access { kOpen, kRead, kWrite };

// Whether only this machine can reach `host`: localhost, ::1 or 127.a.b.c.
bool IsLoopback(const std::string& host);

using Header = std::function<std::optional<std::string>(const char*)>;

// 403 where Host is neither a loopback name nor one of `hosts`, or the request comes from a page of
// another origin: its scheme, name and port are those of the service as the client sees it, https
// only with one of `hosts`. 400 without a Host.
std::optional<Reply> RefuseForeign(const Header& header, const std::vector<std::string>& hosts);

// 415 where a body is not said to be of one of these media types. A page of another site cannot
// send such a type without being asked (CORS), as it could send text or a form.
std::optional<Reply> RefuseContentType(const Header& header,
                                       const std::vector<std::string_view>& types);

// The token that the request carries, or 401 without one that is known, 403 where it may only read.
std::variant<Token, Reply> Authorize(const Header& header, Access access, TokenKeeper& tokens);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_PROTECTION_H_
