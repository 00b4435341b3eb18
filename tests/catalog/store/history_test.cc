// Revisions, changes, undo and repeated requests against a model kept in memory.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "catalog/store/part_record.h"
#include "tests/catalog/samples.h"
#include "tests/catalog/stores.h"

namespace plenum::catalog {
namespace history_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

using State = std::map<std::string, Part>;

std::vector<Part> Parts(const State& state) {
  std::vector<Part> parts;
  for (const auto& [id, part] : state) parts.push_back(part);
  return parts;
}

TEST(PartRecord, RoundTripIsExactForEveryFamily) {
  std::mt19937 random(29);
  for (const Family& family : Families())
    for (int i = 0; i < 100; ++i) {
      const Part part = AnyPart(family, "id", random);
      EXPECT_EQ(ParseRecord(FormatRecord(part)), part);
    }
}

TEST(PartRecord, RefusesWhatIsNone) {
  const std::string good = FormatRecord(Reservoir("r"));
  ASSERT_TRUE(ParseRecord(good));
  for (const std::string& bad :
       {std::string(), std::string("x\n"), good.substr(good.find('\n') + 1), good + "extra,1\n",
        good + "number,mass_kg,heavy,datasheet,\n", good + "number,mass_kg,1,guess,\n",
        good + "point,1,2,3\n", good + "\"\n"})
    EXPECT_EQ(ParseRecord(bad), std::nullopt) << bad;
}

class History : public InStore {
 protected:
  // One random write; keeps `state` in step. False if nothing was written.
  bool WriteOnce(Store& store, State& state, std::mt19937& random) {
    const Family& family = Families()[random() % Families().size()];
    const std::string id = std::string(family.name) + std::to_string(random() % 4);
    const Part part = AnyPart(family, id, random);
    const Signature by{"tester " + std::to_string(random() % 3), "", ""};
    switch (random() % 4) {
      case 0:
        if (store.Remove(id, by).status != WriteStatus::kDone) return false;
        state.erase(id);
        return true;
      case 1:
        if (store.Replace(part, by).status != WriteStatus::kDone) return false;
        state[id] = part;
        return true;
      case 2: {
        std::vector<Part> parts{part};
        parts.push_back(AnyPart(family, std::string(family.name) + "-more", random));
        EXPECT_EQ(store.Import(EachOf(parts), by).write.status, WriteStatus::kDone);
        for (const Part& imported : parts) state[imported.id] = imported;
        return true;
      }
      default:
        if (store.Add(part, by).status != WriteStatus::kDone) return false;
        state[id] = part;
        return true;
    }
  }
};

TEST_P(History, EveryRevisionCanBeRebuilt) {
  std::mt19937 random(31);
  Store store = Write();
  State state;
  std::map<std::int64_t, State> states{{store.Head().number, state}};
  while (states.size() < 120) {
    const std::int64_t before = store.Head().number;
    if (!WriteOnce(store, state, random)) {
      EXPECT_EQ(store.Head().number, before);
      continue;
    }
    EXPECT_EQ(store.Head().number, before + 1);
    states[store.Head().number] = state;
  }
  const Store reader = Read();
  for (const auto& [number, expected] : states) {
    EXPECT_EQ(reader.ListAt(number), Parts(expected)) << number;
    for (const char* id : {"valve0", "battery1", "reservoir-more"}) {
      const auto found = expected.find(id);
      EXPECT_EQ(reader.GetAt(id, number),
                found == expected.end() ? std::nullopt : std::optional(found->second));
    }
  }
  EXPECT_THAT(reader.Check(), IsEmpty());
}

TEST_P(History, TheHashNamesTheContentWhateverTheWay) {
  Store store = Write();
  const std::string empty = store.Head().hash;
  store.Add(Reservoir("a"));
  store.Add(Reservoir("b"));
  const std::string both = store.Head().hash;
  Part other = Reservoir("a");
  other.numbers["mass_kg"].source = "elsewhere";
  store.Replace(other);
  EXPECT_NE(store.Head().hash, both);
  store.Remove("a");
  store.Add(Reservoir("a"));
  EXPECT_EQ(store.Head().hash, both);
  store.Remove("b");
  store.Remove("a");
  EXPECT_EQ(store.Head().hash, empty);
}

TEST_P(History, TellsWhoDidWhatToAPart) {
  Store store = Write();
  Part heavier = Reservoir("r");
  heavier.numbers["mass_kg"].value = 0.3;
  store.Add(Reservoir("r"), {"ann", "", ""});
  store.Add(Reservoir("other"), {"ann", "", ""});
  store.Replace(heavier, {"bob", "", ""});
  store.Replace(heavier, {"carl", "", ""});  // changes nothing, so no revision
  store.Remove("r", {"dora", "", ""});
  const std::vector<Change> changes = store.History("r", INT64_MAX, 10);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].revision.who + ", " + changes[0].revision.what, "dora, remove r");
  EXPECT_EQ(changes[0].before, heavier);
  EXPECT_EQ(changes[0].after, std::nullopt);
  EXPECT_EQ(changes[1].revision.who + ", " + changes[1].revision.what, "bob, replace r");
  EXPECT_EQ(changes[1].before, Reservoir("r"));
  EXPECT_EQ(changes[1].after, heavier);
  EXPECT_EQ(changes[2].revision.what, "add r");
  EXPECT_EQ(changes[2].before, std::nullopt);
  EXPECT_EQ(changes[2].after, Reservoir("r"));
  EXPECT_THAT(store.History("r", changes[0].revision.number, 1), ElementsAre(changes[1]));
  EXPECT_THAT(store.Changes(changes[1].revision), ElementsAre(changes[1]));
  EXPECT_THAT(store.History("nobody", INT64_MAX, 10), IsEmpty());
}

