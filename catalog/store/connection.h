// A catalogue opened with the newest schema, in a file of SQLite or on a server. Internal to the
// room.
#ifndef PLENUM_CATALOG_STORE_CONNECTION_H_
#define PLENUM_CATALOG_STORE_CONNECTION_H_

#include <SQLiteCpp/SQLiteCpp.h>

#include <functional>
#include <memory>
#include <string>

#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// A schema that is missing or older is made or brought to the newest, in one transaction. Throws
// SqlError, and StoreError without the name of the place where it is no catalogue or a newer one.
std::unique_ptr<SqlDatabase> Connect(const std::string& place, Access access);

// The same where there must be no catalogue yet: `fill` finds empty tables and, as the one
// revision, one without a hash, which it may change.
std::unique_ptr<SqlDatabase> MakeCatalogue(const std::string& place,
                                           const std::function<void(SqlDatabase&)>& fill);

// A file of SQLite as such.
SQLite::Database ConnectFile(const std::string& path, Access access);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_CONNECTION_H_
