// What stands before the body of a request: its line and its fields (RFC 9112, 3 and 5).
#ifndef PLENUM_SERVER_WIRE_REQUEST_HEAD_H_
#define PLENUM_SERVER_WIRE_REQUEST_HEAD_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "server/wire/refusal.h"

namespace plenum::server {

struct RequestHead {
  std::string method;
  std::string path;  // decoded; "*" where the whole service is meant
  std::multimap<std::string, std::string> query;
  int minor_version = 1;                                    // of HTTP/1; higher ones count as 1
  std::optional<std::string> authority;                     // of a target in absolute form
  std::vector<std::pair<std::string, std::string>> fields;  // in their order

  // The values of all lines of a field, as one list (RFC 9110, 5.3); nothing where there is none.
  std::optional<std::string> Field(std::string_view name) const;
};

// "GET /v1/parts?q=a HTTP/1.1".
std::variant<RequestHead, Refusal> ReadRequestLine(std::string_view line);

// A target in absolute form gives the Host, whatever the field says (RFC 9112, 3.2.2). It does not
// replace a field that is missing where there must be one.
void TakeHostOfTarget(RequestHead& head);

// Whether the connection ends after the answer (RFC 9112, 9.3).
bool ClosesAfter(const RequestHead& head);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_REQUEST_HEAD_H_
