// JSON text to values and back, with the guards that nlohmann-json leaves to its user.
#ifndef PLENUM_API_JSON_JSON_H_
#define PLENUM_API_JSON_JSON_H_

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace plenum::api {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Json = nlohmann::ordered_json;

// One thing wrong with a request: where (JSON pointer, "" for the whole document) and what, naming
// the value and the allowed range or the nearest known field.
struct Error {
  std::string pointer;
  std::string detail;
  bool operator==(const Error&) const = default;
};
using Errors = std::vector<Error>;

// Either a value or everything that is wrong with the input.
template <typename T>
using Parsed = std::variant<T, Errors>;

// Strict parse: depth ≤ 64, no duplicate keys, no bytes after the document (NUL included), numbers
// finite; an integer past 64 bits is the nearest double. NaN and Infinity are not JSON and are
// refused, and so is what takes more than `bytes_max` of memory; kJsonBytesMax (request_limits.h)
// without it.
Parsed<Json> ParseJson(std::string_view text);
Parsed<Json> ParseJson(std::string_view text, std::size_t bytes_max);

// To 12 significant digits, so that unit conversion leaves no noise; no minus zero.
double Rounded(double value);
// Rounded; not finite → null.
Json Number(double value);

}  // namespace plenum::api

#endif  // PLENUM_API_JSON_JSON_H_
