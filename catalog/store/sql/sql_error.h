// What a database says of a statement that it cannot do. Internal to the store, which makes it a
// StoreError that names the catalogue.
#ifndef PLENUM_CATALOG_STORE_SQL_SQL_ERROR_H_
#define PLENUM_CATALOG_STORE_SQL_SQL_ERROR_H_

#include <stdexcept>
#include <string>

#include "catalog/store/store_error.h"
#include "catalog/store/uncertain_write.h"

namespace plenum::catalog {

class SqlError : public std::runtime_error {
 public:
  // `lost`: the connection to a server broke, so a transaction under way was not done, unless it is
  // uncertain, as where it broke while the commit was asked for.
  explicit SqlError(const std::string& what, StoreFault fault = StoreFault::kOther,
                    bool lost = false)
      : std::runtime_error(what), fault_(fault), lost_(lost) {}
  StoreFault fault() const { return fault_; }
  bool lost() const { return lost_; }
  bool uncertain() const { return uncertain_; }
  static SqlError Uncertain(const std::string& what) {
    SqlError error(what, StoreFault::kAway, true);
    error.uncertain_ = true;
    return error;
  }

 private:
  StoreFault fault_;
  bool lost_, uncertain_ = false;
};

// `where` names the catalogue.
inline StoreError ToStoreError(const std::string& where, const SqlError& error) {
  return StoreError(where + ": " + error.what(), error.fault());
}

// Of a connection that writes.
[[noreturn]] inline void ThrowStoreError(const std::string& where, const SqlError& error) {
  const StoreError known = ToStoreError(where, error);
  if (error.uncertain()) throw UncertainWrite(known.what(), known.fault());
  throw known;
}

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_SQL_ERROR_H_
