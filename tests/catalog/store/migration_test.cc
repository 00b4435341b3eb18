// Files of every released schema open with this program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/store/content_hash.h"
#include "catalog/store/documents/document_files.h"
#include "catalog/store/sql/migrations.h"
#include "tests/catalog/folder.h"
#include "tests/catalog/samples.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace migration_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class Migrating : public InFolder {
 protected:
  // The file as the release with that schema left it.
  void MakeOld(int schema) const {
    Sql(Bytes(test::SourceDir() / "tests/catalog" / ("schema_" + std::to_string(schema) + ".sql")));
  }
  int Count(const std::string& what) const {
    SQLite::Database db(path_.string());
    return db.execAndGet("SELECT " + what).getInt();
  }
  std::string Text(const std::string& what) const {
    SQLite::Database db(path_.string());
    return db.execAndGet("SELECT " + what).getString();
  }
  void ExpectPartsOfSchema1(const Store& store) const {
    std::vector<std::string> ids;
    for (const Part& part : store.List()) ids.push_back(part.id);
    EXPECT_THAT(ids, ElementsAre("airpo-d028b-15lpm", "festo-crvzs-0.1", "generic-barb-3.175mm-m3",
                                 "mine"));
    const Part mine = store.Get("mine").value();
    EXPECT_EQ(mine.origin, "user");
    EXPECT_EQ(mine.notes, "from the \"shelf\", 2 pieces");
    EXPECT_EQ(mine.numbers.at("mass_kg"), (Number{0.1, Provenance::kEstimated, "guess"}));
    EXPECT_EQ(store.Get("airpo-d028b-15lpm")->curve->points.size(), 11u);
    EXPECT_THAT(store.Check(), IsEmpty());
  }
};

TEST_F(Migrating, EverySchemaButTheNewestHasAnOldFile) {
  for (std::size_t schema = 1; schema < Migrations().size(); ++schema)
    EXPECT_TRUE(std::filesystem::exists(test::SourceDir() / "tests/catalog" /
                                        ("schema_" + std::to_string(schema) + ".sql")))
        << "keep an old file of schema " << schema;
}

TEST_F(Migrating, AFileOfSchema1KeepsItsPartsAndGoesOnCounting) {
  MakeOld(1);
  Store store = Write();
  ExpectPartsOfSchema1(store);
  EXPECT_EQ(store.Head().number, 7);  // writes that were counted before there were revisions
  EXPECT_EQ(store.Head().what, "history begins");
  const std::string before = store.Head().hash;
  ASSERT_EQ(store.Remove("mine").status, WriteStatus::kDone);
  EXPECT_EQ(store.Head().number, 8);
  ASSERT_EQ(store.Undo(8, {}).status, WriteStatus::kDone);
  EXPECT_EQ(store.Head().hash, before);
  ExpectPartsOfSchema1(store);
}

TEST_F(Migrating, AFileOfSchema2KeepsItsPartsAndHistoryAndTakesModels) {
  MakeOld(2);
  Store store = Write();
  ExpectPartsOfSchema1(store);
  EXPECT_EQ(store.Head().number, 9);
  EXPECT_EQ(store.Changes(store.Head()).size(), 1u);
  EXPECT_THAT(store.Models(), IsEmpty());
  EXPECT_EQ(store.SaveModel("bench", "{}", "me").version, 1);
}

TEST_F(Migrating, AFileOfSchema3KeepsEveryHashAndItsModels) {
  MakeOld(3);
  const std::string head = Text("hash FROM revision ORDER BY number DESC LIMIT 1");
  Store store = Write();
  ExpectPartsOfSchema1(store);
  EXPECT_EQ(store.Head().number, 9);
  EXPECT_EQ(store.Head().hash, head);  // what the older program computed of the same parts
  EXPECT_TRUE(store.FindModel("bench"));
  const Part mine = store.Get("mine").value();
  EXPECT_EQ(mine.series, "");
  EXPECT_FALSE(mine.orderable);
  EXPECT_THAT(mine.aliases, IsEmpty());
  EXPECT_THAT(mine.offers, IsEmpty());
  EXPECT_THAT(mine.documents, IsEmpty());
}

TEST_F(Migrating, AFileOfSchema4KeepsEveryHashAndTakesTheFilesOfItsDocuments) {
  MakeOld(4);
  const std::string head = Text("hash FROM revision ORDER BY number DESC LIMIT 1");
  Store store = Write();
  EXPECT_EQ(store.Head().hash, head);
  const Part part = store.Get("documented").value();
  EXPECT_THAT(part.documents, ElementsAre(Document{"https://example.org/d.pdf", ""},
                                          Document{"recording.csv", Sha256("abc")}));
  ASSERT_EQ(DocumentFiles::Add(store, part.id, {"", "text/csv", "abc"}).status, WriteStatus::kDone);
  EXPECT_EQ(store.Head().hash, head);
  EXPECT_EQ(DocumentFiles::Content(store, Sha256("abc")), "abc");
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_F(Migrating, AMigratedPartTakesTheNewFieldsAndGivesThemBack) {
  MakeOld(3);
  Store store = Write();
  const Part before = store.Get("mine").value();
  Part after = before;
  after.series = "Maker S";
  after.orderable = true;
  after.aliases = {"S-1"};
  after.offers = {{"Shop", 12.0, "EUR", 2.0, "2024-05", "https://example.org"}};
  after.documents = {{"https://example.org/s.pdf", ""}};
  after.numbers.at("mass_kg").provenance = Provenance::kMeasured;
  after.numbers.at("mass_kg").uncertainty = 0.05;
  ASSERT_EQ(store.Replace(after).status, WriteStatus::kDone);
  EXPECT_EQ(store.Get("mine"), after);
  const std::int64_t number = store.Head().number;
  ASSERT_EQ(store.Undo(number, {}).status, WriteStatus::kDone);
  EXPECT_EQ(store.Get("mine"), before);
  EXPECT_EQ(store.GetAt("mine", number), after);  // read back from its record
  EXPECT_THAT(store.Check(), IsEmpty());
}

TEST_F(Migrating, ReadingMigratesToo) {
  MakeOld(1);
  ExpectPartsOfSchema1(Read());
  EXPECT_EQ(Count("max(number) FROM migration"), static_cast<int>(Migrations().size()));
}

TEST_F(Migrating, IsOneTransaction) {
  MakeOld(1);
  Sql("CREATE TABLE change (mine)");  // the second migration will stumble half way
  const std::string before = Bytes(path_);
  EXPECT_THAT(Refusal([&] { Write(); }), HasSubstr("change"));
  EXPECT_EQ(Count("user_version FROM pragma_user_version"), 1);
  EXPECT_EQ(Count("count(*) FROM sqlite_master WHERE name = 'counter'"), 0);
  EXPECT_EQ(Count("number FROM revision"), 7);
  EXPECT_EQ(Bytes(path_).size(), before.size());
}

TEST_F(Migrating, AFileOfTheFutureIsRefusedAsItIs) {
  Write().Add(Reservoir("r"));
  const int next = static_cast<int>(Migrations().size()) + 1;
  Sql("PRAGMA user_version = " + std::to_string(next));
  const std::string before = Bytes(path_);
  for (const Access access : {Access::kRead, Access::kWrite})
    EXPECT_THAT(Refusal([&] { Store(path_, access); }),
                HasSubstr("has schema " + std::to_string(next) + ", this program knows up to " +
                          std::to_string(next - 1) + "; use a newer program"));
  EXPECT_EQ(Bytes(path_), before);
}

}  // namespace migration_test
}  // namespace plenum::catalog
