// A heading as words and the unit behind them: where a unit may stand.
#ifndef PLENUM_CATALOG_TABLES_HEADING_PHRASES_H_
#define PLENUM_CATALOG_TABLES_HEADING_PHRASES_H_

#include <string_view>
#include <vector>

namespace plenum::catalog {

// Without the blanks around it.
std::string_view Trimmed(std::string_view text);

struct HeadingPhrase {
  std::string_view words, unit;
  bool in_brackets = false;
};

// The ways to read a heading, which is not empty, the likeliest first: a unit in brackets at the
// end, or behind "in", "/", ",", a blank or "_".
std::vector<HeadingPhrase> SplitHeading(std::string_view heading);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_HEADING_PHRASES_H_
