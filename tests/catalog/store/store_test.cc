#include "catalog/store/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <random>
#include <sstream>

#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace store_test {

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
  EXPECT_EQ(db.execAndGet("PRAGMA user_version").getInt(), 5);
  EXPECT_EQ(db.execAndGet("SELECT group_concat(name) FROM migration").getString(),
            "0001_parts,0002_history,0003_models,0004_series_and_offers,0005_files");
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

}  // namespace store_test
}  // namespace plenum::catalog
