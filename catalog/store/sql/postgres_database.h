// A catalogue on a server of PostgreSQL, as a SqlDatabase over libpq.
//
// Statements are sent without a name and settings are made for one transaction only, so that a
// pooler may give each transaction another session. Rows are taken as they arrive; a second
// statement in between keeps the rest of the first one's in memory.
#ifndef PLENUM_CATALOG_STORE_SQL_POSTGRES_DATABASE_H_
#define PLENUM_CATALOG_STORE_SQL_POSTGRES_DATABASE_H_

#include <memory>
#include <string>

#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// Throws SqlError (kAway) where the server cannot be reached, in words without a password.
std::unique_ptr<SqlDatabase> ConnectToServer(const std::string& address);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_POSTGRES_DATABASE_H_
