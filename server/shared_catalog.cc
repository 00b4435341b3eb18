#include "server/shared_catalog.h"

namespace plenum::server {

SharedCatalog::SharedCatalog(const std::filesystem::path& path)
    : store_(path, catalog::Access::kWrite) {}

Parts SharedCatalog::Snapshot() {
  const std::lock_guard lock(mutex_);
  // Read before the rows: a write in between costs one needless reload, never a stale row.
  const long long version = store_.DataVersion();
  if (!snapshot_ || version != snapshot_version_) {
    snapshot_ = std::make_shared<const std::vector<catalog::Part>>(store_.List());
    snapshot_version_ = version;
  }
  return snapshot_;
}

}  // namespace plenum::server
