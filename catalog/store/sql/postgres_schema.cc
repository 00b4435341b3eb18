#include "catalog/store/sql/postgres_schema.h"

#include "catalog/store/sql/migrations.h"
#include "catalog/store/sql/postgres_database.h"

namespace plenum::catalog {
namespace {

int Known() { return static_cast<int>(ServerMigrations().size()); }

std::int64_t Count(SqlDatabase& db, const std::string& sql) {
  const auto query = Query(db, sql);
  return query->Step() ? query->Integer(0) : 0;
}

// Migrations that the database has seen; 0: it is empty.
int ReadVersion(SqlDatabase& db) {
  const bool ours = Count(db,
                          "SELECT count(*) FROM pg_tables WHERE schemaname = current_schema() AND "
                          "tablename IN ('migration', 'revision')") == 2;
  if (!ours) {
    if (Count(db, "SELECT count(*) FROM pg_tables WHERE schemaname = current_schema()") > 0)
      throw StoreError("has tables of another program; give the catalogue a database of its own");
    return 0;
  }
  const auto version = static_cast<int>(Count(db, "SELECT count(*) FROM migration"));
  if (version > Known())
    throw StoreError("has schema " + std::to_string(version) + ", this program knows up to " +
                     std::to_string(Known()) + "; use a newer program");
  return version;
}

int Version(SqlDatabase& db) {
  const SqlTransaction reading(db, Purpose::kRead);
  return ReadVersion(db);
}

// The version is read again under the lock: another process may have migrated meanwhile.
void Migrate(SqlDatabase& db, const std::function<void(SqlDatabase&)>& fill) {
  SqlTransaction transaction(db, Purpose::kWrite);
  const int before = ReadVersion(db);
  for (int version = before; version < Known(); ++version) {
    const Migration& migration = ServerMigrations()[version];
    db.Execute(migration.sql);
    Run(db, std::string("INSERT INTO migration VALUES (?, ?, ") + db.words().now + ")", version + 1,
        migration.name);
  }
  if (before == 0) fill(db);
  transaction.Commit();
}

}  // namespace

std::unique_ptr<SqlDatabase> OpenServer(const std::string& address, Access access,
                                        const std::function<void(SqlDatabase&)>& fill) {
  auto db = ConnectToServer(address);
  const int version = Version(*db);
  if (version == Known()) return db;
  if (version == 0 && access == Access::kRead)
    throw StoreError("holds no catalogue yet; plenum catalog copy FROM TO fills it");
  Migrate(*db, fill);
  return db;
}

}  // namespace plenum::catalog
