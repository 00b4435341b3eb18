// Numbers as the cells of a column write them: which mark stands before decimals.
#ifndef PLENUM_CATALOG_TABLES_DECIMAL_H_
#define PLENUM_CATALOG_TABLES_DECIMAL_H_

#include <optional>
#include <string>
#include <string_view>

namespace plenum::catalog {

enum class Decimal { kPoint, kComma };

// The number at the front of a cell and what is behind it: "1 234,5" and " mL". Blanks and
// apostrophes stand between thousands.
struct CellNumber {
  std::string digits;  // digits with points and commas; empty: the cell starts with no number
  std::string tail;    // an exponent, or "/4" of a fraction
  std::string_view rest;
  bool negative = false;
  bool is_bare() const { return !digits.empty() && rest.empty(); }
};
CellNumber FrontOf(std::string_view cell);

// What the digits say about the mark before decimals.
enum class Evidence {
  kNone,         // no mark: 12
  kPoint,        // 0.35, 1,234.5, 1,234,567
  kComma,        // 0,35, 1.234,5, 1.234.567
  kEitherComma,  // 1,234: thousands or decimals
  kEitherPoint,  // 1.234
  kBroken,       // 1.2.3, 5,
};
Evidence EvidenceOf(std::string_view digits);

// The digits with a point and without thousands; none: not written that way.
std::optional<std::string> WithPoint(std::string_view digits, Decimal decimal);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_DECIMAL_H_
