#include "api/catalogue/part_search.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <random>
#include <sstream>

#include "catalog/fields/fields.h"
#include "tests/catalog/samples.h"

namespace plenum::api {
namespace part_search_test {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

// Ids of those that a search finds.
std::vector<std::string> Found(const std::vector<catalog::Part>& parts, std::string_view text,
                               std::uint8_t at_least = kFound) {
  const auto grades = PartSearch(parts).Find(text);
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (grades[i] >= at_least) ids.push_back(parts[i].id);
  return ids;
}

std::vector<catalog::Part> Bench() {
  auto fast = catalog::Reservoir("a"), other = catalog::Reservoir("b"),
       third = catalog::Reservoir("c");
  fast.manufacturer = "Festo";
  fast.part_number = "MHE2-MS1H-3/2G-M7";
  fast.notes = "Fast switching; für 24 V (0,5 W)";
  other.manufacturer = "SMC";
  other.part_number = "VQ110";
  other.aliases = {"VQ-110/5L"};
  other.notes = "Replaces a Festo valve, 32 mm";
  third.manufacturer = "Müller";
  third.part_number = "3.2 x";
  third.texts["port"] = {"M5", {}, "page 12"};
  third.offers = {{"Dealer One", 1.0, "EUR", 1.0, "", "https://shop.example/c-77"}};
  third.documents = {{"https://maker.example/data/sheet.pdf", ""}};
  third.numbers["mass_kg"].source = "weighed by hand";
  return {fast, other, third};
}

TEST(PartSearch, FindsWordsOfAllTextsInAnyOrder) {
  const auto parts = Bench();
  EXPECT_THAT(Found(parts, "festo"), ElementsAre("a", "b"));
  EXPECT_THAT(Found(parts, "switch FESTO"), ElementsAre("a"));
  EXPECT_THAT(Found(parts, "fur 0.5"), ElementsAre("a"));
  EXPECT_THAT(Found(parts, "muller"), ElementsAre("c"));
  EXPECT_THAT(Found(parts, "MÜLLER m5"), ElementsAre("c"));
  for (const char* text : {"page 12", "dealer", "shop.example", "c-77", "sheet", "hand weighed"})
    EXPECT_THAT(Found(parts, text), ElementsAre("c")) << text;
  EXPECT_THAT(Found(parts, "reservoir"), ElementsAre("a", "b", "c"));
  EXPECT_THAT(Found(parts, "festo vacuum"), IsEmpty());
  EXPECT_THAT(Found(parts, "esto"), IsEmpty());  // in the middle of a word
}

TEST(PartSearch, FindsNumbersByTheirPartsAndWithoutSigns) {
  const auto parts = Bench();
  for (const char* text : {"mhe2-ms1h", "MS1H-3/2", "ms1h mhe2", "MHE2MS1H", "mhe2_ms1h", "m7"})
    EXPECT_THAT(Found(parts, text), ElementsAre("a")) << text;
  for (const char* text : {"vq110", "VQ-110", "vq1105l"})
    EXPECT_THAT(Found(parts, text), ElementsAre("b")) << text;
  // "3/2" is neither 3.2 nor 32.
  EXPECT_THAT(Found(parts, "3/2"), ElementsAre("a"));
  EXPECT_THAT(Found(parts, "3.2"), ElementsAre("c"));
  EXPECT_THAT(Found(parts, "32"), ElementsAre("b"));
}

TEST(PartSearch, GradesNamesAboveOtherTexts) {
  const auto parts = Bench();
  EXPECT_THAT(Found(parts, "festo", kFoundByName), ElementsAre("a"));
  EXPECT_THAT(Found(parts, "festo fast", kFoundByName), IsEmpty());
}

TEST(PartSearch, TakesSignsOfQueryLanguagesAsText) {
  const auto parts = Bench();
  for (const char* text : {"\"festo", "festo*", "(festo", "festo)", "festo;--", "'festo'", "^festo",
                           "festo:", "{festo}", "fest\xC3", "\"", "* *", "-"}) {
    const bool says_nothing = std::string(text).find_first_of("ef") == std::string::npos;
    const bool is_broken = std::string(text).back() == '\xC3';
    EXPECT_EQ(Found(parts, text).size(), is_broken ? 0u : says_nothing ? 3u : 2u) << text;
  }
  EXPECT_THAT(Found(parts, "festo OR smc"), IsEmpty());  // a word like others
  EXPECT_THAT(Found(parts, "festo NOT"), IsEmpty());
  EXPECT_THAT(Found({}, "festo"), IsEmpty());
}

// All texts of a part with one blank around each, in lower case.
std::string TextsOf(const catalog::Part& part) {
  std::string all;
  const auto add = [&](std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    all += " " + text;
  };
  for (const auto& text :
       {part.id, part.family, part.manufacturer, part.part_number, part.series, part.notes})
    add(text);
  for (const auto& alias : part.aliases) add(alias);
  for (const auto& offer : part.offers) add(offer.supplier), add(offer.link);
  for (const auto& document : part.documents) add(document.link);
  for (const auto& [field, number] : part.numbers) add(number.source);
  for (const auto& [field, text] : part.texts) add(text.value), add(text.source);
  if (part.curve) add(part.curve->free_air_source), add(part.curve->current_source);
  return all;
}

// Texts of letters alone against a search written with std::string::find.
TEST(PartSearch, AgreesWithPlainComparisonOnParts) {
  std::mt19937 random(2026);
  const auto word = [&] {
    std::string text;
    for (std::size_t n = 1 + random() % 3; n > 0; --n) text += "abX"[random() % 3];
    return text;
  };
  const auto words = [&] {
    std::string text = word();
    for (std::size_t n = random() % 3; n > 0; --n) text += " " + word();
    return text;
  };
  std::vector<catalog::Part> parts;
  for (int i = 100; i < 400; ++i) {
    const auto families = catalog::Families();
    catalog::Part part =
        catalog::AnyPart(families[random() % families.size()], "p" + std::to_string(i), random);
    for (std::string* text : {&part.manufacturer, &part.series, &part.notes}) *text = words();
    part.part_number = word();  // of several it would also be found without the blanks
    for (auto& alias : part.aliases) alias = word();
    for (auto& offer : part.offers) offer.supplier = words(), offer.link = words();
    for (auto& document : part.documents) document.link = words();
    for (auto& [field, number] : part.numbers) number.source = words();
    for (auto& [field, text] : part.texts) text = {words(), {}, words()};
    if (part.curve) part.curve->free_air_source = words(), part.curve->current_source = words();
    parts.push_back(part);
  }
  const PartSearch search(parts);
  std::size_t found = 0, missed = 0;
  for (int i = 0; i < 300; ++i) {
    std::string text = words();
    for (std::size_t more = random() % 3; more > 0; --more) text += " " + word() + word();
    const auto grades = search.Find(text);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const std::string all = TextsOf(parts[k]);
      bool expected = true;
      std::istringstream pieces(text);
      for (std::string piece; pieces >> piece;) {
        std::replace(piece.begin(), piece.end(), 'X', 'x');
        expected = expected && all.find(" " + piece) != std::string::npos;
      }
      ASSERT_EQ(grades[k] != kNotFound, expected) << text << " in" << all;
      ++(expected ? found : missed);
    }
  }
  EXPECT_GT(found, 1000u);
  EXPECT_GT(missed, 1000u);
}

TEST(PartSearch, FindsTheSameWhateverTheOrderOfWords) {
  const auto parts = Bench();
  std::vector<std::string> words = {"festo", "m7", "fast", "24", "3/2"};
  std::sort(words.begin(), words.end());
  do {
    std::string text;
    for (const auto& word : words) text += word + " ";
    ASSERT_THAT(Found(parts, text), UnorderedElementsAre("a"));
  } while (std::next_permutation(words.begin(), words.end()));
}

}  // namespace part_search_test
}  // namespace plenum::api
