#include "api/measure/csv/recording_text.h"

#include <algorithm>
#include <vector>

#include "catalog/tables/decimal.h"
#include "catalog/tables/heading_phrases.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

using catalog::Trimmed;

std::string_view CommentMark(std::string_view line) {
  for (const std::string_view mark : {"#", "%", "//"})
    if (line.starts_with(mark)) return mark;
  return "";
}

bool IsNumber(std::string_view word) { return catalog::FrontOf(word).is_bare(); }

// Pieces with at least `fewest` blanks between them.
std::vector<std::string> Pieces(std::string_view line, std::size_t fewest) {
  std::vector<std::string> pieces;
  while (!(line = Trimmed(line)).empty()) {
    std::size_t end = 0;
    for (std::size_t from = 0;;) {
      end = std::min(line.find_first_of(" \t", from), line.size());
      if (end == line.size()) break;
      const std::size_t next = line.find_first_not_of(" \t", end);
      if (next - end >= fewest && line[next] != '(' && line[next] != '[') break;
      from = next;
    }
    pieces.emplace_back(line.substr(0, end));
    line.remove_prefix(end);
  }
  return pieces;
}

}  // namespace

std::string WithoutComments(std::string_view text) {
  std::string kept;
  kept.reserve(text.size());
  bool at_top = true;
  for (const std::string_view whole : catalog::Split(text, '\n')) {
    std::string_view line = Trimmed(whole);
    const std::string_view mark = CommentMark(line);
    if (mark.empty()) {
      kept += whole;
      at_top = at_top && line.empty();
    } else if (at_top) {
      while (!CommentMark(line).empty()) line = Trimmed(line.substr(CommentMark(line).size()));
      kept += line;
    }
    kept += '\n';
  }
  return kept;
}

std::string WithTabs(std::string_view text) {
  std::string table;
  table.reserve(text.size());
  for (const std::string_view line : catalog::Split(text, '\n')) {
    const auto words = Pieces(line, 1);
    const bool has_numbers = std::any_of(words.begin(), words.end(),
                                         [](const std::string& word) { return IsNumber(word); });
    const auto wide = has_numbers ? words : Pieces(line, 2);
    const auto& pieces = wide.size() > 1 ? wide : words;
    for (std::size_t i = 0; i < pieces.size(); ++i) table += (i > 0 ? "\t" : "") + pieces[i];
    table += '\n';
  }
  return table;
}

}  // namespace plenum::api
