#include "catalog/tables/heading_phrases.h"

namespace plenum::catalog {

std::string_view Trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<HeadingPhrase> SplitHeading(std::string_view heading) {
  std::vector<HeadingPhrase> phrases;
  const std::size_t closed = std::string_view("])}").find(heading.back());
  if (closed != std::string_view::npos) {
    const char close = heading.back(), open = std::string_view("[({")[closed];
    int depth = 0;
    for (std::size_t i = heading.size(); i-- > 0;) {
      depth += heading[i] == close ? 1 : heading[i] == open ? -1 : 0;
      if (depth > 0) continue;
      phrases.push_back({Trimmed(heading.substr(0, i)),
                         Trimmed(heading.substr(i + 1, heading.size() - i - 2)), true});
      break;
    }
  }
  for (const std::string_view mark : {" in ", "/", ",", " ", "_"}) {
    const std::size_t at = mark == "/" ? heading.find(mark) : heading.rfind(mark);
    if (at == std::string_view::npos || at == 0) continue;
    phrases.push_back({Trimmed(heading.substr(0, at)), Trimmed(heading.substr(at + mark.size()))});
  }
  return phrases;
}

}  // namespace plenum::catalog
