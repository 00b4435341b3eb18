// Reading while a write that takes long is under way.
#include "server/call/shared_catalog.h"

#include <gtest/gtest.h>

#include <future>

#include "api/catalogue/part_document.h"
#include "tests/server/workbench.h"

namespace plenum::server {
namespace {

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
  EXPECT_FALSE(catalog.ViewBeforeWrite());
  InTheMiddle(catalog, [&] {
    EXPECT_EQ(catalog.Head(), before);
    EXPECT_EQ(catalog.View().revision, before);
    EXPECT_TRUE(Has(catalog.Snapshot(), "old"));
    EXPECT_FALSE(Has(catalog.Snapshot(), "new"));
    EXPECT_TRUE(catalog.ViewAt(before.number));
    EXPECT_TRUE(catalog.Models().empty());
    ASSERT_TRUE(catalog.ViewBeforeWrite());
    EXPECT_EQ(catalog.ViewBeforeWrite()->revision, before);
  });
  EXPECT_FALSE(catalog.ViewBeforeWrite());
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
  EXPECT_FALSE(catalog.ViewBeforeWrite());
  EXPECT_EQ(catalog.Head(), before);
}

}  // namespace
}  // namespace plenum::server
