// A connection to a catalogue on a server, for what no file holds: shared jobs and tokens. Internal
// to the store.
#ifndef PLENUM_CATALOG_STORE_SERVER_SESSION_H_
#define PLENUM_CATALOG_STORE_SERVER_SESSION_H_

#include <memory>
#include <mutex>
#include <string>

#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

class ServerSession {
 public:
  // Opens it for writing. Throws StoreError, also where the place is a file.
  explicit ServerSession(const std::string& address);

  // Runs `action(db)` in one transaction, once more where the connection was lost: each may be done
  // twice, also where only its confirmation was lost. Throws StoreError.
  template <class Action>
  auto Do(Purpose purpose, const Action& action) {
    const std::lock_guard lock(mutex_);
    const auto once = [&] {
      SqlTransaction transaction(*db_, purpose);
      auto result = action(*db_);
      transaction.Commit();
      return result;
    };
    try {
      try {
        return once();
      } catch (const SqlError& error) {
        if (!error.lost()) throw;
      }
      return once();
    } catch (const SqlError& error) {
      ThrowStoreError(shown_, error);
    }
  }

 private:
  const std::string shown_;
  std::unique_ptr<SqlDatabase> db_;
  std::mutex mutex_;
};

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SERVER_SESSION_H_
