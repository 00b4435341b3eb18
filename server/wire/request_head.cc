#include "server/wire/request_head.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "server/wire/grammar.h"

namespace plenum::server {
namespace {

constexpr char kNoRequestLine[] = "the request line is not one of HTTP/1.1";

// Known, though no resource may take them all (RFC 9110, 9; RFC 5789). CONNECT is not implemented.
constexpr std::array<std::string_view, 8> kMethods = {"GET",    "HEAD",    "POST",  "PUT",
                                                      "DELETE", "OPTIONS", "PATCH", "TRACE"};

// "%41" as "A"; nothing where a percent sign stands before anything but two digits (RFC 3986, 2.1).
std::optional<std::string> Decode(std::string_view text, bool plus_is_space) {
  std::string decoded;
  decoded.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += plus_is_space && text[i] == '+' ? ' ' : text[i];
      continue;
    }
    unsigned code = 0;
    const std::string_view digits = text.substr(i + 1, 2);
    const auto [end, error] =
        std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (error != std::errc() || digits.size() < 2 || end != digits.data() + 2) return std::nullopt;
    decoded += static_cast<char>(code);
    i += 2;
  }
  return decoded;
}

// "a=1&b=2". A pair that stands twice counts once.
bool ReadQuery(std::string_view text, std::multimap<std::string, std::string>& query) {
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find('&'));
    text.remove_prefix(std::min(pair.size() + 1, text.size()));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    auto name = Decode(pair.substr(0, equals), true);
    auto value = Decode(pair.substr(std::min(equals + 1, pair.size())), true);
    if (!name || !value) return false;
    const auto [begin, end] = query.equal_range(*name);
    const bool known =
        std::any_of(begin, end, [&](const auto& entry) { return entry.second == *value; });
    if (!name->empty() && !known) query.emplace(*std::move(name), *std::move(value));
  }
  return true;
}

// Whether a text begins with the scheme of a URI (RFC 3986, 3.1).
bool HasScheme(std::string_view text) {
  const std::string_view scheme = text.substr(0, text.find(':'));
  const auto is_letter = [](char c) { return (c | 0x20) >= 'a' && (c | 0x20) <= 'z'; };
  return text.find("://") == scheme.size() && !scheme.empty() && is_letter(scheme[0]) &&
         std::all_of(scheme.begin(), scheme.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
         });
}

// RFC 9112, 3.2: origin, absolute and asterisk form; the authority form is that of CONNECT.
bool ReadTarget(std::string_view target, RequestHead& head) {
  std::string rest(target);
  if (target == "*") {
    head.path = rest;
    return head.method == "OPTIONS";
  }
  if (target.find('#') != target.npos || !(target.starts_with('/') || HasScheme(target)))
    return false;
  const std::string_view scheme = target.substr(0, target.find(':'));
  if (!target.starts_with('/') &&
      (EqualsIgnoringCase(scheme, "http") || EqualsIgnoringCase(scheme, "https"))) {
    const std::size_t begin = target.find("//") + 2;
    const std::size_t path = std::min(target.find_first_of("/?", begin), target.size());
    head.authority = target.substr(begin, path - begin);
    if (head.authority->empty()) return false;  // RFC 9110, 4.2.1
    rest = target.substr(path);
    if (!rest.starts_with('/')) rest.insert(0, "/");
  }
  const std::size_t mark = std::min(rest.find('?'), rest.size());
  auto path = Decode(std::string_view(rest).substr(0, mark), false);
  if (!path) return false;
  head.path = *std::move(path);
  return ReadQuery(std::string_view(rest).substr(std::min(mark + 1, rest.size())), head.query);
}

// The status that refuses a version, or none (RFC 9110, 2.5 and 15.6.6).
int ReadVersion(std::string_view version, int& minor) {
  constexpr std::string_view kName = "HTTP/";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  if (version.size() != kName.size() + 3 || !version.starts_with(kName) || version[6] != '.' ||
      !is_digit(version[5]) || !is_digit(version[7]))
    return 400;
  minor = version[7] == '0' ? 0 : 1;
  return version[5] == '1' ? 0 : 505;
}

}  // namespace

std::optional<std::string> RequestHead::Field(std::string_view name) const {
  std::optional<std::string> list;
  for (const auto& [given, value] : fields) {
    if (!EqualsIgnoringCase(given, name)) continue;
    list = list ? *list + ", " + value : value;
  }
  return list;
}

std::variant<RequestHead, Refusal> ReadRequestLine(std::string_view line) {
  const std::size_t first = line.find(' '), last = line.rfind(' ');
  if (first == last || HasControl(line, "") || !IsToken(line.substr(0, first)))
    return Refusal{400, "", kNoRequestLine};
  const std::string_view target = line.substr(first + 1, last - first - 1);
  RequestHead head;
  head.method = line.substr(0, first);
  const int refused = ReadVersion(line.substr(last + 1), head.minor_version);
  if (refused == 400 || target.empty() || target.find(' ') != target.npos)
    return Refusal{400, "", kNoRequestLine};
  if (refused != 0) return Refusal{refused, "", "the version of HTTP is not 1.1 or 1.0"};
  if (std::find(kMethods.begin(), kMethods.end(), head.method) == kMethods.end())
    return Refusal{501, "", "no resource knows the method"};
  if (!ReadTarget(target, head)) return Refusal{400, "", "the target of the request is none"};
  return head;
}

void TakeHostOfTarget(RequestHead& head) {
  if (!head.authority) return;
  const bool given = std::erase_if(head.fields, [](const auto& field) {
                       return EqualsIgnoringCase(field.first, "Host");
                     }) > 0;
  if (given || head.minor_version == 0) head.fields.emplace_back("Host", *head.authority);
}

bool ClosesAfter(const RequestHead& head) {
  const std::string options = head.Field("Connection").value_or("");
  return HasMember(options, "close") ||
         (head.minor_version == 0 && !HasMember(options, "keep-alive"));
}

}  // namespace plenum::server
