#include "catalog/fields/list_cell.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

// Reads from the front of a text; each function answers whether it found what it is named after.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) {}

  bool Sign(char sign) {
    SkipBlanks();
    if (at_ >= text_.size() || text_[at_] != sign) return false;
    ++at_;
    return true;
  }

  bool Text(std::string& text) {
    if (!Sign('"')) return false;
    text.clear();
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '"') return true;
      if (c != '\\')
        text += c;
      else if (!Escape(text))
        return false;
    }
    return false;
  }

  // A text, a number, true or false, or null, which leaves none.
  bool Scalar(std::optional<std::string>& value) {
    std::string text;
    if (Text(text)) {
      value = std::move(text);
      return true;
    }
    const std::size_t end = std::min(text_.find_first_of(",]} \t\r\n", at_), text_.size());
    const std::string_view word = text_.substr(at_, end - at_);
    if (word != "null" && word != "true" && word != "false" && !ParseNumber(word)) return false;
    at_ = end;
    if (word != "null") value = std::string(word);
    return true;
  }

  bool End() {
    SkipBlanks();
    return at_ == text_.size();
  }

 private:
  void SkipBlanks() { at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size()); }

  std::optional<std::uint32_t> Hexadecimal() {
    std::uint32_t code = 0;
    for (int i = 0; i < 4; ++i, ++at_) {
      const std::size_t digit = at_ < text_.size()
                                    ? std::string_view("0123456789abcdef").find(Lower(text_[at_]))
                                    : std::string_view::npos;
      if (digit == std::string_view::npos) return std::nullopt;
      code = code << 4 | static_cast<std::uint32_t>(digit);
    }
    return code;
  }

  static char Lower(char c) { return c >= 'A' && c <= 'F' ? static_cast<char>(c - 'A' + 'a') : c; }

  bool Escape(std::string& text) {
    if (at_ >= text_.size()) return false;
    constexpr std::string_view kEscaped = "\"\\/bfnrt", kMeant = "\"\\/\b\f\n\r\t";
    const char c = text_[at_++];
    if (const std::size_t i = kEscaped.find(c); i != std::string_view::npos) {
      text += kMeant[i];
      return true;
    }
    if (c != 'u') return false;
    const auto first = Hexadecimal();
    if (!first || (*first >= 0xDC00 && *first < 0xE000)) return false;
    if (*first < 0xD800 || *first >= 0xE000) {
      AppendUtf8(*first, text);
      return true;
    }
    // Two halves of a character beyond 16 bits.
    if (text_.substr(at_, 2) != "\\u") return false;
    at_ += 2;
    const auto second = Hexadecimal();
    if (!second || *second < 0xDC00 || *second >= 0xE000) return false;
    AppendUtf8(0x10000 + ((*first - 0xD800) << 10) + (*second - 0xDC00), text);
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

// Items between `open` and `close`, with commas between them.
template <class TakeItem>
bool Sequence(Cursor& cursor, char open, char close, const TakeItem& take) {
  if (!cursor.Sign(open)) return false;
  if (cursor.Sign(close)) return true;
  do {
    if (!take()) return false;
  } while (cursor.Sign(','));
  return cursor.Sign(close);
}

bool Object(Cursor& cursor, ListObject& object) {
  return Sequence(cursor, '{', '}', [&] {
    std::string name;
    std::optional<std::string> value;
    if (!cursor.Text(name) || !cursor.Sign(':') || !cursor.Scalar(value)) return false;
    return !value || object.emplace(std::move(name), std::move(*value)).second;  // false: twice
  });
}

}  // namespace

TextList ParseTextList(std::string_view json) {
  TextList list;
  Cursor cursor(json);
  const auto take = [&] { return cursor.Text(list.items.emplace_back()); };
  if (!Sequence(cursor, '[', ']', take) || !cursor.End())
    return {{}, "must be a list of texts like [\"V114\",\"V100\"]"};
  return list;
}

ObjectList ParseObjectList(std::string_view json) {
  ObjectList list;
  Cursor cursor(json);
  const auto take = [&] { return Object(cursor, list.items.emplace_back()); };
  if (!Sequence(cursor, '[', ']', take) || !cursor.End())
    return {{}, "must be a list of objects like [{\"link\":\"https://example.org\"}]"};
  return list;
}

std::string QuoteJson(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '\n')
      quoted += "\\n";
    else if (c == '\r')
      quoted += "\\r";
    else if (c == '\t')
      quoted += "\\t";
    else
      quoted += c;
  }
  return quoted + '"';
}

}  // namespace plenum::catalog
