// A whole catalogue from each store into each.
#include "catalog/store/copy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace copy_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// From the parameter's store into a file and, where there is one, to a server.
class Copies : public InStore {
 protected:
  std::vector<std::filesystem::path> Targets() const {
    std::vector<std::filesystem::path> targets = {folder_ / "copy.db"};
    if (test::WhyNoPostgres().empty()) targets.emplace_back(test::NewDatabase());
    return targets;
  }
  // Random parts of every family, replaced, removed and undone, with keys and models.
  void Fill() const {
    std::mt19937 random(23);
    Store store = Write();
    std::vector<Part> parts;
    for (const Family& family : Families())
      for (int i = 0; i < 12; ++i)
        parts.push_back(AnyPart(family, std::string(family.name) + std::to_string(i), random));
    parts.front().notes = "ü \"quoted\"\n\ttab";
    ASSERT_EQ(store.Import(EachOf(parts), Signature{"ann", "key-1", "digest"}).write.status,
              WriteStatus::kDone);
    store.ReplaceSeed({Reservoir("seeded")});
    ASSERT_EQ(store.Remove(parts.back().id, {"bob", "", ""}).status, WriteStatus::kDone);
    ASSERT_EQ(store.Undo(store.Head().number, {}).status, WriteStatus::kDone);
    store.SaveModel("bench", "{\"a\": [1, 2]}", "ann");
    store.SaveModel("bench", "{\"a\": [3]}", "ann");
  }
  static void ExpectSame(const Store& a, const Store& b) {
    EXPECT_EQ(a.List(), b.List());
    const auto revisions = a.Revisions(INT64_MAX, 1000);
    EXPECT_EQ(revisions, b.Revisions(INT64_MAX, 1000));
    for (const Revision& revision : revisions) {
      EXPECT_EQ(a.ListAt(revision.number), b.ListAt(revision.number));
      EXPECT_EQ(a.Changes(revision), b.Changes(revision));
    }
    EXPECT_EQ(a.ModelVersions("bench"), b.ModelVersions("bench"));
  }
};

TEST_P(Copies, HoldEverythingAndGoOn) {
  Fill();
  for (const auto& target : Targets()) {
    EXPECT_EQ(CopyCatalogue(path_, target), Read().Head());
    Store copy(target, Access::kWrite);
    ExpectSame(Read(), copy);
    EXPECT_THAT(copy.Check(), IsEmpty());
    const std::int64_t number = copy.Head().number;
    const Part known = Read().List().front();
    // The key of the import is known, an undo goes on, and the count as well.
    EXPECT_EQ(copy.Add(known, {"ann", "key-1", "digest"}).status, WriteStatus::kRepeated);
    EXPECT_EQ(copy.Undo(number, {}).revision.number, number + 1);
    EXPECT_THAT(copy.Check(), IsEmpty());
  }
}

TEST_P(Copies, ThereAndBackAreTheSame) {
  Fill();
  for (const auto& target : Targets()) {
    CopyCatalogue(path_, target);
    const auto back = Another();
    CopyCatalogue(target, back);
    ExpectSame(Read(), Store(back, Access::kRead));
    if (!OnServer()) std::filesystem::remove(back);
  }
}

TEST_P(Copies, RefuseATargetThatHoldsOneAndASourceThatHoldsNone) {
  Write();
  const auto other = Another();
  Store(other, Access::kWrite).Add(Reservoir("theirs"));
  EXPECT_THAT(Refusal([&] { CopyCatalogue(path_, other); }),
              HasSubstr("holds a catalogue already"));
  EXPECT_TRUE(Store(other, Access::kRead).Get("theirs"));
  EXPECT_NE(Refusal([&] { CopyCatalogue(folder_ / "missing.db", folder_ / "new.db"); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new.db"));
}

TEST_P(Copies, AreNotMadeOfADamagedCatalogue) {
  Fill();
  Sql(std::string("DROP TRIGGER change_is_not_changed") + (OnServer() ? " ON change;" : ";") +
      "UPDATE change SET before = replace(before, 'Maker', 'Faker') WHERE before IS NOT NULL");
  Sql("UPDATE number SET value = value / 2 WHERE field = 'mass_kg'");
  for (const auto& target : Targets()) {
    EXPECT_THAT(Refusal([&] { CopyCatalogue(path_, target); }),
                HasSubstr("would not be a true copy"));
    EXPECT_NE(Refusal([&] { Store(target, Access::kRead); }), "");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "copy.db"));
}

PLENUM_ON_EACH_STORE(Copies);

}  // namespace copy_test
}  // namespace plenum::catalog
