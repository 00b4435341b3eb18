// Words for error messages.
#ifndef PLENUM_API_JSON_WORDS_H_
#define PLENUM_API_JSON_WORDS_H_

#include <span>
#include <string>
#include <string_view>

namespace plenum::api {

// At most `length` bytes of a text, cut between characters and marked with "…".
std::string Clip(std::string_view text, std::size_t length = 64);

// Characters of a UTF-8 text.
std::size_t CountCharacters(std::string_view text);

// Clipped and in double quotes.
std::string Quoted(std::string_view text);

// Shortest decimal form that reads back as the same number: 0.05, 1e6, -3.
std::string Decimal(double value);

// A number for a sentence: 1.31, 0.0456, 20400.
std::string Significant(double value, int digits = 3);

// "a, b or c"
std::string OneOf(std::span<const std::string> names);

// "a valve", "an ejector".
std::string WithArticle(const std::string& name);

// `~` and `/` as RFC 6901 wants them in one step of a JSON pointer.
std::string EscapePointer(std::string_view step);

// The name at the smallest edit distance (insert, delete, replace, swap of neighbours), the first
// of equals; empty without candidates.
std::string Nearest(std::string_view name, std::span<const std::string> candidates);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_WORDS_H_
