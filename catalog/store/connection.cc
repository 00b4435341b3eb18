#include "catalog/store/connection.h"

#include <filesystem>
#include <utility>

#include "catalog/store/sql/address.h"
#include "catalog/store/sql/postgres_schema.h"
#include "catalog/store/sql/sqlite_database.h"
#include "catalog/store/sql/sqlite_file.h"
#include "catalog/store/tables/history.h"

namespace plenum::catalog {
namespace {

using Fill = std::function<void(SqlDatabase&)>;

AfterMigration InFile(const Fill& fill) {
  return [&fill](SQLite::Database& db) {
    const auto borrowed = std::shared_ptr<SQLite::Database>(&db, [](SQLite::Database*) {});
    fill(*MakeSqliteDatabase(borrowed));
  };
}

std::unique_ptr<SqlDatabase> Open(const std::string& place, Access access, const Fill& fill) {
  if (IsServer(place)) return OpenServer(place, access, fill);
  try {
    return MakeSqliteDatabase(
        std::make_shared<SQLite::Database>(OpenFile(place, access, InFile(fill))));
  } catch (const SQLite::Exception& error) {
    throw ToSqlError(error);
  }
}

}  // namespace

std::unique_ptr<SqlDatabase> Connect(const std::string& place, Access access) {
  return Open(place, access, SealHead);
}

std::unique_ptr<SqlDatabase> MakeCatalogue(const std::string& place, const Fill& fill) {
  bool filled = false;
  auto db = Open(place, Access::kWrite, [&](SqlDatabase& made) {
    fill(made);
    filled = true;
  });
  if (!filled) throw StoreError("holds a catalogue already");
  return db;
}

SQLite::Database ConnectFile(const std::string& path, Access access) {
  const Fill seal = SealHead;
  return OpenFile(path, access, InFile(seal));
}

}  // namespace plenum::catalog
