#include "server/jobs/catalogue_hold.h"

#include <fcntl.h>
#include <unistd.h>

#include "api/catalogue/stores.h"

namespace plenum::server {
namespace {

// A byte far beyond those that SQLite locks (file format, 1.2.1: 2^30 to 2^30 + 511) and uses.
constexpr off_t kLockedByte = off_t{1} << 61;

}  // namespace

CatalogueHold::CatalogueHold(const std::filesystem::path& catalogue)
    : file_(catalog::IsServer(catalogue) ? -1 : open(catalogue.c_str(), O_RDWR | O_CLOEXEC)) {
  if (file_ < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = kLockedByte;
  lock.l_len = 1;
  if (fcntl(file_, F_OFD_SETLK, &lock) == 0) return;
  close(file_);
  throw catalog::StoreError(
      catalogue.string() + " is held by another service, perhaps under another name of the file",
      catalog::StoreFault::kBusy);
}

CatalogueHold::~CatalogueHold() {
  if (file_ >= 0) close(file_);
}

}  // namespace plenum::server
