// The service's one read-write connection to catalog.db, shared by its threads.
#ifndef PLENUM_SERVER_SHARED_CATALOG_H_
#define PLENUM_SERVER_SHARED_CATALOG_H_

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "api/part_table.h"
#include "api/services.h"
#include "server/reply_cache.h"

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

  // The newest revision. The database is asked only when its file was written since.
  catalog::Revision Head();
  // The parts as they are now; the same vector until something, in any process, writes.
  CatalogView View();
  Parts Snapshot() { return View().parts; }
  // The parts as they were in a revision; none if there is no such revision.
  std::optional<CatalogView> ViewAt(std::int64_t revision);

  // Answers made of the newest revision.
  ReplyCache& replies() { return replies_; }

  // Runs `f(store)` while no other thread of this process uses the store.
  template <typename F>
  auto With(F&& f) {
    const std::lock_guard lock(mutex_);
    return f(store_);
  }

 private:
  std::mutex mutex_;
  catalog::Store store_;
  CatalogView view_;

  // What the file system says of the catalogue's file.
  struct FileState {
    std::uint64_t inode = 0;
    std::int64_t size = 0, written_ns = 0;
    bool operator==(const FileState&) const = default;
  };
  FileState StateOfFile() const;
  const catalog::Revision& HeadLocked();

  const std::filesystem::path path_;
  FileState head_state_;
  std::optional<catalog::Revision> head_;  // that of head_state_
  ReplyCache replies_;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_SHARED_CATALOG_H_
