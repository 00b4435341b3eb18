#include "api/catalogue/word_index.h"

#include <algorithm>

#include "catalog/units/search_text.h"
#include "catalog/units/text.h"

namespace plenum::api {

WordIndex::Words WordIndex::Enter(std::string_view text) {
  Words words;
  const std::string all = catalog::SearchWords(text);
  if (all.empty()) return words;
  for (const std::string_view word : catalog::Split(all, ' ')) {
    auto found = places_.find(word);
    if (found == places_.end()) {
      const Word& added = words_.emplace_back(Word{std::string(word), {}});
      found = places_.emplace(added.text, static_cast<std::uint32_t>(words_.size() - 1)).first;
    }
    words.push_back(found->second);
  }
  return words;
}

void WordIndex::Add(std::uint32_t row, const Words& words) {
  for (const std::uint32_t place : words) {
    std::vector<std::uint32_t>& rows = words_[place].rows;
    if (rows.empty() || rows.back() != row) rows.push_back(row);
  }
}

void WordIndex::Sort() {
  for (std::uint32_t place = 0; const Word& word : words_) {
    const std::string_view text = word.text;
    beginnings_.emplace_back(text, place);
    for (std::size_t i = 1; i < text.size(); ++i)
      if (catalog::IsSearchSign(text[i - 1])) beginnings_.emplace_back(text.substr(i), place);
    ++place;
  }
  std::sort(beginnings_.begin(), beginnings_.end());
}

void WordIndex::Find(std::string_view beginning, Marks& marks) const {
  auto found = std::lower_bound(
      beginnings_.begin(), beginnings_.end(), beginning,
      [](const auto& known, std::string_view wanted) { return known.first < wanted; });
  for (; found != beginnings_.end() && found->first.starts_with(beginning); ++found)
    for (const std::uint32_t row : words_[found->second].rows) marks[row] = 1;
}

}  // namespace plenum::api
