#include "server/wire/grammar.h"

#include <algorithm>

namespace plenum::server {
namespace {

constexpr std::string_view kDigits = "0123456789";

bool IsLetterOrDigit(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
}

// Letters, digits and `marks`.
bool ConsistsOf(std::string_view text, std::string_view marks) {
  return std::all_of(text.begin(), text.end(), [&](char c) {
    return IsLetterOrDigit(c) || marks.find(c) != std::string_view::npos;
  });
}

}  // namespace

bool EqualsIgnoringCase(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

bool IsToken(std::string_view text) { return !text.empty() && ConsistsOf(text, "!#$%&'*+-.^_`|~"); }

bool IsControl(char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; }

bool HasControl(std::string_view text, std::string_view allowed) {
  return std::any_of(text.begin(), text.end(), [&](char c) {
    return IsControl(c) && allowed.find(c) == std::string_view::npos;
  });
}

std::string_view Trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> Members(std::string_view list) {
  std::vector<std::string_view> members;
  while (!list.empty()) {
    const std::size_t comma = std::min(list.find(','), list.size());
    if (const auto member = Trim(list.substr(0, comma)); !member.empty()) members.push_back(member);
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return members;
}

bool HasMember(std::string_view list, std::string_view token) {
  const auto members = Members(list);
  return std::any_of(members.begin(), members.end(),
                     [&](std::string_view member) { return EqualsIgnoringCase(member, token); });
}

std::optional<FieldLine> ReadFieldLine(std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos || !IsToken(line.substr(0, colon)) || HasControl(line, "\t"))
    return std::nullopt;
  return FieldLine{line.substr(0, colon), Trim(line.substr(colon + 1))};
}

bool IsHost(std::string_view text) {
  const bool bracketed = text.starts_with('[');
  const auto end = std::min(text.find(bracketed ? ']' : ':'), text.size());
  if (bracketed && end == text.size()) return false;
  const std::string_view name = text.substr(bracketed ? 1 : 0, end - (bracketed ? 1 : 0));
  std::string_view port = text.substr(std::min(end + (bracketed ? 1 : 0), text.size()));
  if (!port.empty() && !port.starts_with(':')) return false;
  port.remove_prefix(port.empty() ? 0 : 1);
  return ConsistsOf(name, bracketed ? "-._~!$&'()*+,;=:" : "-._~!$&'()*+,;=%") &&
         port.find_first_not_of(kDigits) == std::string_view::npos;
}

}  // namespace plenum::server
