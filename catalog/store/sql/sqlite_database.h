// A catalogue in a file of SQLite, as a SqlDatabase.
#ifndef PLENUM_CATALOG_STORE_SQL_SQLITE_DATABASE_H_
#define PLENUM_CATALOG_STORE_SQL_SQLITE_DATABASE_H_

#include <SQLiteCpp/SQLiteCpp.h>

#include <memory>

#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

std::unique_ptr<SqlDatabase> MakeSqliteDatabase(std::shared_ptr<SQLite::Database> db);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_SQLITE_DATABASE_H_
