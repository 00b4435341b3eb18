// The small words of HTTP: tokens, lists, field lines, hosts (RFC 9110, 5.5, 5.6 and 7.2; RFC 9112,
// 5).
#ifndef PLENUM_SERVER_WIRE_GRAMMAR_H_
#define PLENUM_SERVER_WIRE_GRAMMAR_H_

#include <optional>
#include <string_view>
#include <vector>

namespace plenum::server {

inline constexpr std::string_view kLineEnd = "\r\n";

bool EqualsIgnoringCase(std::string_view a, std::string_view b);

// RFC 9110, 5.6.2.
bool IsToken(std::string_view text);

// Control characters of ASCII. A tab is none where it may stand between words.
bool IsControl(char c);
bool HasControl(std::string_view text, std::string_view allowed);

// Without the spaces and tabs around it.
std::string_view Trim(std::string_view text);

// The members of a comma-separated list without empty ones (RFC 9110, 5.6.1.2). Commas in quoted
// strings separate, too: for lists of tokens.
std::vector<std::string_view> Members(std::string_view list);
bool HasMember(std::string_view list, std::string_view token);

// "Name: value"; nothing where a line is none.
struct FieldLine {
  std::string_view name, value;
};
std::optional<FieldLine> ReadFieldLine(std::string_view line);

// Whether a text may stand in Host: a name or an address, and a port or none (RFC 3986, 3.2.2).
bool IsHost(std::string_view text);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_WIRE_GRAMMAR_H_
