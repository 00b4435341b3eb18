// How catalog.db is opened, and what goes wrong with it.
#ifndef PLENUM_CATALOG_STORE_STORE_ERROR_H_
#define PLENUM_CATALOG_STORE_STORE_ERROR_H_

#include <stdexcept>
#include <string>

namespace plenum::catalog {

enum class Access { kRead, kWrite };

// kStorage: the disk is full or fails, or the file cannot be written; kBusy: another process holds
// it for longer than ten seconds; kAway: its server cannot be reached. In all cases nothing of the
// write was done.
enum class StoreFault { kOther, kStorage, kBusy, kAway };

// Thrown when the database cannot be opened, read or written; the message names the file and what
// to do. (I/O is the one place of plenum where exceptions carry an outcome.)
class StoreError : public std::runtime_error {
 public:
  explicit StoreError(const std::string& what, StoreFault fault = StoreFault::kOther)
      : std::runtime_error(what), fault_(fault) {}
  StoreFault fault() const { return fault_; }

 private:
  StoreFault fault_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_STORE_ERROR_H_
