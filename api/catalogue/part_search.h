// Search for words in all texts of parts.
//
// A part is found if each word of the search stands in one of its texts, at the beginning of a word
// there or after a sign inside one, in any order: "mhe2 m5" finds "MHE2-MS1H-3/2G-M5", and so does
// "ms1h-3/2g"; capitals and accents do not count (catalog/units/search_text.h). Part numbers and
// other names are found without their signs, too: "mhe2ms1h". Texts are id, family, manufacturer,
// part number, series, aliases, the text fields, notes, offers, documents and sources; numbers have
// ranges instead (part_query.h).
//
// The words are kept in memory beside the parts of one revision, not in the database: so a search
// holds for older revisions and while another writes, costs no write anything, and finds the same
// in every kind of store.
#ifndef PLENUM_API_CATALOGUE_PART_SEARCH_H_
#define PLENUM_API_CATALOGUE_PART_SEARCH_H_

#include <cstdint>
#include <string_view>
#include <vector>

#include "api/catalogue/word_index.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// How well a part answers a search.
enum Grade : std::uint8_t {
  kNotFound = 0,
  kFound = 1,
  kFoundByName = 2  // all words stand in maker, series, id, part number and other names
};

class PartSearch {
 public:
  explicit PartSearch(const std::vector<catalog::Part>& parts);
  explicit PartSearch(const std::vector<const catalog::Part*>& parts);

  // A grade for each part. A text without letters and digits finds every part, as kFoundByName.
  std::vector<std::uint8_t> Find(std::string_view text) const;

 private:
  std::size_t parts_;
  WordIndex names_, others_;
  WordIndex squeezed_;  // part numbers and aliases without their blanks and signs
};

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_SEARCH_H_
