// The service's one read-write connection to catalog.db, shared by its threads.
#ifndef PLENUM_SERVER_SHARED_CATALOG_H_
#define PLENUM_SERVER_SHARED_CATALOG_H_

#include <filesystem>
#include <memory>
#include <mutex>
#include <vector>

#include "api/services.h"

namespace plenum::server {

using Parts = std::shared_ptr<const std::vector<catalog::Part>>;

class SharedCatalog {
 public:
  explicit SharedCatalog(const std::filesystem::path& path);

  // All parts as they are now; the same vector until something, in any process, writes.
  Parts Snapshot();

  // Runs `f(store)` while no other thread of this process uses the store.
  template <typename F>
  auto With(F&& f) {
    const std::lock_guard lock(mutex_);
    return f(store_);
  }

 private:
  std::mutex mutex_;
  catalog::Store store_;
  Parts snapshot_;
  long long snapshot_version_ = 0;
};

}  // namespace plenum::server

#endif  // PLENUM_SERVER_SHARED_CATALOG_H_
