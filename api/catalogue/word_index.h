// Which of many texts hold a word, or one that begins so.
#ifndef PLENUM_API_CATALOGUE_WORD_INDEX_H_
#define PLENUM_API_CATALOGUE_WORD_INDEX_H_

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace plenum::api {

// A bit for each row: set where the row was found.
using Marks = std::vector<std::uint8_t>;

// Words are as catalog/units/search_text.h makes them.
class WordIndex {
 public:
  // Words of a text that many rows hold are looked up once.
  using Words = std::vector<std::uint32_t>;
  Words Enter(std::string_view text);
  // Rows in rising order.
  void Add(std::uint32_t row, const Words& words);
  // After the last Enter.
  void Sort();
  // Marks each row that holds `beginning` at the beginning of a word or after a sign inside one.
  void Find(std::string_view beginning, Marks& marks) const;

 private:
  struct Word {
    std::string text;
    std::vector<std::uint32_t> rows;
  };
  std::deque<Word> words_;                                              // which stay where they are
  std::unordered_map<std::string_view, std::uint32_t> places_;          // in words_
  std::vector<std::pair<std::string_view, std::uint32_t>> beginnings_;  // in order
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_WORD_INDEX_H_
