// The service's one read-write connection to its catalogue, shared by its threads, and one to read
// the past with. Threads take turns, and wait for theirs, and for other processes, a fraction of a
// second: then the call throws StoreError (kBusy), nothing was changed, and whoever asked asks
// again. A write that may take seconds lets the others go on reading what it found: the newest
// revision and the saved models are in memory meanwhile. While another process keeps the file to
// itself, readers get the revision that was read last, unless this service has written since. Only
// what needs the file itself (history, older revisions) and writes wait, and those who wait to
// write hold up no reader.
#ifndef PLENUM_SERVER_CALL_SHARED_CATALOG_H_
#define PLENUM_SERVER_CALL_SHARED_CATALOG_H_

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/request_limits.h"
#include "api/measure/model_document.h"
#include "server/call/past_revisions.h"
#include "server/call/reply_cache.h"
#include "server/call/service_limits.h"

namespace plenum::server {

// What a look at the file itself says of it.
enum class FileCheck {
  kSound,
  kBusy,     // another process writes it
  kFailed,   // it cannot be written, as where it is damaged at its beginning or cut off
  kReplaced  // moved away or replaced by another
};

// For the turn of a call, and of writes for those who read.
inline constexpr std::chrono::milliseconds kTurnPatience{200};
inline constexpr std::chrono::milliseconds kWritePatience{1000}, kLongWritePatience{10'000};

class SharedCatalog {
 public:
  explicit SharedCatalog(const std::filesystem::path& path);

  // All of these throw StoreError (kBusy) where the turn does not come in time.

  // The newest revision. A file is asked only when it was written since.
  catalog::Revision Head();
  // The parts as they are now; the same vector until something, in any process, writes.
  CatalogView View();
  Parts Snapshot() { return View().parts(); }
  // The newest of each saved model.
  std::vector<catalog::ModelRevision> Models();
  // What a long write found, while it is under way, or what was read last, while another process
  // keeps the file.
  std::optional<CatalogView> ViewMeanwhile();
  // The parts as they were in a revision; none if there is no such revision. The last few that were
  // asked for stay in memory.
  std::optional<CatalogView> ViewAt(std::int64_t revision,
                                    std::chrono::milliseconds patience = kTurnPatience);
  // Whether it could be written now.
  FileCheck Check();

  // For what only reads history: a connection of its own.
  PastRevisions& past() { return past_; }

  // Answers made of the newest revision.
  ReplyCache& replies() { return replies_; }

  // Runs `f(store)` while no other thread of this process uses the store.
  template <typename F>
  auto With(F&& f, std::chrono::milliseconds patience = kTurnPatience) {
    const auto place = TakePlace();
    constexpr bool kReads = std::is_invocable_v<F, const catalog::Store&>;
    const auto among_writers = kReads ? std::unique_lock<std::timed_mutex>() : AwaitWriters();
    return Patiently(patience, [&] {
      const auto turn = AwaitTurn();
      if constexpr (kReads) {
        return f(std::as_const(store_));
      } else {
        GlanceAtLock();
        const Writing writing(*this, kWritePatience);
        return f(store_);
      }
    });
  }
  // The same for a write that may take seconds.
  template <typename F>
  auto WithLong(F&& f) {
    const auto place = TakePlace();
    const auto among_writers = AwaitWriters();
    const auto turn = AwaitTurn();
    const Publication published(*this);
    const Writing writing(*this, kLongWritePatience);
    auto result = f(store_);
    RefreshView();  // before the others come back
    return result;
  }

 private:
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

  // While the store is written: what was read before is no longer enough, and a write that was made
  // may wait longer for readers to leave than it costs to make it anew.
  class Writing {
   public:
    Writing(SharedCatalog& catalog, std::chrono::milliseconds patience);
    ~Writing();

   private:
    SharedCatalog& catalog_;
  };

  // Among those that wait.
  std::shared_ptr<void> TakePlace();
  std::unique_lock<std::timed_mutex> AwaitTurn();
  std::unique_lock<std::timed_mutex> AwaitWriters();
  // Throws at once where another process writes: the turn is for readers while a write waits.
  void GlanceAtLock();
  [[noreturn]] static void ThrowBusy();
  // Does it again while the catalogue is busy.
  template <typename F>
  static auto Patiently(std::chrono::milliseconds patience, F&& action) {
    for (const auto until = std::chrono::steady_clock::now() + patience;;) {
      try {
        return action();
      } catch (const catalog::StoreError& error) {
        if (error.fault() != catalog::StoreFault::kBusy ||
            std::chrono::steady_clock::now() >= until)
          throw;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  std::shared_ptr<const Published> WhatIsPublished() const;
  template <typename Ask, typename Look>
  auto AskOrLook(Ask ask, Look look);
  const CatalogView& RefreshView();

  struct Turns {
    std::timed_mutex writers;  // one of them at a time asks for the other
    std::timed_mutex store;    // and what was read from it
  };
  Turns turns_;
  Turnstile waiting_{kCatalogueWaitingMax};
  catalog::Store store_;
  CatalogView view_;
  mutable std::mutex published_mutex_;
  std::shared_ptr<const Published> published_;

  // What the file system says of the catalogue's file.
  struct FileState {
    std::uint64_t inode = 0, device = 0;
    std::int64_t size = 0, written_ns = 0;
    bool operator==(const FileState&) const = default;
  };
  FileState StateOfFile() const;
  const catalog::Revision& RefreshHead();

  const std::filesystem::path path_;
  const bool on_server_;
  FileState head_state_;
  std::optional<catalog::Revision> head_;                 // that of head_state_
  bool has_written_ = false;                              // since the head was read
  std::chrono::steady_clock::time_point ask_again_at_{};  // while others keep the file
  FileState opened_;                                      // as it was then
  PastRevisions past_;
  ReplyCache replies_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_CALL_SHARED_CATALOG_H_
