#include "api/json/words.h"

#include <algorithm>
#include <charconv>
#include <vector>

namespace plenum::api {
namespace {

std::size_t EditDistance(std::string_view a, std::string_view b) {
  // Rows of the optimal string alignment table: two back, one back, current.
  std::vector<std::size_t> older(b.size() + 1), old(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    older.swap(old);
    old.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({old[j] + 1, row[j - 1] + 1, old[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], older[j - 2] + 1);
    }
  }
  return row[b.size()];
}

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

std::string Nearest(std::string_view name, std::span<const std::string> candidates) {
  name = name.substr(0, 64);
  std::string nearest;
  std::size_t least = std::string::npos;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = EditDistance(name, candidate);
    if (distance < least) {
      least = distance;
      nearest = candidate;
    }
  }
  return nearest;
}

}  // namespace plenum::api
