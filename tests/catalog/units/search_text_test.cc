#include "catalog/units/search_text.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace plenum::catalog {
namespace search_text_test {

TEST(SearchWords, AreLowerCaseWithoutAccentsAndOuterSigns) {
  const std::pair<const char*, const char*> cases[] = {
      {"MHE2-MS1H-3/2G (0,5 l)", "mhe2-ms1h-3/2g 0.5 l"},
      {"  Festo\tSE & Co.\nKG ", "festo se co kg"},
      {"Größe Ø4 ÅÉÎÕÜ ŁÓDŹ", "grosse o4 aeiou lodz"},
      {"Gro\xCC\x88\xC3\x9F"
       "e",
       "grosse"},  // the accent as a character of its own
      {"CO₂ 5 mm² 10³ µm μm", "co2 5 mm2 103 um um"},
      {"https://a.example/b_c?d=1", "https-a.example/b-c-d-1"},
      {"10\xC2\xA0kPa 3\xE2\x80\x93"
       "5",
       "10 kpa 3-5"},
      {"漢字 ПНЕВМО", "漢字 ПНЕВМО"},
      {"\"*()' -- \\", ""},
      {"a\\b", "a/b"},
      {"", ""},
      {"\xFF\xC3", "\xFF\xC3"}};
  for (const auto& [text, words] : cases) EXPECT_EQ(SearchWords(text), words) << text;
}

TEST(SearchWords, OfAnyBytesAreTheirOwnWords) {
  std::mt19937 random(7);
  for (int i = 0; i < 20'000; ++i) {
    std::string text;
    for (std::size_t n = random() % 12; n > 0; --n)
      text += static_cast<char>(random() % 3 == 0 ? random() : 32 + random() % 95);
    const std::string words = SearchWords(text);
    ASSERT_EQ(SearchWords(words), words) << text;
    ASSERT_EQ(words.find("  "), std::string::npos);
    if (words.empty()) continue;
    for (const char end : {words.front(), words.back()})
      ASSERT_FALSE(end == ' ' || IsSearchSign(end)) << text;
  }
}

}  // namespace search_text_test
}  // namespace plenum::catalog
