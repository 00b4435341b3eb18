#include "catalog/store/seed/seed_update.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>

#include "catalog/store/store.h"
#include "tests/catalog/folder.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace seed_update_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

Part Noted(const std::string& id, const std::string& notes) {
  Part part = Reservoir(id);
  part.notes = notes;
  return part;
}

// A catalogue that began as the installed one, which an upgrade then replaces.
class SeedUpdates : public InFolder {
 protected:
  fs::path installed_ = folder_ / "installed.db";

  void Install(const std::vector<Part>& parts) {
    Store(installed_, Access::kWrite).ReplaceSeed(parts);
  }
  void Begin() { fs::copy_file(installed_, path_); }
  SeedUpdate Update(bool dry_run = false) { return UpdateSeed(path_, installed_, "me", dry_run); }
  std::string Notes(const std::string& id) const {
    const auto part = Read().Get(id);
    return part ? part->notes : "none";
  }
};

TEST_F(SeedUpdates, RowsThatNobodyTouchedFollowTheNewSeed) {
  Install({Noted("a", "old"), Noted("b", "old"), Noted("gone", "old")});
  Begin();
  Install({Noted("a", "new"), Noted("b", "old"), Noted("c", "new")});
  const SeedUpdate update = Update();
  EXPECT_THAT(update.plan.added, ElementsAre("c"));
  EXPECT_THAT(update.plan.replaced, ElementsAre("a"));
  EXPECT_THAT(update.plan.removed, ElementsAre("gone"));
  EXPECT_THAT(update.plan.kept, IsEmpty());
  EXPECT_EQ(Read().List(), Store(installed_, Access::kRead).List());
  EXPECT_EQ(update.revision, Read().Head());
  EXPECT_EQ(update.revision.who, "me");
  EXPECT_THAT(Read().Check(), IsEmpty());
}

TEST_F(SeedUpdates, WhatUsersChangedAddedOrRemovedStays) {
  Install({Noted("changed", "old"), Noted("removed", "old"), Noted("both", "old")});
  Begin();
  {
    Store store = Write();
    store.Replace(Noted("changed", "mine"));
    store.Remove("removed");
    store.Add(Noted("added", "mine"));
    store.Replace(Noted("both", "mine"));
    store.Remove("both");
  }
  Install({Noted("changed", "new"), Noted("removed", "new"), Noted("added", "new"),
           Noted("both", "new")});
  EXPECT_THAT(Update().plan.kept, ElementsAre("added", "both", "changed", "removed"));
  EXPECT_EQ(Notes("changed"), "mine");
  EXPECT_EQ(Notes("removed"), "none");
  EXPECT_EQ(Notes("added"), "mine");
  EXPECT_EQ(Notes("both"), "none");
}

// A row that a seed took away comes back with a later one.
TEST_F(SeedUpdates, WhatASeedRemovedALaterOneMayBring) {
  Install({Noted("a", "1")});
  Begin();
  Install({Noted("b", "2")});
  Update();
  EXPECT_EQ(Notes("a"), "none");
  Install({Noted("a", "3"), Noted("b", "2")});
  EXPECT_THAT(Update().plan.added, ElementsAre("a"));
  EXPECT_EQ(Notes("a"), "3");
}

TEST_F(SeedUpdates, ASecondUpdateWritesNothingAndADryRunNeitherDoes) {
  Install({Noted("a", "old")});
  Begin();
  Install({Noted("a", "new")});
  const Revision before = Read().Head();
  const SeedPlan planned = Update(true).plan;
  EXPECT_EQ(Read().Head(), before);
  EXPECT_EQ(Notes("a"), "old");
  const SeedUpdate done = Update();
  EXPECT_EQ(done.plan, planned);
  const SeedUpdate again = Update();
  EXPECT_EQ(again.plan, SeedPlan());
  EXPECT_EQ(again.revision, done.revision);
}

TEST_F(SeedUpdates, IsTakenBackAsAnyWrite) {
  Install({Noted("a", "old")});
  Begin();
  Install({Noted("a", "new"), Noted("b", "new")});
  const SeedUpdate update = Update();
  ASSERT_EQ(Write().Undo(update.revision.number, {}).status, WriteStatus::kDone);
  EXPECT_EQ(Notes("a"), "old");
  EXPECT_EQ(Notes("b"), "none");
}

TEST_F(SeedUpdates, OfTheSameFileOrNoneIsRefused) {
  Install({Noted("a", "old")});
  Begin();
  EXPECT_THROW(UpdateSeed(path_, path_, "me", false), StoreError);
  EXPECT_THROW(UpdateSeed(path_, folder_ / "none.db", "me", false), StoreError);
  EXPECT_THROW(UpdateSeed(folder_ / "none.db", installed_, "me", true), StoreError);
  EXPECT_FALSE(fs::exists(folder_ / "none.db"));
}

// Against a catalogue that is a map, and remembers which rows users touched.
TEST_F(SeedUpdates, AnyHistoryOfUsersAndSeeds) {
  std::mt19937 random(7);
  const auto draw = [&](int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random);
  };
  const auto id = [&] { return std::string(1, static_cast<char>('a' + draw(8))); };
  std::map<std::string, std::string> seed, expected;
  std::set<std::string> touched;
  const auto install = [&](int version) {
    std::map<std::string, std::string> next;
    std::vector<Part> parts;
    for (char c = 'a'; c < 'i'; ++c) {
      const std::string name(1, c);
      const int fate = draw(3);  // absent, as before, or new
      if (fate == 1 && seed.contains(name)) next[name] = seed[name];
      if (fate == 2) next[name] = "seed " + std::to_string(version);
    }
    parts.reserve(next.size());
    for (const auto& [name, notes] : next) parts.push_back(Noted(name, notes));
    Install(parts);
    seed = next;
  };
  install(0);
  Begin();
  expected = seed;
  for (int version = 1; version < 40; ++version) {
    {
      Store store = Write();
      for (int n = draw(4); n > 0; --n) {
        const std::string name = id(), notes = "user " + std::to_string(version);
        if (!expected.contains(name)) {
          ASSERT_EQ(store.Add(Noted(name, notes)).status, WriteStatus::kDone);
          expected[name] = notes;
        } else if (draw(2) == 0) {
          ASSERT_EQ(store.Replace(Noted(name, notes)).status, WriteStatus::kDone);
          expected[name] = notes;
        } else {
          ASSERT_EQ(store.Remove(name).status, WriteStatus::kDone);
          expected.erase(name);
        }
        touched.insert(name);
      }
    }
    if (version % 10 == 0) touched.clear();  // as a new user, whose catalogue is a new copy
    if (version % 10 == 0) {
      fs::remove(path_);
      Begin();
      expected = seed;
    }
    install(version);
    Update();
    for (char c = 'a'; c < 'i'; ++c) {
      const std::string name(1, c);
      if (touched.contains(name)) continue;
      expected.erase(name);
      if (seed.contains(name)) expected[name] = seed[name];
    }
    for (char c = 'a'; c < 'i'; ++c) {
      const std::string name(1, c);
      EXPECT_EQ(Notes(name), expected.contains(name) ? expected[name] : "none") << name << version;
    }
    ASSERT_THAT(Read().Check(), IsEmpty());
  }
}

}  // namespace seed_update_test
}  // namespace plenum::catalog
