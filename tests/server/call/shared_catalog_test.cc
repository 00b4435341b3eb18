// Reading while a write that takes long is under way.
#include "server/call/shared_catalog.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <future>
#include <thread>

#include "api/catalogue/part_document.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace shared_catalog_test {

using std::chrono::seconds;

catalog::Part PartOf(const std::string& id) {
  return std::get<catalog::Part>(api::ParsePart(NewFitting(id)));
}

// In the middle of a long write that has added a part: `during` runs on another thread.
template <typename F>
void InTheMiddle(SharedCatalog& catalog, F during, const std::string& id = "new") {
  std::promise<void> begun, looked;
  auto write = std::async(std::launch::async, [&] {
    return catalog.WithLong([&](catalog::Store& store) {
      const auto written = store.Add(PartOf(id));
      begun.set_value();
      looked.get_future().wait();
      return written.status;
    });
  });
  begun.get_future().wait();
  during();
  looked.set_value();
  EXPECT_EQ(write.get(), catalog::WriteStatus::kDone);
}

bool Has(const Parts& parts, const std::string& id) {
  return std::any_of(parts->begin(), parts->end(),
                     [&](const catalog::Part& part) { return part.id == id; });
}

TEST(SharedCatalog, ReadersGoOnDuringALongWrite) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  catalog.With([](catalog::Store& store) { return store.Add(PartOf("old")); });
  const auto before = catalog.Head();
  EXPECT_FALSE(catalog.ViewMeanwhile());
  InTheMiddle(catalog, [&] {
    EXPECT_EQ(catalog.Head(), before);
    EXPECT_EQ(catalog.View().revision, before);
    EXPECT_TRUE(Has(catalog.Snapshot(), "old"));
    EXPECT_FALSE(Has(catalog.Snapshot(), "new"));
    EXPECT_TRUE(catalog.ViewAt(before.number));
    EXPECT_TRUE(catalog.Models().empty());
    ASSERT_TRUE(catalog.ViewMeanwhile());
    EXPECT_EQ(catalog.ViewMeanwhile()->revision, before);
  });
  EXPECT_FALSE(catalog.ViewMeanwhile());
  EXPECT_EQ(catalog.Head().number, before.number + 1);
  EXPECT_TRUE(Has(catalog.Snapshot(), "new"));
}

TEST(SharedCatalog, OthersWaitForTheirTurnALimitedTime) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto busy = [&](seconds patience) {
    try {
      catalog.With([](const catalog::Store& store) { return store.Head(); }, patience);
    } catch (const catalog::StoreError& error) {
      return error.fault() == catalog::StoreFault::kBusy;
    }
    return false;
  };
  InTheMiddle(catalog, [&] { EXPECT_TRUE(busy(seconds(0))); });
  EXPECT_FALSE(busy(seconds(0)));

  // Many of them wait, more are refused at once.
  std::vector<std::future<bool>> waiting;
  InTheMiddle(
      catalog,
      [&] {
        for (int i = 0; i < kCatalogueWaitingMax + 4; ++i)
          waiting.push_back(std::async(std::launch::async, [&] { return busy(seconds(600)); }));
        const auto refused = [&] {
          return std::count_if(waiting.begin(), waiting.end(), [](const auto& one) {
            return one.wait_for(seconds(0)) == std::future_status::ready;
          });
        };
        while (refused() < 5) std::this_thread::yield();  // the writer holds a place, too
      },
      "another");
  EXPECT_EQ(std::count_if(waiting.begin(), waiting.end(), [](auto& one) { return one.get(); }), 5);
}

TEST(SharedCatalog, AWriteThatFailsLeavesWhatWas) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto before = catalog.Head();
  EXPECT_THROW(catalog.WithLong([](catalog::Store&) -> int { throw std::bad_alloc(); }),
               std::bad_alloc);
  EXPECT_FALSE(catalog.ViewMeanwhile());
  EXPECT_EQ(catalog.Head(), before);
}

// Another process that keeps the file to itself, as a large import does.
class OtherProcess {
 public:
  explicit OtherProcess(const std::string& catalog) {
    const std::string command = "python3 -c \"import sqlite3,sys; db=sqlite3.connect('" + catalog +
                                "',isolation_level=None); db.execute('BEGIN EXCLUSIVE'); open('" +
                                catalog + ".held','w').close(); sys.stdin.read()\"";
    pipe_ = popen(command.c_str(), "w");
    while (!std::filesystem::exists(catalog + ".held"))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ~OtherProcess() { pclose(pipe_); }
  OtherProcess(const OtherProcess&) = delete;

 private:
  FILE* pipe_;
};

TEST(SharedCatalog, WhoKeepsTheFileHoldsUpNoReader) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto before = catalog.View().revision;
  {
    const OtherProcess other(bench.catalog());
    std::filesystem::last_write_time(bench.catalog(),
                                     std::filesystem::file_time_type::clock::now());
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 50; ++i) {
      EXPECT_EQ(catalog.View().revision, before);
      EXPECT_EQ(catalog.Head(), before);
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(2));
    // A write is told at once that it must be tried again.
    EXPECT_THROW(catalog.With([](catalog::Store& store) { return store.Add(PartOf("x")); }),
                 catalog::StoreError);
    EXPECT_LT(std::chrono::steady_clock::now() - start, seconds(4));
    EXPECT_EQ(catalog.Check(), FileCheck::kBusy);
  }
  EXPECT_EQ(catalog.Check(), FileCheck::kSound);
  EXPECT_EQ(catalog.With([](catalog::Store& store) { return store.Add(PartOf("x")); }).status,
            catalog::WriteStatus::kDone);
}

