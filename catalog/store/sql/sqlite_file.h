// Files of SQLite: opened, refused or migrated. Internal to the store.
#ifndef PLENUM_CATALOG_STORE_SQL_SQLITE_FILE_H_
#define PLENUM_CATALOG_STORE_SQL_SQLITE_FILE_H_

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "catalog/store/sql/sql_error.h"

namespace plenum::catalog {

// What SQL cannot do in a migration, done after the last one in its transaction.
using AfterMigration = std::function<void(SQLite::Database& db)>;

// A connection with foreign keys on, to a file of the newest schema: an older one is migrated, all
// migrations in one transaction. Throws SQLite::Exception, and StoreError without the name of the
// file where it is no catalogue or a newer one.
SQLite::Database OpenFile(const std::string& path, Access access, const AfterMigration& after);

// Makes the connection wait for locks, so long for each, by asking every millisecond. SQLite's own
// wait asks ten times a second in the end and misses the moments between the commits of a busy
// writer for as long as it writes.
inline constexpr std::chrono::milliseconds kLockPatience{10'000};
void WaitForLocks(SQLite::Database& db, std::chrono::milliseconds patience = kLockPatience);

// What SQLite's own checks of the pages and the foreign keys find.
std::vector<std::string> CheckFile(SQLite::Database& db);

// Number of migrations that the file has seen. Throws StoreError where it is not a catalogue (an
// empty file may become one) or has more than this program knows.
int SchemaVersion(SQLite::Database& db);

SqlError ToSqlError(const SQLite::Exception& error);
inline StoreError ToStoreError(const std::string& where, const SQLite::Exception& error) {
  return ToStoreError(where, ToSqlError(error));
}

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_SQLITE_FILE_H_
