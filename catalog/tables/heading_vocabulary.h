// The words of headings, English and German, and what they stand for.
#ifndef PLENUM_CATALOG_TABLES_HEADING_VOCABULARY_H_
#define PLENUM_CATALOG_TABLES_HEADING_VOCABULARY_H_

#include <span>
#include <string_view>

namespace plenum::catalog {

// A word, as catalog/tables/heading_words.h writes it plainly, and the words of field names that it
// stands for; none: it says nothing.
struct HeadingWord {
  std::string_view word, meaning;
};
struct FamilyWord {
  std::string_view family, word, meaning;
};

std::span<const HeadingWord> HeadingWords();
// Several words with blanks between them, and the word that they stand for.
std::span<const HeadingWord> HeadingIdioms();
// What a word of field names stands for in the tables of one family.
std::span<const FamilyWord> FamilyWords();
// What a word stands for where a unit is beside it, if it names nothing with that unit otherwise.
std::span<const HeadingWord> HeadingWordsWithUnit();

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_HEADING_VOCABULARY_H_
