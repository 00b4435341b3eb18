// catalog.db against the CSV files that it is built from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "catalog/csv.h"
#include "catalog/fields.h"
#include "catalog/store.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace {

const std::filesystem::path kSource = test::SourceDir();

CsvParts ReadFamily(const Family& family) {
  std::ifstream file(kSource / "catalog/data" / (std::string(family.name) + ".csv"),
                     std::ios::binary);
  EXPECT_TRUE(file.is_open()) << family.name;
  return ReadCsv(family.name, std::string(std::istreambuf_iterator<char>(file), {}));
}

TEST(Seed, EveryFileIsValidAndHasFifteenPartsOrMore) {
  std::set<std::string> ids;
  for (const Family& family : Families()) {
    const CsvParts read = ReadFamily(family);
    for (const CsvError& error : read.errors)
      ADD_FAILURE() << family.name << ".csv row " << error.row << ", " << error.column << ": "
                    << error.detail;
    EXPECT_GE(read.parts.size(), 15u) << family.name;
    for (const Part& part : read.parts)
      EXPECT_TRUE(ids.insert(part.id).second) << part.id << " is in two families";
  }
}

TEST(Seed, EveryNumberSaysWhereItComesFrom) {
  for (const Family& family : Families())
    for (const Part& part : ReadFamily(family).parts)
      for (const auto& [field, number] : part.numbers)
        EXPECT_NE(number.source, "") << part.id << ", " << field;
}

TEST(Seed, TheBuiltCatalogueHoldsTheRowsOfTheFiles) {
  const Store store(kSource / "catalog.db", Access::kRead);
  EXPECT_THAT(store.Check(), ::testing::IsEmpty());
  for (const Family& family : Families()) {
    std::vector<Part> built = store.List(std::string(family.name));
    std::set<std::string> of_users;
    for (const Part& part : built)
      if (part.origin == "user") of_users.insert(part.id);
    std::erase_if(built, [](const Part& part) { return part.origin == "user"; });

    std::vector<Part> expected = ReadFamily(family).parts;
    std::erase_if(expected, [&](const Part& part) { return of_users.contains(part.id); });
    for (Part& part : expected) part.origin = "seed";
    std::sort(expected.begin(), expected.end(),
              [](const Part& a, const Part& b) { return a.id < b.id; });
    EXPECT_EQ(built, expected) << family.name;
  }
}

}  // namespace
}  // namespace plenum::catalog
