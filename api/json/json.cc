#include "api/json/json.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "api/json/request_limits.h"
#include "api/json/words.h"

namespace plenum::api {
namespace {

// A name in an object and in the set of names that finds duplicates: two texts and a node of a
// tree.
constexpr std::size_t kKeyBytes = 2 * sizeof(std::string) + 40;

// Builds the document from the parser's events. Works by events rather than through the library's
// own tree so that depth, duplicate keys and the digits of a number are seen as they are read.
class TreeBuilder : public nlohmann::json_sax<Json> {
 public:
  explicit TreeBuilder(std::size_t bytes_max) : bytes_max_(bytes_max) {}

  bool null() override { return Put(nullptr); }
  bool boolean(bool value) override { return Put(value); }
  bool number_integer(number_integer_t value) override { return Put(value); }
  bool number_unsigned(number_unsigned_t value) override { return Put(value); }
  bool number_float(number_float_t value, const string_t& digits) override {
    // Also an integer past 64 bits: other programs write 3.07e20 as 307000000000000000000.
    if (!std::isfinite(value)) return Fail("number " + Clip(digits) + " is not finite");
    return Put(value);
  }
  bool string(string_t& value) override {
    bytes_ += sizeof(string_t) + value.size();
    return Put(std::move(value));
  }
  bool binary(binary_t&) override { return Fail("binary data is not JSON"); }

  bool start_object(std::size_t) override { return Open(Json::object()); }
  bool key(string_t& name) override {
    bytes_ += kKeyBytes + 2 * name.size();  // of the member and of the set of names
    levels_.back().key = name;
    if (levels_.back().keys.insert(name).second) return true;
    return Fail("field " + Quoted(name) + " appears twice");
  }
  bool end_object() override { return Close(); }
  bool start_array(std::size_t) override { return Open(Json::array()); }
  bool end_array() override { return Close(); }

  bool parse_error(std::size_t position, const std::string&,
                   const nlohmann::json::exception& error) override {
    position_ = position;
    error_ = Error{"", "not JSON: " + Reason(error.what())};
    return false;
  }

  Json Take() { return std::move(root_); }
  const std::optional<Error>& error() const { return error_; }
  std::optional<std::size_t> position() const { return position_; }

 private:
  struct Level {
    Json value;
    std::string key;  // of the object's member that is being read
    std::set<std::string> keys;
  };

  bool Put(Json value) {
    bytes_ += sizeof(Json);
    if (bytes_ > bytes_max_)
      return Fail("the document takes more than " + std::to_string(bytes_max_) +
                  " bytes of memory (json_memory_bytes_max)");
    if (levels_.empty()) {
      root_ = std::move(value);
    } else if (Level& level = levels_.back(); level.value.is_array()) {
      level.value.push_back(std::move(value));
    } else {
      // Not operator[]: it searches, and the key is known to be new.
      level.value.get_ref<Json::object_t&>().Container::emplace_back(level.key, std::move(value));
    }
    return true;
  }
  bool Open(Json value) {
    if (levels_.size() >= kJsonDepthMax)
      return Fail("nested deeper than " + std::to_string(kJsonDepthMax) +
                  " levels (json_depth_max)");
    bytes_ += sizeof(Json) + sizeof(std::vector<Json>);  // and what the heap adds
    levels_.push_back({std::move(value), {}, {}});
    return true;
  }
  bool Close() {
    Json value = std::move(levels_.back().value);
    levels_.pop_back();
    return Put(std::move(value));
  }
  bool Fail(std::string detail) {
    error_ = Error{Pointer(), std::move(detail)};
    return false;
  }
  std::string Pointer() const {
    std::string pointer;
    for (const Level& level : levels_)
      pointer += "/" + (level.value.is_array() ? std::to_string(level.value.size())
                                               : EscapePointer(level.key));
    return pointer;
  }

  // The library's message without its own numbering, place and echo of raw bytes.
  static std::string Reason(std::string_view what) {
    if (const auto place = what.find(", column "); place != std::string_view::npos)
      what.remove_prefix(std::min(what.size(), what.find(": ", place) + 2));
    else if (const auto id = what.find("] "); id != std::string_view::npos)
      what.remove_prefix(id + 2);
    if (const auto echo = what.find("; last read"); echo != std::string_view::npos)
      what = what.substr(0, echo);
    std::string reason(what);
    std::replace_if(
        reason.begin(), reason.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return Clip(reason, 160);
  }

  Json root_;
  std::vector<Level> levels_;
  std::optional<Error> error_;
  std::optional<std::size_t> position_;
  const std::size_t bytes_max_;
  std::size_t bytes_ = 0;
};

std::string Place(std::string_view text, std::size_t position) {
  const std::string_view before = text.substr(0, std::min(position, text.size()));
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const auto last = before.rfind('\n');
  const std::size_t column = last == std::string_view::npos ? position : position - last - 1;
  return "line " + std::to_string(line) + ", column " + std::to_string(column);
}

}  // namespace

Parsed<Json> ParseJson(std::string_view text) { return ParseJson(text, kJsonBytesMax); }

Parsed<Json> ParseJson(std::string_view text, std::size_t bytes_max) {
  // The library takes a NUL for the end of the text and ignores what follows.
  if (const auto nul = text.find('\0'); nul != std::string_view::npos)
    return Errors{{"", "not JSON: byte 0 at " + Place(text, nul + 1)}};
  TreeBuilder builder(bytes_max);
  if (Json::sax_parse(text.begin(), text.end(), &builder)) return builder.Take();
  Error error = builder.error().value_or(Error{"", "not JSON"});
  if (builder.position()) error.detail += " at " + Place(text, *builder.position());
  return Errors{std::move(error)};
}

double Rounded(double value) {
  if (!std::isfinite(value)) return value;
  char digits[40];
  const auto [end, status] =
      std::to_chars(digits, digits + sizeof digits, value, std::chars_format::scientific, 11);
  double rounded = 0.0;
  std::from_chars(digits, end, rounded);
  return rounded == 0.0 ? 0.0 : rounded;
}

Json Number(double value) {
  if (!std::isfinite(value)) return nullptr;
  return Rounded(value);
}

}  // namespace plenum::api