TEST_P(History, UndoBringsBackWhatWasAndCanBeUndone) {
  std::mt19937 random(37);
  Store store = Write();
  State state;
  for (int i = 0; i < 60; ++i) {
    const State before = state;
    if (!WriteOnce(store, state, random)) continue;
    const Revision written = store.Head();
    const WriteResult undone = store.Undo(written.number, {"ann", "", ""});
    ASSERT_EQ(undone.status, WriteStatus::kDone);
    EXPECT_EQ(undone.revision.what, "undo " + std::to_string(written.number));
    EXPECT_EQ(store.List(), Parts(before));
    ASSERT_EQ(store.Undo(undone.revision.number, {}).status, WriteStatus::kDone);
    EXPECT_EQ(store.List(), Parts(state));
    EXPECT_EQ(store.Head().hash, written.hash);
  }
  EXPECT_EQ(store.Undo(99'999, {}).status, WriteStatus::kNotFound);
  EXPECT_THAT(store.Check(), IsEmpty());
}

// Whatever was written between two revisions: the parts of one with the changes are those of the
// other, in both directions.
TEST_P(History, ChangesLeadFromOneRevisionToAnother) {
  std::mt19937 random(53);
  Store store = Write();
  State state;
  std::map<std::int64_t, std::pair<Revision, State>> known{
      {store.Head().number, {store.Head(), {}}}};
  for (int i = 0; i < 40; ++i)
    if (WriteOnce(store, state, random)) known[store.Head().number] = {store.Head(), state};
  const auto after = [](State from, const PartChanges& changes) {
    for (const auto& [id, part] : changes) {
      from.erase(id);
      if (part) from.emplace(id, *part);
    }
    return from;
  };
  for (const auto& [number, from] : known) {
    const auto since = store.ChangesTo({}, from.first, 1000);
    ASSERT_TRUE(since);
    EXPECT_EQ(since->first, store.Head());
    EXPECT_EQ(after(from.second, since->second), state);
    for (const auto& [other, to] : known) {
      const auto changes = store.ChangesTo(other, from.first, 1000);
      ASSERT_TRUE(changes);
      EXPECT_EQ(changes->first, to.first);
      EXPECT_EQ(after(from.second, changes->second), to.second) << number << " to " << other;
    }
  }
  // Too many, and a revision that this catalogue does not have.
  Revision first = known.begin()->second.first;
  EXPECT_FALSE(store.ChangesTo({}, first, 2));
  EXPECT_FALSE(store.ChangesTo(99, first, 1000));
  first.hash[0] = first.hash[0] == '0' ? '1' : '0';
  EXPECT_FALSE(store.ChangesTo({}, first, 1000));
}

TEST_P(History, ARevisionIsReadInPages) {
  Store store = Write();
  store.Import(EachOf({Reservoir("a"), Reservoir("b"), Reservoir("c")}), {});
  const Revision revision = store.Head();
  const auto all = store.Changes(revision);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_THAT(store.Changes(revision, "", 2), ElementsAre(all[0], all[1]));
  EXPECT_THAT(store.Changes(revision, "b", 2), ElementsAre(all[2]));
  EXPECT_THAT(store.Changes(revision, "c", 2), IsEmpty());
}

TEST_P(History, UndoRefusesToOverwriteALaterChange) {
  Store store = Write();
  store.Import(EachOf({Reservoir("a"), Reservoir("b")}), {});
  const std::int64_t imported = store.Head().number;
  Part changed = Reservoir("b");
  changed.notes = "mine";
  store.Replace(changed);
  const auto before = store.List();
  const WriteResult undone = store.Undo(imported, {});
  EXPECT_EQ(undone.status, WriteStatus::kSuperseded);
  ASSERT_EQ(undone.errors.size(), 1u);
  EXPECT_THAT(undone.errors[0].detail, HasSubstr("b was changed since"));
  EXPECT_EQ(store.List(), before);
}

TEST_P(History, AWriteWithAKeyActsOnceAlsoAfterReopening) {
  const Signature by{"ann", "key-1", "digest"};
  const WriteResult first = Write().Add(Reservoir("r"), by);
  EXPECT_EQ(first.status, WriteStatus::kDone);
  Write().Remove("r");
  Store store = Write();
  const WriteResult again = store.Add(Reservoir("r"), by);
  EXPECT_EQ(again.status, WriteStatus::kRepeated);
  EXPECT_EQ(again.revision, first.revision);
  EXPECT_EQ(store.GetAt("r", again.revision.number), Reservoir("r"));
  EXPECT_EQ(store.Get("r"), std::nullopt);
  EXPECT_EQ(store.Add(Reservoir("s"), {"ann", "key-1", "other"}).status, WriteStatus::kKeyReused);
  EXPECT_EQ(store.Add(Reservoir("s"), {"ann", "key-2", "other"}).status, WriteStatus::kDone);
}

TEST_P(History, ARefusedWriteLeavesItsKeyFree) {
  Store store = Write();
  store.Add(Reservoir("r"));
  const Signature by{"ann", "key", "digest"};
  EXPECT_EQ(store.Add(Reservoir("r"), by).status, WriteStatus::kExists);
  store.Remove("r");
  EXPECT_EQ(store.Add(Reservoir("r"), by).status, WriteStatus::kDone);
}

TEST_P(History, ARepeatedImportAnswersAsTheFirstDid) {
  Store store = Write();
  store.Add(Reservoir("old"));
  Part same = Reservoir("same");
  store.Add(same);
  Part replaced = Reservoir("old");
  replaced.notes = "imported";
  const std::vector<Part> parts{Reservoir("new"), replaced, same};
  const Signature by{"ann", "key", "digest"};
  const ImportResult first = store.Import(EachOf(parts), by);
  EXPECT_THAT(first.plan.added, ElementsAre("new"));
  EXPECT_THAT(first.plan.replaced, ElementsAre("old"));
  EXPECT_THAT(first.plan.unchanged, ElementsAre("same"));
  store.Remove("new");
  const auto now = store.List();
  const ImportResult again = store.Import(EachOf(parts), by);
  EXPECT_EQ(again.write.status, WriteStatus::kRepeated);
  EXPECT_EQ(again.write.revision, first.write.revision);
  EXPECT_THAT(again.plan.added, ElementsAre("new"));
  EXPECT_THAT(again.plan.replaced, ElementsAre("old"));
  EXPECT_THAT(again.plan.unchanged, ElementsAre("same"));
  EXPECT_EQ(store.List(), now);
}

TEST_P(History, ImportIsAllOrNothing) {
  Store store = Write();
  std::mt19937 random(41);
  store.Add(AnyPart(*FindFamily("valve"), "v", random));
  const Revision before = store.Head();
  const ImportResult taken = store.Import(EachOf({Reservoir("a"), Reservoir("v")}), {});
  EXPECT_EQ(taken.write.status, WriteStatus::kExists);
  EXPECT_THAT(taken.plan.taken, ElementsAre("v"));
  Part bad = Reservoir("b");
  bad.numbers.clear();
  EXPECT_EQ(store.Import(EachOf({Reservoir("a"), bad}), {}).write.status, WriteStatus::kInvalid);
  Part twin = Reservoir("a");
  twin.notes = "another";
  EXPECT_THROW(store.Import(EachOf({Reservoir("a"), twin}), {}), StoreError);
  EXPECT_EQ(store.Head(), before);
  EXPECT_EQ(store.Get("a"), std::nullopt);
}

TEST_P(History, APreconditionSeesThePartThatIsStored) {
  Store store = Write();
  store.Add(Reservoir("r"));
  Part other = Reservoir("r");
  other.notes = "other";
  const auto never = [](const Part&) { return false; };
  const auto if_plain = [](const Part& stored) { return stored == Reservoir("r"); };
  EXPECT_EQ(store.Replace(other, {}, never).status, WriteStatus::kChanged);
  EXPECT_EQ(store.Remove("r", {}, never).status, WriteStatus::kChanged);
  EXPECT_EQ(store.Replace(other, {}, if_plain).status, WriteStatus::kDone);
  EXPECT_EQ(store.Remove("r", {}, if_plain).status, WriteStatus::kChanged);
  EXPECT_EQ(store.Get("r"), other);
}

TEST_P(History, SqlItselfKeepsHistoryFromBeingChanged) {
  Write().Add(Reservoir("r"));
  for (const char* sql : {"DELETE FROM change", "UPDATE change SET before = 'x'",
                          "DELETE FROM revision", "UPDATE revision SET who = 'x'"})
    EXPECT_THROW(Sql(sql), SqlError) << sql;
}

TEST_P(History, CheckFindsAForgedPast) {
  {
    Store store = Write();
    store.Add(Reservoir("r"));
    Part other = Reservoir("r");
    other.notes = "other";
    store.Replace(other);
    ASSERT_THAT(store.Check(), IsEmpty());
  }
  Sql(std::string("DROP TRIGGER change_is_not_changed") + (OnServer() ? " ON change;" : ";") +
      "UPDATE change SET before = replace(before, 'Maker', 'Faker') WHERE before IS NOT NULL");
  EXPECT_THAT(Read().Check(), Contains(HasSubstr("revision 1: its hash does not agree")));
}

TEST_P(History, ReplacingTheSeedRecordsOnlyWhatChanged) {
  Store store = Write();
  store.ReplaceSeed({Reservoir("a"), Reservoir("b"), Reservoir("c")});
  const Revision first = store.Head();
  EXPECT_EQ(store.Changes(first).size(), 3u);
  store.ReplaceSeed({Reservoir("a"), Reservoir("b"), Reservoir("c")});
  EXPECT_EQ(store.Head(), first);
  Part b = Reservoir("b");
  b.notes = "measured";
  store.ReplaceSeed({Reservoir("a"), b});
  EXPECT_EQ(store.Changes(store.Head()).size(), 2u);
  EXPECT_EQ(store.ListAt(first.number).size(), 3u);
}

PLENUM_ON_EACH_STORE(History);

}  // namespace history_test
}  // namespace plenum::catalog
