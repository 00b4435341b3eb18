#include "catalog/units/search_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace plenum::catalog {
namespace {

// What code points beyond ASCII become, in order.
struct Range {
  std::uint32_t first, last;
  std::string_view as;
};
constexpr Range kRanges[] = {
    {0x80, 0xA0, " "},     {0xA1, 0xB1, "-"},     {0xB2, 0xB2, "2"},     {0xB3, 0xB3, "3"},
    {0xB4, 0xB4, "-"},     {0xB5, 0xB5, "u"},     {0xB6, 0xB8, "-"},     {0xB9, 0xB9, "1"},
    {0xBA, 0xBF, "-"},     {0xC0, 0xC5, "a"},     {0xC6, 0xC6, "ae"},    {0xC7, 0xC7, "c"},
    {0xC8, 0xCB, "e"},     {0xCC, 0xCF, "i"},     {0xD0, 0xD0, "d"},     {0xD1, 0xD1, "n"},
    {0xD2, 0xD6, "o"},     {0xD7, 0xD7, "-"},     {0xD8, 0xD8, "o"},     {0xD9, 0xDC, "u"},
    {0xDD, 0xDD, "y"},     {0xDE, 0xDE, "th"},    {0xDF, 0xDF, "ss"},    {0xE0, 0xE5, "a"},
    {0xE6, 0xE6, "ae"},    {0xE7, 0xE7, "c"},     {0xE8, 0xEB, "e"},     {0xEC, 0xEF, "i"},
    {0xF0, 0xF0, "d"},     {0xF1, 0xF1, "n"},     {0xF2, 0xF6, "o"},     {0xF7, 0xF7, "-"},
    {0xF8, 0xF8, "o"},     {0xF9, 0xFC, "u"},     {0xFD, 0xFD, "y"},     {0xFE, 0xFE, "th"},
    {0xFF, 0xFF, "y"},     {0x100, 0x105, "a"},   {0x106, 0x10D, "c"},   {0x10E, 0x111, "d"},
    {0x112, 0x11B, "e"},   {0x11C, 0x123, "g"},   {0x124, 0x127, "h"},   {0x128, 0x131, "i"},
    {0x132, 0x133, "ij"},  {0x134, 0x135, "j"},   {0x136, 0x138, "k"},   {0x139, 0x142, "l"},
    {0x143, 0x14B, "n"},   {0x14C, 0x151, "o"},   {0x152, 0x153, "oe"},  {0x154, 0x159, "r"},
    {0x15A, 0x161, "s"},   {0x162, 0x167, "t"},   {0x168, 0x173, "u"},   {0x174, 0x175, "w"},
    {0x176, 0x178, "y"},   {0x179, 0x17E, "z"},   {0x17F, 0x17F, "s"},   {0x300, 0x36F, ""},
    {0x3BC, 0x3BC, "u"},   {0x2000, 0x200B, " "}, {0x2010, 0x2027, "-"}, {0x2028, 0x202F, " "},
    {0x2030, 0x205E, "-"}, {0x205F, 0x2060, " "}, {0x2070, 0x2070, "0"}, {0x2074, 0x2074, "4"},
    {0x2075, 0x2075, "5"}, {0x2076, 0x2076, "6"}, {0x2077, 0x2077, "7"}, {0x2078, 0x2078, "8"},
    {0x2079, 0x2079, "9"}, {0x2080, 0x2080, "0"}, {0x2081, 0x2081, "1"}, {0x2082, 0x2082, "2"},
    {0x2083, 0x2083, "3"}, {0x2084, 0x2084, "4"}, {0x2085, 0x2085, "5"}, {0x2086, 0x2086, "6"},
    {0x2087, 0x2087, "7"}, {0x2088, 0x2088, "8"}, {0x2089, 0x2089, "9"}, {0x2190, 0x22FF, "-"},
    {0x3000, 0x3000, " "}, {0xFEFF, 0xFEFF, ""}};

constexpr std::string_view kAscii =
    "                                 -----------.-./0123456789------"
    "-abcdefghijklmnopqrstuvwxyz-/----abcdefghijklmnopqrstuvwxyz---- ";

struct Character {
  std::size_t bytes;
  std::uint32_t code;  // 0 for what is no UTF-8
};

Character FirstOf(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const std::size_t bytes = byte(0) < 0xC2 ? 1 : byte(0) < 0xE0 ? 2 : byte(0) < 0xF0 ? 3 : 4;
  if (bytes == 1 || byte(0) > 0xF4 || text.size() < bytes) return {1, 0};
  std::uint32_t code = byte(0) & (0xFF >> (bytes + 1));
  for (std::size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {1, 0};
    code = code << 6 | (byte(i) & 0x3F);
  }
  return {bytes, code};
}

// What the first character of `text` becomes; takes it away.
std::string_view TakeFirst(std::string_view& text) {
  const std::string_view all = text;
  if (const auto byte = static_cast<unsigned char>(text[0]); byte < 0x80) {
    text.remove_prefix(1);
    return kAscii.substr(byte, 1);
  }
  const Character character = FirstOf(text);
  text.remove_prefix(character.bytes);
  const Range* range =
      std::lower_bound(std::begin(kRanges), std::end(kRanges), character.code,
                       [](const Range& known, std::uint32_t code) { return known.last < code; });
  const bool known =
      character.code > 0 && range != std::end(kRanges) && range->first <= character.code;
  return known ? range->as : all.substr(0, character.bytes);
}

}  // namespace

std::string SearchWords(std::string_view text) {
  static_assert(kAscii.size() == 128);
  std::string words;
  char between = '\0';  // a blank or sign before the next letter
  while (!text.empty()) {
    const std::string_view next = TakeFirst(text);
    if (next.empty()) continue;
    if (next[0] == ' ' || IsSearchSign(next[0])) {
      if (between == '\0' || next[0] == ' ') between = next[0];
      continue;
    }
    if (between != '\0' && !words.empty()) words += between;
    between = '\0';
    words += next;
  }
  return words;
}

}  // namespace plenum::catalog
