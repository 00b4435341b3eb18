#include "api/json/words.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "catalog/units/text.h"

namespace plenum::api {
namespace {

bool StartsCharacter(char byte) { return (byte & 0xC0) != 0x80; }

}  // namespace

std::size_t CountCharacters(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), StartsCharacter));
}

std::string Clip(std::string_view text, std::size_t length) {
  if (text.size() <= length) return std::string(text);
  while (length > 0 && !StartsCharacter(text[length])) --length;
  return std::string(text.substr(0, length)) + "…";
}

std::string Quoted(std::string_view text) { return '"' + Clip(text) + '"'; }

std::string Decimal(double value) {
  char digits[40];
  const auto [end, status] = std::to_chars(digits, digits + sizeof digits, value);
  std::string text(digits, end);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  // 1e+06 → 1e6
  std::string sign = text[exponent + 1] == '-' ? "-" : "";
  const auto first = text.find_first_not_of("+-0", exponent + 1);
  return text.substr(0, exponent + 1) + sign + text.substr(first);
}

std::string Significant(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return Decimal(value);
  char text[40];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, value);
  return Decimal(std::strtod(text, nullptr));
}

std::string OneOf(std::span<const std::string> names) {
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) list += i + 1 == names.size() ? " or " : ", ";
    list += names[i];
  }
  return list;
}

std::string EscapePointer(std::string_view step) {
  std::string escaped;
  for (const char c : step) {
    if (c == '~')
      escaped += "~0";
    else if (c == '/')
      escaped += "~1";
    else
      escaped += c;
  }
  return escaped;
}

std::string WithArticle(const std::string& name) {
  const bool vowel =
      !name.empty() && std::string_view("aeiou").find(name[0]) != std::string_view::npos;
  return (vowel ? "an " : "a ") + name;
}

std::string Nearest(std::string_view name, std::span<const std::string> candidates) {
  return std::string(catalog::NearestName(name, {candidates.begin(), candidates.end()}));
}

}  // namespace plenum::api
