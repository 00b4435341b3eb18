// catalog.db against the CSV files that it is built from.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "catalog/fields/csv.h"
#include "catalog/fields/fields.h"
#include "catalog/store/store.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace seed_test {

const std::filesystem::path kSource = test::SourceDir();

CsvParts ReadFamily(const Family& family) {
  std::ifstream file(kSource / "catalog/data" / (std::string(family.name) + ".csv"),
                     std::ios::binary);
  EXPECT_TRUE(file.is_open()) << family.name;
  return ReadCsv(family.name, std::string(std::istreambuf_iterator<char>(file), {}));
}

TEST(Seed, EveryFileIsValidAndHasParts) {
  std::set<std::string> ids;
  for (const Family& family : Families()) {
    const CsvParts read = ReadFamily(family);
    for (const CsvError& error : read.errors)
      ADD_FAILURE() << family.name << ".csv row " << error.row << ", " << error.column << ": "
                    << error.detail;
    EXPECT_GE(read.parts.size(), 1u) << family.name;
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

TEST(Seed, EveryRowHasASeriesOfItsMakerAndFamily) {
  std::map<std::string, std::string> owner;  // of a series: family and maker
  for (const Family& family : Families())
    for (const Part& part : ReadFamily(family).parts) {
      EXPECT_TRUE(part.series.starts_with(part.manufacturer + " ")) << part.id;
      const std::string of = std::string(family.name) + " of " + part.manufacturer;
      EXPECT_EQ(owner.emplace(part.series, of).first->second, of) << part.id;
    }
}

// Groups that a person checked.
TEST(Seed, VariantsShareASeries) {
  std::map<std::string, std::string> series;
  for (const Family& family : Families())
    for (const Part& part : ReadFamily(family).parts) series[part.id] = part.series;
  const std::vector<std::vector<std::string>> groups = {
      {"jsg-bd-02a-1-6v", "jsg-bd-02ab-3-24v"},
      {"jsg-bd-03a-1-6v"},
      {"viair-90c-12v", "viair-90c-13.8v"},
      {"viair-330c-ig-13.8v"},
      {"asco-rhb20xx30x-pair", "asco-rmm3xxx55x"},
      {"smc-sy3000", "smc-sy3240-5mz"},
      {"smc-sy5000"},
      {"smc-syj300"},
      {"smc-s070c-6dc-32", "smc-s070c-6dc-32-pair"},
      {"festo-mpye-5-m5-010-b", "festo-mpye-5-3-8-010-b"},
      {"metal-impact-s06", "metal-impact-s40"},
      {"generic-0.1l-200bar-al", "generic-0.5l-200bar-al"},
      {"tattu-r-line-4s-1550-mah-95c", "tattu-r-line-6s-1400-mah"},
      {"tattu-6s-14500-mah"},
      {"generic-lipo-1s-300mah", "generic-lipo-6s-3300mah"},
      {"smc-ir2000", "smc-ir2020"}};
  std::set<std::string> seen;
  for (const auto& group : groups) {
    for (const std::string& id : group) EXPECT_EQ(series.at(id), series.at(group.front())) << id;
    EXPECT_TRUE(seen.insert(series.at(group.front())).second) << group.front();
  }
}

TEST(Seed, AClassOfPartsIsNoProductAndEveryOtherRowIsOne) {
  for (const Family& family : Families())
    for (const Part& part : ReadFamily(family).parts)
      EXPECT_EQ(part.orderable, !part.manufacturer.starts_with("generic")) << part.id;
}

TEST(Seed, EveryValveHasAResponseTimeAndAnEstimateSaysHowGoodItIs) {
  for (const Part& part : ReadFamily(*FindFamily("valve")).parts) {
    ASSERT_TRUE(part.numbers.contains("response_time_ms")) << part.id;
    const Number& time = part.numbers.at("response_time_ms");
    if (time.provenance != Provenance::kEstimated) continue;
    EXPECT_THAT(time.source, ::testing::HasSubstr("median of ")) << part.id;
    EXPECT_TRUE(time.uncertainty) << part.id;
  }
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

}  // namespace seed_test
}  // namespace plenum::catalog
