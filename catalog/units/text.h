// Small helpers on text that validation and CSV share.
#ifndef PLENUM_CATALOG_UNITS_TEXT_H_
#define PLENUM_CATALOG_UNITS_TEXT_H_

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace plenum::catalog {

// Shortest decimal that reads back as the same double.
std::string FormatNumber(double value);

// A whole decimal number with nothing after it, blanks around it aside; none also where it does not
// fit a finite double.
std::optional<double> ParseNumber(std::string_view text);

// In double quotes for a message; what is long is cut between characters and marked with "…".
std::string Shown(std::string_view text);

// The pieces between separators, empty ones too; of an empty text one empty piece.
std::vector<std::string_view> Split(std::string_view text, char separator);

// Writes a code point, at most 0x10FFFF, as UTF-8.
void AppendUtf8(std::uint32_t code, std::string& text);

// Well-formed UTF-8 without control characters but tab, line feed and carriage return.
bool IsCleanText(std::string_view text);

// Number of characters of well-formed UTF-8.
std::size_t CountCharacters(std::string_view text);

// Inserted, deleted and replaced bytes and swapped neighbours; `most`, or more, where that is not
// less.
std::size_t EditDistance(std::string_view a, std::string_view b, std::size_t most);

// The name at the smallest edit distance (insert, delete, replace, swap of neighbours) from the
// first 64 bytes, the first of equals; empty if there is none. Where that is more than a third of
// it and the name is a word of others ("volume" of rest_volume_ml), the shortest of these.
std::string_view NearestName(std::string_view name, const std::vector<std::string_view>& known);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_UNITS_TEXT_H_
