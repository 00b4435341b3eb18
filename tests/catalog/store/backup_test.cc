#include "catalog/store/backup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <thread>

#include "tests/catalog/folder.h"
#include "tests/catalog/samples.h"
#include "tests/support/places.h"

namespace plenum::catalog {
namespace backup_test {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

class Backups : public InFolder {
 protected:
  fs::path copy_ = folder_ / "copy.db";

  // Everything that is not the catalogue or the copy.
  int StrayFiles() const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder_))
      count += entry.path() != path_ && entry.path() != copy_;
    return count;
  }
};

TEST_F(Backups, ACopyHoldsPartsAndHistoryAndComesBack) {
  Store store = Write();
  store.Add(Reservoir("a"));
  store.Add(Reservoir("b"));
  store.Remove("a");
  Backup(path_, copy_);
  const auto then = store.List();
  const Revision head = store.Head();
  EXPECT_EQ(Store(copy_, Access::kRead).List(), then);
  EXPECT_EQ(Store(copy_, Access::kRead).History("a", INT64_MAX, 10),
            store.History("a", INT64_MAX, 10));

  store.Add(Reservoir("c"));
  Restore(path_, copy_);
  EXPECT_EQ(store.List(), then);  // also through a connection that was open all along
  EXPECT_EQ(store.Head(), head);
  EXPECT_THAT(store.Check(), IsEmpty());
  EXPECT_EQ(store.Add(Reservoir("d")).status, WriteStatus::kDone);
  EXPECT_EQ(StrayFiles(), 0);
}

TEST_F(Backups, IsOfOneMomentWhileTheCatalogueIsWritten) {
  Write().Add(Reservoir("r"));
  std::atomic<int> writes = 0;
  std::jthread writer([&](const std::stop_token& stop) {
    Store store = Write();
    for (; !stop.stop_requested(); ++writes)
      store.Import(EachOf({Reservoir("a" + std::to_string(writes)),
                           Reservoir("b" + std::to_string(writes))}),
                   {});
  });
  for (int i = 0; i < 8; ++i) {
    while (writes < 3 * i) std::this_thread::yield();
    Backup(path_, copy_);
    const Store store(copy_, Access::kRead);
    EXPECT_THAT(store.Check(), IsEmpty());
    EXPECT_EQ(store.List().size() % 2, 1u);  // never half of an import
  }
  writer.request_stop();
  writer.join();
  EXPECT_EQ(StrayFiles(), 0);
}

TEST_F(Backups, RefusesADamagedCopyWithoutHarm) {
  std::mt19937 random(43);
  {
    Store store = Write();
    for (int i = 0; i < 60; ++i)
      store.Add(AnyPart(Families()[i % 9], "p" + std::to_string(i), random));
  }
  Backup(path_, copy_);
  Write().Add(Reservoir("later"));
  const std::string good = Bytes(copy_), before = Bytes(path_);
  int refused = 0;
  for (int i = 0; i < 120; ++i) {
    std::string bad = good;
    switch (i % 3) {
      case 0:  // cut short
        bad.resize(random() % bad.size());
        break;
      case 1:  // a page of noise
        for (std::size_t at = random() % (bad.size() / 4096) * 4096, n = 0; n < 4096; ++n)
          bad[at + n] = static_cast<char>(random());
        break;
      default:  // one flipped bit
        bad[random() % bad.size()] ^= static_cast<char>(1 << random() % 8);
    }
    std::ofstream(copy_, std::ios::binary) << bad;
    const std::string error = Refusal([&] { Restore(path_, copy_); });
    if (error.empty()) {
      // A flip where nothing is stored: what came back is what was copied.
      EXPECT_EQ(i % 3, 2) << "damage of a whole page or more went unseen";
      EXPECT_EQ(Read().List().size(), 60u);
      std::ofstream(path_, std::ios::binary) << before;
    } else {
      ++refused;
      EXPECT_THAT(error, HasSubstr("copy.db"));
      ASSERT_EQ(Bytes(path_), before) << error;
    }
    ASSERT_EQ(StrayFiles(), 0);
  }
  EXPECT_GE(refused, 80);
}

TEST_F(Backups, RefusesForeignEmptyNewerAndMissingFiles) {
  Write().Add(Reservoir("r"));
  const std::string before = Bytes(path_);
  const auto refusal = [&] { return Refusal([&] { Restore(path_, copy_); }); };
  EXPECT_THAT(refusal(), HasSubstr("copy.db: cannot be read"));
  std::ofstream(copy_).close();
  EXPECT_THAT(refusal(), HasSubstr("is empty"));
  std::ofstream(copy_) << "not a database, but long enough to be taken for something";
  EXPECT_THAT(refusal(), HasSubstr("not a database"));
  fs::remove(copy_);
  SQLite::Database(copy_.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE other (x)");
  EXPECT_THAT(refusal(), HasSubstr("copy.db is not a catalogue"));
  EXPECT_THAT(Refusal([&] { Restore(copy_, path_); }), HasSubstr("copy.db is not a catalogue"));
  fs::remove(copy_);
  Backup(path_, copy_);
  SQLite::Database(copy_.string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  EXPECT_THAT(refusal(), HasSubstr("has schema 99"));
  EXPECT_THAT(Refusal([&] { Restore(path_, path_); }), HasSubstr("is the catalogue itself"));
  EXPECT_THAT(Refusal([&] { Backup(path_, path_); }), HasSubstr("is the catalogue itself"));
  EXPECT_THAT(Refusal([&] { Backup(path_, folder_ / "missing" / "copy.db"); }),
              HasSubstr("cannot be created"));
  EXPECT_EQ(Bytes(path_), before);
  EXPECT_EQ(StrayFiles(), 0);
}

TEST_F(Backups, TakesACopyOfAnOlderSchema) {
  path_.swap(copy_);
  Sql(Bytes(test::SourceDir() / "tests/catalog/schema_1.sql"));
  path_.swap(copy_);
  const std::string old = Bytes(copy_);
  Restore(path_, copy_);
  EXPECT_EQ(Read().List().size(), 4u);
  EXPECT_EQ(Bytes(copy_), old);
}

TEST_F(Backups, MendsADamagedCatalogue) {
  Write().Add(Reservoir("r"));
  Backup(path_, copy_);
  std::string bad = Bytes(path_);
  for (std::size_t at = 4096; at < bad.size(); ++at) bad[at] = 'x';
  std::ofstream(path_, std::ios::binary) << bad;
  Restore(path_, copy_);
  EXPECT_EQ(Read().Get("r"), Reservoir("r"));
  EXPECT_THAT(Read().Check(), IsEmpty());
}

}  // namespace backup_test
}  // namespace plenum::catalog
