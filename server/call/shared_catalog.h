// The service's one read-write connection to catalog.db, shared by its threads. They take turns,
// and wait for theirs a limited time. A write that may take seconds lets the others go on reading
// what it found: the newest revision and the saved models are in memory meanwhile. Only what needs
// the file itself (history, older revisions) and other writes wait for its end.
#ifndef PLENUM_SERVER_CALL_SHARED_CATALOG_H_
#define PLENUM_SERVER_CALL_SHARED_CATALOG_H_

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "api/catalogue/part_table.h"
#include "api/catalogue/stores.h"
#include "api/json/request_limits.h"
#include "api/measure/model_document.h"
#include "server/call/reply_cache.h"
#include "server/call/service_limits.h"

namespace plenum::server {

using Parts = std::shared_ptr<const std::vector<catalog::Part>>;

// All parts of one revision.
struct CatalogView {
  CatalogView() = default;
  CatalogView(catalog::Revision of, std::vector<catalog::Part> all);

  catalog::Revision revision;
  Parts parts;
  std::shared_ptr<const api::PartTable> table;  // of the parts
};

class SharedCatalog {
 public:
  explicit SharedCatalog(const std::filesystem::path& path);

  // All of these throw StoreError (kBusy) where the turn does not come in time.

  // The newest revision. The database is asked only when its file was written since.
  catalog::Revision Head();
  // The parts as they are now; the same vector until something, in any process, writes.
  CatalogView View();
  Parts Snapshot() { return View().parts; }
  // The newest of each saved model.
  std::vector<catalog::ModelRevision> Models();
  // What a long write found, while it is under way.
  std::optional<CatalogView> ViewBeforeWrite() const;
  // The parts as they were in a revision; none if there is no such revision.
  std::optional<CatalogView> ViewAt(std::int64_t revision);

  // Answers made of the newest revision.
  ReplyCache& replies() { return replies_; }

  // Runs `f(store)` while no other thread of this process uses the store.
  template <typename F>
  auto With(F&& f, std::chrono::seconds patience = std::chrono::seconds(kCatalogueWaitSeconds)) {
    const auto turn = AwaitTurn(patience);
    return f(store_);
  }
  // The same for a write that may take seconds.
  template <typename F>
  auto WithLong(F&& f) {
    const auto turn = AwaitTurn(std::chrono::seconds(kCatalogueWaitSeconds));
    const Publication published(*this);
    auto result = f(store_);
    RefreshView();  // before the others come back
    return result;
  }

 private:
  struct Turn {
    std::shared_ptr<void> place;  // among those that wait
    std::unique_lock<std::timed_mutex> lock;
  };
  struct Published {
    CatalogView view;
    std::vector<catalog::ModelRevision> models;
  };
  class Publication {
   public:
    explicit Publication(SharedCatalog& catalog);
    ~Publication();

   private:
    SharedCatalog& catalog_;
  };

  Turn AwaitTurn(std::chrono::seconds patience);
  std::shared_ptr<const Published> WhatIsPublished() const;
  template <typename Ask, typename Look>
  auto AskOrLook(Ask ask, Look look);
  const CatalogView& RefreshView();

  std::timed_mutex mutex_;  // of the store and of what was read from it
  Turnstile waiting_{kCatalogueWaitingMax};
  catalog::Store store_;
  CatalogView view_;
  mutable std::mutex published_mutex_;
  std::shared_ptr<const Published> published_;

  // What the file system says of the catalogue's file.
  struct FileState {
    std::uint64_t inode = 0;
    std::int64_t size = 0, written_ns = 0;
    bool operator==(const FileState&) const = default;
  };
  FileState StateOfFile() const;
  const catalog::Revision& RefreshHead();

  const std::filesystem::path path_;
  FileState head_state_;
  std::optional<catalog::Revision> head_;  // that of head_state_
  ReplyCache replies_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_SHARED_CATALOG_H_
