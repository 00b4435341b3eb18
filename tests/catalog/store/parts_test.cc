// Parts in each store: kept exactly, written or refused as a whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <thread>

#include "catalog/fields/csv.h"
#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace parts_test {

using ::testing::ElementsAre;

using StoredParts = InStore;

TEST_P(StoredParts, KeepsRandomPartsExactly) {
  std::mt19937 random(17);
  std::vector<Part> parts;
  for (const Family& family : Families())
    for (int i = 0; i < 20; ++i)
      parts.push_back(AnyPart(family, std::string(family.name) + std::to_string(100 + i), random));
  {
    Store store = Write();
    for (const Part& part : parts) ASSERT_EQ(store.Add(part).status, WriteStatus::kDone) << part.id;
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.id < b.id; });
  const Store store = Read();
  EXPECT_EQ(store.List(), parts);
  for (const Part& part : parts) EXPECT_EQ(store.Get(part.id), part);
  const std::vector<Part> valves = store.List("valve");
  EXPECT_EQ(valves.size(), 20u);
  for (const Part& valve : valves) EXPECT_EQ(valve.family, "valve");
  EXPECT_THAT(store.List("tank"), ElementsAre());
  EXPECT_THAT(store.Check(), ElementsAre());
}

TEST_P(StoredParts, AnExportImportedElsewhereIsExportedByteForByte) {
  std::mt19937 random(19);
  Store store = Write();
  for (const Family& family : Families())
    for (int i = 0; i < 30; ++i)
      store.Add(AnyPart(family, std::string(family.name) + std::to_string(i), random));
  Store other(Another(), Access::kWrite);
  for (const Family& family : Families()) {
    const std::string name(family.name), exported = WriteCsv(name, store.List(name));
    const CsvParts read = ReadCsv(name, exported);
    ASSERT_THAT(read.errors, ElementsAre());
    ASSERT_EQ(other.Import(EachOf(read.parts), {}).plan.added.size(), 30u);
    EXPECT_EQ(WriteCsv(name, other.List(name)), exported) << name;
  }
  EXPECT_EQ(other.List(), store.List());
  EXPECT_EQ(other.Head().hash, store.Head().hash);
}

TEST_P(StoredParts, AddReplaceAndRemoveSayWhatHappened) {
  Store store = Write();
  EXPECT_EQ(store.Get("r"), std::nullopt);
  EXPECT_EQ(store.Replace(Reservoir("r")).status, WriteStatus::kNotFound);
  EXPECT_EQ(store.Remove("r").status, WriteStatus::kNotFound);
  EXPECT_EQ(store.Add(Reservoir("r")).status, WriteStatus::kDone);
  Part other = Reservoir("r");
  other.numbers.at("mass_kg").value = 0.7;
  EXPECT_EQ(store.Add(other).status, WriteStatus::kExists);
  EXPECT_EQ(store.Get("r"), Reservoir("r"));
  EXPECT_EQ(store.Replace(other).status, WriteStatus::kDone);
  EXPECT_EQ(store.Get("r"), other);
  EXPECT_EQ(store.Remove("r").status, WriteStatus::kDone);
  EXPECT_THAT(store.List(), ElementsAre());
}

TEST_P(StoredParts, RefusesInvalidPartsAndKeepsWhatWas) {
  Store store = Write();
  Part bad = Reservoir("r");
  for (const double value : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    bad.numbers.at("mass_kg").value = value;
    const WriteResult result = store.Add(bad);
    EXPECT_EQ(result.status, WriteStatus::kInvalid);
    EXPECT_EQ(result.errors.size(), 1u);
  }
  store.Add(Reservoir("r"));
  EXPECT_EQ(store.Replace(bad).status, WriteStatus::kInvalid);
  EXPECT_EQ(store.Get("r"), Reservoir("r"));
}

TEST_P(StoredParts, TheHeadCountsCommittedWritesOfAnyConnection) {
  Store store = Write();
  const Store reader = Read();
  const long long before = reader.Head().number;
  store.Add(Reservoir("r"));
  EXPECT_EQ(reader.Head().number, before + 1);
  store.Add(Reservoir("r"));
  store.Remove("unknown");
  EXPECT_EQ(reader.Head().number, before + 1);
  store.Remove("r");
  EXPECT_EQ(store.Head().number, before + 2);
  EXPECT_EQ(reader.Head().number, before + 2);
}

TEST_P(StoredParts, ReplaceSeedLeavesRowsOfUsers) {
  Store store = Write();
  const Part mine = Reservoir("mine"), clash = Reservoir("clash");
  store.Add(mine);
  store.Add(clash);
  Part seed_clash = Reservoir("clash");
  seed_clash.manufacturer = "Seed";
  store.ReplaceSeed({Reservoir("z"), Reservoir("a"), seed_clash});
  Part a = Reservoir("a"), z = Reservoir("z");
  a.origin = z.origin = "seed";
  EXPECT_THAT(store.List(), ElementsAre(a, clash, mine, z));
  store.ReplaceSeed({Reservoir("a")});
  EXPECT_THAT(store.List(), ElementsAre(a, clash, mine));
}

