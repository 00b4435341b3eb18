// The schemas as the .sql files of catalog/migrations/, compiled in so that the
// program needs no files at run time. The definition is generated when CMake configures.
#ifndef PLENUM_CATALOG_STORE_SQL_MIGRATIONS_H_
#define PLENUM_CATALOG_STORE_SQL_MIGRATIONS_H_

#include <span>

namespace plenum::catalog {

struct Migration {
  const char* name;  // of the file, without .sql
  const char* sql;
};

// For SQLite, in the order in which they are applied. PRAGMA user_version is how many have been.
std::span<const Migration> Migrations();
// For PostgreSQL. The table `migration` has a row for each that has been applied.
std::span<const Migration> ServerMigrations();

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_SQL_MIGRATIONS_H_
