#include "catalog/store/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "catalog/fields/csv.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class StoreTest : public ::testing::Test {
 protected:
  StoreTest() {
    std::string name = (fs::temp_directory_path() / "plenum_store_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "catalog.db";
  }
  ~StoreTest() override {
    fs::permissions(folder_, fs::perms::owner_all);
    fs::remove_all(folder_);
  }

  Store Write() { return Store(path_, Access::kWrite); }
  Store Read() { return Store(path_, Access::kRead); }

  // Runs SQL past the store, as another program would.
  void Sql(const std::string& sql) {
    SQLite::Database db(path_.string(), SQLite::OPEN_READWRITE);
    db.exec("PRAGMA foreign_keys = ON");
    db.exec(sql);
  }

  std::string RefusalToOpen(Access access) {
    try {
      Store store(path_, access);
      return "";
    } catch (const StoreError& error) {
      return error.what();
    }
  }

  fs::path folder_, path_;
};

TEST_F(StoreTest, KeepsRandomPartsExactly) {
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

TEST_F(StoreTest, AnExportImportedElsewhereIsExportedByteForByte) {
  std::mt19937 random(19);
  Store store = Write();
  for (const Family& family : Families())
    for (int i = 0; i < 30; ++i)
      store.Add(AnyPart(family, std::string(family.name) + std::to_string(i), random));
  Store other(folder_ / "other.db", Access::kWrite);
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

TEST_F(StoreTest, AddReplaceAndRemoveSayWhatHappened) {
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

TEST_F(StoreTest, RefusesInvalidPartsAndKeepsWhatWas) {
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

TEST_F(StoreTest, TheHeadCountsCommittedWritesOfAnyConnection) {
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

TEST_F(StoreTest, ReplaceSeedLeavesRowsOfUsers) {
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

TEST_F(StoreTest, ReplaceSeedIsAllOrNothing) {
  Store store = Write();
  store.ReplaceSeed({Reservoir("a")});
  const auto before = store.List();
  Part bad = Reservoir("b");
  bad.numbers.clear();
  EXPECT_THROW(store.ReplaceSeed({Reservoir("c"), bad}), StoreError);
  EXPECT_THROW(store.ReplaceSeed({Reservoir("c"), Reservoir("c")}), StoreError);
  EXPECT_EQ(store.List(), before);
}

TEST_F(StoreTest, SqlItselfRefusesWhatIsNotANumberInRange) {
  Write().Add(Reservoir("r"));
  const auto set = [](const std::string& value) {
    return "UPDATE number SET value = " + value + " WHERE field = 'mass_kg'";
  };
  EXPECT_NO_THROW(Sql(set("0.5")));
  for (const char* bad : {"9e999", "-9e999", "9e999 - 9e999", "NULL", "-1e7", "'heavy'", "1e7"})
    EXPECT_THROW(Sql(set(bad)), SQLite::Exception) << bad;
  EXPECT_THROW(Sql("UPDATE number SET provenance = 'guess'"), SQLite::Exception);
  for (const char* bad : {"0", "-0.1", "1.5", "9e999"})
    EXPECT_THROW(Sql(std::string("UPDATE number SET uncertainty = ") + bad), SQLite::Exception)
        << bad;
  EXPECT_NO_THROW(Sql("UPDATE number SET uncertainty = 0.05, provenance = 'measured'"));
  EXPECT_THROW(Sql("UPDATE part SET orderable = 2"), SQLite::Exception);
  EXPECT_THROW(Sql("INSERT INTO offer VALUES ('r', 0, 'Shop', 1, 'euro', 1, '', '')"),
               SQLite::Exception);
  EXPECT_THROW(Sql("INSERT INTO document VALUES ('r', 0, '', 'abc')"), SQLite::Exception);
  EXPECT_THROW(Sql("UPDATE part SET origin = 'me'"), SQLite::Exception);
  EXPECT_THROW(Sql("UPDATE part SET id = 'custom'"), SQLite::Exception);
  EXPECT_THROW(Sql("UPDATE part SET id = 'A b'"), SQLite::Exception);
  EXPECT_THROW(Sql("INSERT INTO curve_point VALUES ('r', 0, 9e999, 1)"), SQLite::Exception);
}

TEST_F(StoreTest, ForeignKeysHold) {
  std::mt19937 random(2);
  Store store = Write();
  Part pump = AnyPart(*FindFamily("compressor"), "c", random);
  pump.aliases = {"d"};
  pump.offers = {{"Shop", 1.0, "EUR", 1.0, "", ""}};
  pump.documents = {{"sheet", ""}};
  store.Add(pump);
  EXPECT_THROW(Sql("INSERT INTO number VALUES ('nobody', 'mass_kg', 1, 'derived', '', NULL)"),
               SQLite::Exception);
  store.Remove("c");
  SQLite::Database db(path_.string());
  for (const char* table : {"number", "text", "curve", "curve_point", "alias", "offer", "document"})
    EXPECT_EQ(db.execAndGet(std::string("SELECT count(*) FROM ") + table).getInt(), 0) << table;
}

TEST_F(StoreTest, CheckFindsRowsThatWereChangedBehindItsBack) {
  Store store = Write();
  store.Add(Reservoir("r"));
  EXPECT_THAT(store.Check(), ElementsAre());
  Sql("UPDATE number SET value = 900 WHERE field = 'mass_kg'");
  EXPECT_THAT(store.Check(), ElementsAre(HasSubstr("r, mass_kg: must be between"),
                                         HasSubstr("revision 1: its hash does not agree")));
  Sql("PRAGMA foreign_keys = OFF; DELETE FROM part");
  EXPECT_THAT(store.Check(), ::testing::Contains(HasSubstr("belongs to no part")));
}

TEST_F(StoreTest, MigratesFromNothingAndRecordsIt) {
  Write();
  Write();
  SQLite::Database db(path_.string());
  EXPECT_EQ(db.execAndGet("PRAGMA user_version").getInt(), 4);
  EXPECT_EQ(db.execAndGet("SELECT group_concat(name) FROM migration").getString(),
            "0001_parts,0002_history,0003_models,0004_series_and_offers");
  EXPECT_EQ(db.execAndGet("SELECT min(unixepoch(applied)) > 1.7e9 FROM migration").getInt(), 1);
  EXPECT_EQ(db.execAndGet("SELECT count(*) FROM pragma_table_list WHERE schema = 'main' AND "
                          "type = 'table' AND name NOT LIKE 'sqlite%' AND NOT strict")
                .getInt(),
            0);
}

TEST_F(StoreTest, RefusesANewerSchema) {
  Write();
  Sql("PRAGMA user_version = 99");
  EXPECT_THAT(RefusalToOpen(Access::kRead), HasSubstr("has schema 99"));
  EXPECT_THAT(RefusalToOpen(Access::kWrite), HasSubstr("use a newer program"));
}

TEST_F(StoreTest, RefusesMissingEmptyAndForeignFiles) {
  EXPECT_THAT(RefusalToOpen(Access::kRead), HasSubstr("catalog.db: cannot be opened for reading"));
  EXPECT_FALSE(fs::exists(path_));
  std::ofstream(path_).close();
  EXPECT_THAT(RefusalToOpen(Access::kRead), HasSubstr("older schema"));
  Sql("CREATE TABLE other (x)");
  EXPECT_THAT(RefusalToOpen(Access::kWrite), HasSubstr("not a catalogue"));
  std::ofstream(path_) << std::string(5000, 'x');
  EXPECT_THAT(RefusalToOpen(Access::kRead), HasSubstr("not a database"));
  path_ = folder_ / "missing" / "catalog.db";
  EXPECT_THAT(RefusalToOpen(Access::kWrite), HasSubstr("cannot be opened for writing"));
}

TEST_F(StoreTest, NeedsNoOtherFileToRead) {
  Write().Add(Reservoir("r"));
  EXPECT_THAT(std::distance(fs::directory_iterator(folder_), {}), 1);
  fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec);
  fs::permissions(path_, fs::perms::owner_read);
  EXPECT_EQ(Read().List().size(), 1u);
}

// A child adds parts and reports each acknowledged one through a pipe until it is killed.
[[noreturn]] void AddUntilKilled(const fs::path& path, int pipe, int round) {
  Store store(path, Access::kWrite);
  for (int i = 0;; ++i) {
    const std::string id = "k" + std::to_string(round) + "-" + std::to_string(i);
    if (store.Add(Reservoir(id)).status != WriteStatus::kDone) _exit(1);
    const std::string line = id + "\n";
    if (write(pipe, line.data(), line.size()) < 0) _exit(1);
  }
}

TEST_F(StoreTest, LosesNothingAcknowledgedWhenKilled) {
  constexpr int kRounds = 24;
  Write();
  std::mt19937 random(23);
  std::size_t acknowledged = 0;
  for (int round = 0; round < kRounds; ++round) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    ASSERT_GE(child, 0);
    if (child == 0) AddUntilKilled(path_, ends[1], round);
    close(ends[1]);
    // Let it get going, then kill at a random moment.
    std::string reported(1, ' ');
    ASSERT_EQ(read(ends[0], reported.data(), 1), 1);
    usleep(std::uniform_int_distribution<useconds_t>(0, 30'000)(random));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "the writer failed before it was killed";
    char buffer[4096];
    for (ssize_t n; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
      reported.append(buffer, static_cast<std::size_t>(n));
    close(ends[0]);

    const Store store = Read();  // must also recover from the writer's death
    EXPECT_THAT(store.Check(), ElementsAre());
    std::istringstream lines(reported);
    for (std::string id; std::getline(lines, id); ++acknowledged)
      EXPECT_EQ(store.Get(id), Reservoir(id)) << id;
  }
  EXPECT_GE(acknowledged, static_cast<std::size_t>(kRounds));
}

TEST_F(StoreTest, OpeningForReadingRollsBackADeadWriter) {
  Write().Add(Reservoir("r"));
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    // A tiny cache spills the open transaction into the file, so that a hot journal stays.
    SQLite::Database db(path_.string(), SQLite::OPEN_READWRITE);
    db.exec("PRAGMA cache_size = 1; PRAGMA cache_spill = 1; BEGIN IMMEDIATE");
    for (int i = 0; i < 2000; ++i)
      db.exec("INSERT INTO part VALUES ('half" + std::to_string(i) +
              "', 'reservoir', 'm', 'p', 'user', hex(randomblob(100)), '', NULL)");
    raise(SIGKILL);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  ASSERT_TRUE(fs::exists(path_.string() + "-journal"));
  const Store store = Read();
  EXPECT_THAT(store.List(), ElementsAre(Reservoir("r")));
  EXPECT_THAT(store.Check(), ElementsAre());
}

}  // namespace
}  // namespace plenum::catalog
