#include "catalog/tables/decimal.h"

#include <algorithm>
#include <vector>

#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

bool IsDigit(char c) { return c >= '0' && c <= '9'; }

std::size_t CountDigits(std::string_view text) {
  const auto end = std::find_if_not(text.begin(), text.end(), IsDigit);
  return static_cast<std::size_t>(end - text.begin());
}

std::string_view WithoutBlanks(std::string_view text) {
  for (;;) {
    const std::string_view before = text;
    for (const std::string_view blank : {" ", "\t", "\u00A0", "\u202F"}) {
      if (text.starts_with(blank)) text.remove_prefix(blank.size());
      if (text.ends_with(blank)) text.remove_suffix(blank.size());
    }
    if (text == before) return text;
  }
}

// A mark between thousands that no decimal mark can be, in front of exactly three digits.
std::size_t ThousandsMark(std::string_view text) {
  for (const std::string_view mark : {" ", "\u00A0", "\u202F", "'", "’"})
    if (text.starts_with(mark) && CountDigits(text.substr(mark.size())) == 3) return mark.size();
  return 0;
}

// "1.234.567" and the like: one to three digits, then groups of three.
bool AreThousands(std::string_view text, char mark) {
  const auto groups = Split(text, mark);
  if (groups.front().empty() || groups.front().size() > 3 || groups.front().front() == '0')
    return false;
  return std::all_of(groups.begin() + 1, groups.end(),
                     [](std::string_view group) { return group.size() == 3; });
}

}  // namespace

CellNumber FrontOf(std::string_view cell) {
  CellNumber number;
  std::string_view text = WithoutBlanks(cell);
  for (const std::string_view minus : {"-", "−", "+"}) {
    if (!text.starts_with(minus)) continue;
    number.negative = minus != "+";
    text.remove_prefix(minus.size());
    break;
  }
  while (!text.empty()) {
    if (IsDigit(text[0]) || text[0] == '.' || text[0] == ',') {
      number.digits += text[0];
      text.remove_prefix(1);
    } else if (const std::size_t mark = number.digits.empty() ? 0 : ThousandsMark(text); mark > 0) {
      text.remove_prefix(mark);
    } else {
      break;
    }
  }
  if (CountDigits(number.digits) == 0 &&
      number.digits.find_first_of("0123456789") == std::string::npos) {
    number.digits.clear();
    number.rest = WithoutBlanks(cell);
    return number;
  }
  const bool signed_exponent = text.size() > 2 && (text[1] == '-' || text[1] == '+');
  const std::size_t begin = signed_exponent ? 2 : 1;
  const bool exponent = text.starts_with("e") || text.starts_with("E");
  if (exponent || text.starts_with("/")) {
    const std::size_t size = text.size() > begin ? CountDigits(text.substr(begin)) : 0;
    if (size > 0 && (exponent || !signed_exponent)) {
      number.tail = text.substr(0, begin + size);
      text.remove_prefix(begin + size);
    }
  }
  number.rest = WithoutBlanks(text);
  return number;
}

Evidence EvidenceOf(std::string_view digits) {
  const std::size_t last = digits.find_last_of(".,");
  if (last == std::string_view::npos) return Evidence::kNone;
  const char mark = digits[last], other = mark == '.' ? ',' : '.';
  const Evidence as_decimal = mark == '.' ? Evidence::kPoint : Evidence::kComma;
  const Evidence as_thousands = mark == '.' ? Evidence::kComma : Evidence::kPoint;
  if (last + 1 == digits.size()) return Evidence::kBroken;
  if (digits.find(other) != std::string_view::npos)
    return Split(digits, mark).size() == 2 && AreThousands(digits.substr(0, last), other)
               ? as_decimal
               : Evidence::kBroken;
  if (Split(digits, mark).size() > 2)
    return AreThousands(digits, mark) ? as_thousands : Evidence::kBroken;
  if (!AreThousands(digits, mark)) return as_decimal;
  return mark == '.' ? Evidence::kEitherPoint : Evidence::kEitherComma;
}

std::optional<std::string> WithPoint(std::string_view digits, Decimal decimal) {
  const char mark = decimal == Decimal::kPoint ? '.' : ',', other = mark == '.' ? ',' : '.';
  const auto parts = Split(digits, mark);
  if (parts.size() > 2 || (parts.size() == 2 && parts[1].empty())) return std::nullopt;
  if (parts.size() == 2 && parts[1].find(other) != std::string_view::npos) return std::nullopt;
  const bool grouped = parts[0].find(other) != std::string_view::npos;
  if (grouped && !AreThousands(parts[0], other)) return std::nullopt;
  std::string plain(parts[0]);
  std::erase(plain, other);
  if (parts.size() == 2) plain += "." + std::string(parts[1]);
  return plain;
}

}  // namespace plenum::catalog
