// Texts as search compares them.
#ifndef PLENUM_CATALOG_UNITS_SEARCH_TEXT_H_
#define PLENUM_CATALOG_UNITS_SEARCH_TEXT_H_

#include <string>
#include <string_view>

namespace plenum::catalog {

// Words with one blank between them: lower case, Latin letters without accents ("Ü" as "u", "ß" as
// "ss"), raised and lowered digits as digits; letters of other alphabets as they are. A run of
// signs inside a word is its first one: "." for a point or a comma, "/" for a slash, "-" for any
// other; signs around a word are none of it. "MHE2-MS1H-3/2G (0,5 l)" becomes "mhe2-ms1h-3/2g 0.5
// l". Bytes that are no UTF-8 count as letters.
std::string SearchWords(std::string_view text);

// Whether a byte of SearchWords is a sign inside a word.
constexpr bool IsSearchSign(char byte) { return byte == '.' || byte == '/' || byte == '-'; }

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_UNITS_SEARCH_TEXT_H_