TEST_P(StoredParts, ReplaceSeedIsAllOrNothing) {
  Store store = Write();
  store.ReplaceSeed({Reservoir("a")});
  const auto before = store.List();
  Part bad = Reservoir("b");
  bad.numbers.clear();
  EXPECT_THROW(store.ReplaceSeed({Reservoir("c"), bad}), StoreError);
  EXPECT_THROW(store.ReplaceSeed({Reservoir("c"), Reservoir("c")}), StoreError);
  EXPECT_EQ(store.List(), before);
}

TEST_P(StoredParts, SqlItselfRefusesWhatIsNotANumberInRange) {
  Write().Add(Reservoir("r"));
  const auto set = [](const std::string& value) {
    return "UPDATE number SET value = " + value + " WHERE field = 'mass_kg'";
  };
  EXPECT_NO_THROW(Sql(set("0.5")));
  // What is no number is NULL in SQLite.
  const char* nan = OnServer() ? "'NaN'" : "9e999 - 9e999";
  for (const char* bad : {"9e999", "-9e999", nan, "NULL", "-1e7", "'heavy'", "1e7"})
    EXPECT_THROW(Sql(set(bad)), SqlError) << bad;
  EXPECT_THROW(Sql("UPDATE number SET provenance = 'guess'"), SqlError);
  for (const char* bad : {"0", "-0.1", "1.5", "9e999"})
    EXPECT_THROW(Sql(std::string("UPDATE number SET uncertainty = ") + bad), SqlError) << bad;
  EXPECT_NO_THROW(Sql("UPDATE number SET uncertainty = 0.05, provenance = 'measured'"));
  EXPECT_THROW(Sql("UPDATE part SET orderable = 2"), SqlError);
  EXPECT_THROW(Sql("INSERT INTO offer VALUES ('r', 0, 'Shop', 1, 'euro', 1, '', '')"), SqlError);
  EXPECT_THROW(Sql("INSERT INTO document VALUES ('r', 0, '', 'abc')"), SqlError);
  EXPECT_THROW(Sql("UPDATE part SET origin = 'me'"), SqlError);
  EXPECT_THROW(Sql("UPDATE part SET id = 'custom'"), SqlError);
  EXPECT_THROW(Sql("UPDATE part SET id = 'A b'"), SqlError);
  EXPECT_THROW(Sql("INSERT INTO curve_point VALUES ('r', 0, 9e999, 1)"), SqlError);
}

TEST_P(StoredParts, ForeignKeysHold) {
  std::mt19937 random(2);
  Store store = Write();
  Part pump = AnyPart(*FindFamily("compressor"), "c", random);
  pump.aliases = {"d"};
  pump.offers = {{"Shop", 1.0, "EUR", 1.0, "", ""}};
  pump.documents = {{"sheet", ""}};
  store.Add(pump);
  EXPECT_THROW(Sql("INSERT INTO number VALUES ('nobody', 'mass_kg', 1, 'derived', '', NULL)"),
               SqlError);
  store.Remove("c");
  for (const char* table : {"number", "text", "curve", "curve_point", "alias", "offer", "document"})
    EXPECT_EQ(Count(table), 0) << table;
}

// Not that of the server's language, which passes over marks.
TEST_P(StoredParts, ComeInTheOrderOfTheBytesOfTheirIds) {
  Store store = Write();
  const std::vector<std::string> ids = {"a-2", "a.1", "a1", "a2-", "a_0", "b"};
  for (const std::string& id : ids) ASSERT_EQ(store.Add(Reservoir(id)).status, WriteStatus::kDone);
  std::vector<std::string> found;
  for (const Part& part : store.List()) found.push_back(part.id);
  EXPECT_EQ(found, ids);
}

TEST_P(StoredParts, WritersAtOnceTakeTurnsAndLoseNothing) {
  Write();
  constexpr int kWriters = 4, kWrites = 15;
  std::vector<std::thread> writers;
  writers.reserve(kWriters);
  for (int w = 0; w < kWriters; ++w)
    writers.emplace_back([&, w] {
      Store store = Write();
      for (int i = 0; i < kWrites; ++i) {
        const std::string id = "w" + std::to_string(w) + "-" + std::to_string(i);
        EXPECT_EQ(store.Add(Reservoir(id)).status, WriteStatus::kDone);
      }
    });
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(Read().Head().number, kWriters * kWrites);
  EXPECT_THAT(Read().Check(), ElementsAre());
}

PLENUM_ON_EACH_STORE(StoredParts);

}  // namespace parts_test
}  // namespace plenum::catalog
