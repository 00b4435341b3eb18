#include "catalog/tables/encoding.h"

#include <algorithm>
#include <cstdint>
#include <optional>

#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF", kLittleMark = "\xFF\xFE",
                           kBigMark = "\xFE\xFF";
constexpr std::uint32_t kReplacement = 0xFFFD;

// 0x80 to 0x9F of windows-1252; 0: not assigned.
constexpr std::uint16_t kUpperControls[] = {
    0x20AC, 0,      0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0,      0x017D, 0,      0,      0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0,      0x017E, 0x0178};
// Bytes that are the same letter in windows-1252 and in windows-1250.
constexpr std::string_view kSharedLetters =
    "\xC1\xC2\xC4\xC7\xC9\xCB\xCD\xCE\xD3\xD4\xD6\xDA\xDC\xDD\xDF\xE1\xE2\xE4\xE7\xE9\xEB\xED\xEE"
    "\xF3\xF4\xF6\xFA\xFC\xFD\xD7\xF7";
// ° ± ² ³ µ · and the non-breaking blank: signs where no letter of another encoding can stand.
constexpr std::string_view kSigns = "\xA0\xA7\xB0\xB1\xB2\xB3\xB5\xB7";

std::uint8_t Byte(std::string_view text, std::size_t i) {
  return static_cast<std::uint8_t>(text[i]);
}

bool IsAsciiLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

std::string OfWindows1252(std::string_view bytes) {
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const std::uint8_t byte = Byte(bytes, i);
    const bool upper = byte >= 0x80 && byte < 0xA0;
    const std::uint32_t code = upper ? kUpperControls[byte - 0x80] : byte;
    AppendUtf8(upper && code == 0 ? kReplacement : code, text);
  }
  return text;
}

// None where the bytes are no UTF-16.
std::optional<std::string> OfUtf16(std::string_view bytes, bool big) {
  if (bytes.size() % 2 != 0) return std::nullopt;
  const auto unit = [&](std::size_t i) -> std::uint32_t {
    return Byte(bytes, big ? i : i + 1) << 8 | Byte(bytes, big ? i + 1 : i);
  };
  std::string text;
  text.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); i += 2) {
    std::uint32_t code = unit(i);
    if (code >= 0xDC00 && code < 0xE000) return std::nullopt;
    if (code >= 0xD800 && code < 0xDC00) {
      if (i + 4 > bytes.size()) return std::nullopt;
      const std::uint32_t low = unit(i += 2);
      if (low < 0xDC00 || low >= 0xE000) return std::nullopt;
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
    AppendUtf8(code, text);
  }
  return text;
}

// Where every second byte of most characters is NUL: little or big end first.
std::string_view Utf16WithoutMark(std::string_view bytes) {
  const std::size_t size = std::min<std::size_t>(bytes.size(), 4096) / 2 * 2;
  std::size_t even = 0, odd = 0;
  for (std::size_t i = 0; i < size; ++i)
    if (bytes[i] == '\0') ++(i % 2 == 0 ? even : odd);
  if (bytes.size() % 2 != 0) return "";
  if (odd > size / 4 && even * 16 < odd) return "utf-16le";
  if (even > size / 4 && odd * 16 < even) return "utf-16be";
  return "";
}

// Whether a byte above 127 can only be what windows-1252 makes of it.
bool IsClear(std::string_view bytes, std::size_t i) {
  const auto near_letter = [&](std::size_t at) {
    return at < bytes.size() && (IsAsciiLetter(bytes[at]) || Byte(bytes, at) >= 0xC0);
  };
  const char c = bytes[i];
  const std::uint8_t byte = Byte(bytes, i);
  if (kSharedLetters.find(c) != std::string_view::npos) return true;
  const bool before = i > 0 && near_letter(i - 1), after = near_letter(i + 1);
  if (c == '\xB2' || c == '\xB3')  // m², cm³: behind a letter, never before one
    return !after && i > 0 && (bytes[i - 1] == 'm' || !before);
  if (c == '\xB5' || c == '\xB0') return !before;  // µm, °C
  if (kSigns.find(c) != std::string_view::npos) return !before || !after || c == '\xB7';
  if (c == '\x92') return before && after && byte < 0xA0;  // an apostrophe
  return byte < 0xA0 && kUpperControls[byte - 0x80] != 0 && !before && !after;
}

std::string UnclearPlace(std::string_view bytes, std::size_t at) {
  const auto line_end = [](char c) { return c == '\n' || c == '\r'; };
  std::size_t begin = at, end = at + 1;
  while (begin > 0 && at - begin < 20 && !line_end(bytes[begin - 1])) --begin;
  while (end < bytes.size() && end - at < 20 && !line_end(bytes[end])) ++end;
  constexpr char kHex[] = "0123456789ABCDEF";
  const std::uint8_t byte = Byte(bytes, at);
  return "line " + std::to_string(1 + std::count(bytes.begin(), bytes.begin() + at, '\n')) +
         " has the byte 0x" + kHex[byte >> 4] + kHex[byte & 15] +
         ", which is another letter in another encoding; windows-1252 would read " +
         Shown(OfWindows1252(bytes.substr(begin, end - begin)));
}

Decoded Refused(std::string error) { return {"", "", "", std::move(error)}; }

Decoded As(std::string_view bytes, std::string encoding) {
  if (encoding == "windows-1252") return {OfWindows1252(bytes), std::move(encoding), "", ""};
  if (encoding == "utf-8") {
    if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
    return {std::string(bytes), std::move(encoding), "", ""};
  }
  const bool big = encoding == "utf-16be";
  if (bytes.starts_with(big ? kBigMark : kLittleMark)) bytes.remove_prefix(2);
  auto text = OfUtf16(bytes, big);
  if (!text) return Refused("is not " + encoding + ": it is cut or damaged");
  return {std::move(*text), std::move(encoding), "", ""};
}

bool IsUtf8(std::string_view bytes) {
  std::string printable(bytes);  // control characters are another error, told with its cell
  for (char& c : printable)
    if (static_cast<unsigned char>(c) < 0x20 || c == '\x7F') c = ' ';
  return IsCleanText(printable);
}

Decoded Found(std::string_view bytes) {
  if (bytes.starts_with(kUtf8Mark)) return As(bytes, "utf-8");
  if (bytes.starts_with(kLittleMark)) return As(bytes, "utf-16le");
  if (bytes.starts_with(kBigMark)) return As(bytes, "utf-16be");
  if (const auto utf16 = Utf16WithoutMark(bytes); !utf16.empty())
    return As(bytes, std::string(utf16));
  if (IsUtf8(bytes)) return As(bytes, "utf-8");
  for (std::size_t i = 0; i < bytes.size(); ++i)
    if (Byte(bytes, i) >= 0x80 && !IsClear(bytes, i)) return {"", "", UnclearPlace(bytes, i), ""};
  return As(bytes, "windows-1252");
}

}  // namespace

const std::vector<std::string>& EncodingNames() {
  static const std::vector<std::string> kNames = {"utf-8", "utf-16le", "utf-16be", "windows-1252"};
  return kNames;
}

Decoded Decode(std::string_view bytes, std::string_view given) {
  Decoded decoded = given.empty() ? Found(bytes) : As(bytes, std::string(given));
  // Lines of old Macintosh programs.
  if (decoded.text.find('\n') == std::string::npos)
    std::replace(decoded.text.begin(), decoded.text.end(), '\r', '\n');
  return decoded;
}

}  // namespace plenum::catalog