TEST(SharedCatalog, WhoWaitsToWriteHoldsUpNoReader) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto before = catalog.View().revision;
  std::vector<std::future<void>> writers;
  {
    const OtherProcess other(bench.catalog());
    std::atomic<bool> over = false;
    for (int i = 0; i < 12; ++i)
      writers.push_back(std::async(std::launch::async, [&] {
        while (!over)
          EXPECT_THROW(catalog.With([](catalog::Store& store) { return store.Get("none"); }),
                       catalog::StoreError);
      }));
    for (int i = 0; i < 40; ++i) {
      EXPECT_EQ(catalog.View().revision, before);  // throws after kTurnPatience
      EXPECT_TRUE(catalog.ViewMeanwhile() || catalog.Head() == before);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    over = true;
    for (auto& writer : writers) writer.get();
  }
}

// What this service wrote is never missing from what it gives later.
TEST(SharedCatalog, OwnWritesAreSeenOrWaitedFor) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  catalog.View();
  catalog.With([](catalog::Store& store) { return store.Add(PartOf("own")); });
  {
    const OtherProcess other(bench.catalog());
    EXPECT_THROW(catalog.View(), catalog::StoreError);
  }
  EXPECT_TRUE(Has(catalog.Snapshot(), "own"));
}

// What a write left alone is the same in memory before and after, whoever wrote; and in an older
// revision.
TEST(SharedCatalog, TheViewFollowsChanges) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto before = catalog.View();
  catalog.With([](catalog::Store& store) { return store.Add(PartOf("0-own")); });
  catalog::Store other(bench.catalog(), catalog::Access::kWrite);
  const std::string gone = before.rows()[7].id;
  other.Remove(gone);
  const auto after = catalog.View();
  ASSERT_EQ(after.rows().size(), before.rows().size());
  EXPECT_EQ(after.rows().Find(gone), nullptr);
  EXPECT_EQ(after.rows()[0].id, "0-own");
  EXPECT_EQ(&after.rows()[1], &before.rows()[0]);
  EXPECT_EQ(&after.rows()[20], &before.rows()[20]);
  EXPECT_EQ(*after.parts(), other.List());
  EXPECT_EQ(before.rows().Find("0-own"), nullptr);  // who holds a view keeps what it shows
  const auto past = catalog.ViewAt(before.revision.number);
  EXPECT_EQ(&past->rows()[20], &before.rows()[20]);
  EXPECT_EQ(*past->parts(), *before.parts());
}

TEST(SharedCatalog, ARestoredCatalogueIsReadAnew) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto start = catalog.View().revision;
  catalog.With([](catalog::Store& store) { return store.Add(PartOf("mine")); });
  EXPECT_TRUE(Has(catalog.Snapshot(), "mine"));
  // The same number then stands for other parts.
  const std::filesystem::path elsewhere = bench.Path("other.db");
  std::filesystem::copy_file(bench.catalog(), elsewhere);
  {
    catalog::Store store(elsewhere, catalog::Access::kWrite);
    store.Undo(start.number + 1, {});
    store.Add(PartOf("yours"));
  }
  catalog::Restore(bench.catalog(), elsewhere);
  EXPECT_TRUE(Has(catalog.Snapshot(), "yours"));
  EXPECT_FALSE(Has(catalog.Snapshot(), "mine"));
}

TEST(SharedCatalog, PastRevisionsStayInMemory) {
  const Workbench bench;
  SharedCatalog catalog(bench.catalog());
  const auto first = catalog.View().revision;
  catalog.With([](catalog::Store& store) { return store.Add(PartOf("new")); });
  const auto past = catalog.ViewAt(first.number);
  ASSERT_TRUE(past);
  EXPECT_FALSE(Has(past->parts(), "new"));
  EXPECT_EQ(catalog.ViewAt(first.number)->parts(), past->parts());  // the same, not equal ones
  EXPECT_FALSE(catalog.ViewAt(first.number + 9));
}

}  // namespace shared_catalog_test
}  // namespace plenum::server
