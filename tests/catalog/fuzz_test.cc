// Seeded mutation of CSV files and records: whatever comes in, the answer is parts that can be
// stored or errors with a row, never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "catalog/fields/csv.h"
#include "catalog/store/part_record.h"
#include "catalog/units/quantity.h"
#include "catalog/units/text.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace fuzz_test {

#ifdef PLENUM_SANITIZED
constexpr int kDraws = 4'000;
#else
constexpr int kDraws = 20'000;
#endif

const char* const kTokens[] = {",",     "\"",   "\n",    "\r\n",   "\r",   "\"\"",  ";",  ":",
                               "6 bar", "-1",   "1e308", "1e-320", "nan",  "inf",   "µ",  "³",
                               "\xFF",  "\x00", "%",     "0x1p3",  "id",   "curve", " g", ".source",
                               "mL",    "+1",   "1e",    "--",     ".5 L", "€",     "·",  "(g)"};

std::string Mutate(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return random() % n; };
  for (std::size_t i = 0; i <= below(4); ++i) {
    if (text.empty()) return text;
    const std::size_t at = below(text.size()), length = 1 + below(12);
    switch (below(6)) {
      case 0:
        text.erase(at, length);
        break;
      case 1:
        text.insert(at, text.substr(below(text.size()), length));
        break;
      case 2:
        text[at] = static_cast<char>(below(256));
        break;
      case 3:
      case 4:
        text.insert(at, kTokens[below(std::size(kTokens))]);
        break;
      default:
        if (below(8) == 0) text.resize(at);
    }
  }
  return text;
}

TEST(CsvFuzz, MutatedFilesAreReadOrRefusedWithARow) {
  std::mt19937 random(20240612);
  std::vector<std::string> files;
  for (const Family& family : Families())
    files.push_back(
        WriteCsv(family.name, {AnyPart(family, "a", random), AnyPart(family, "b", random)}));
  int accepted = 0, refused = 0;
  for (int i = 0; i < kDraws; ++i) {
    const std::string_view family = Families()[i % 9].name;
    const CsvParts read = ReadCsv(family, Mutate(files[i % 9], random));
    ASSERT_EQ(read.rows.size(), read.parts.size());
    if (!read.errors.empty()) {
      ++refused;
      for (const CsvError& error : read.errors) {
        ASSERT_GE(error.row, 1);
        ASSERT_FALSE(error.detail.empty());
      }
      continue;
    }
    ++accepted;
    for (const Part& part : read.parts) ASSERT_TRUE(Validate(part).empty());
    // What was read can be written, and is the same when read again.
    const std::string written = WriteCsv(family, read.parts);
    const CsvParts again = ReadCsv(family, written);
    ASSERT_EQ(again.parts, read.parts);
    ASSERT_EQ(WriteCsv(family, again.parts), written);
  }
  EXPECT_GT(accepted, kDraws / 20);
  EXPECT_GT(refused, kDraws / 20);
}

TEST(CsvFuzz, MutatedRecordsAreReadOrRefused) {
  std::mt19937 random(99);
  int read = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Part part = AnyPart(Families()[i % 9], "a", random);
    const auto parsed = ParseRecord(Mutate(FormatRecord(part), random));
    if (!parsed) continue;
    ++read;
    ASSERT_EQ(ParseRecord(FormatRecord(*parsed)), parsed);
  }
  EXPECT_GT(read, kDraws / 20);
}

TEST(CsvFuzz, AnyTextIsAQuantityOrAnError) {
  std::mt19937 random(7);
  int accepted = 0;
  for (int i = 0; i < kDraws; ++i) {
    const Family& family = Families()[i % 9];
    const std::string_view field = family.numbers[random() % family.numbers.size()].name;
    const Quantity quantity = ParseQuantity(Mutate("12.5 kg", random), field);
    ASSERT_NE(quantity.value.has_value(), !quantity.error.empty());
    ASSERT_TRUE(!quantity.value || std::isfinite(*quantity.value));
    accepted += quantity.value.has_value();
  }
  EXPECT_GT(accepted, 100);
}

}  // namespace fuzz_test
}  // namespace plenum::catalog
