#include "catalog/store/sql/sqlite_file.h"

#include <sqlite3.h>

#include <chrono>
#include <cstdint>
#include <thread>

#include "catalog/store/sql/migrations.h"

namespace plenum::catalog {
namespace {

constexpr std::chrono::milliseconds kAskEvery{1};
constexpr int kApplicationId = 1886154349;  // "plnm", set by the first migration

int Pragma(SQLite::Database& db, const std::string& name) {
  return db.execAndGet("PRAGMA " + name).getInt();
}

int Known() { return static_cast<int>(Migrations().size()); }

// A rollback journal, not a write-ahead log: the shipped file must also open from a folder without
// write permission, and SQLite 3.40 can corrupt a write-ahead log that several connections reset.
// Writes are rare and take milliseconds, so readers hardly wait. EXTRA also syncs the folder when
// the journal goes, so a commit that was acknowledged outlasts a power cut.
void ConfigureForWriting(SQLite::Database& db) {
  SQLite::Statement(db, "PRAGMA journal_mode = DELETE").executeStep();
  db.exec("PRAGMA synchronous = EXTRA");
}

void ApplyMigration(SQLite::Database& db, int number) {
  const Migration& migration = Migrations()[number - 1];
  db.exec(migration.sql);
  SQLite::Statement record(
      db, "INSERT INTO migration VALUES (?, ?, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))");
  record.bind(1, number);
  record.bind(2, std::string(migration.name));
  record.exec();
  db.exec("PRAGMA user_version = " + std::to_string(number));
}

// The version is read under the lock: another process may have migrated meanwhile.
void Migrate(SQLite::Database& db, const AfterMigration& after) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
  for (int version = SchemaVersion(db); version < Known(); ++version)
    ApplyMigration(db, version + 1);
  after(db);
  transaction.commit();
}

SQLite::Database ConnectForWriting(const std::string& path, int flags,
                                   const AfterMigration& after) {
  SQLite::Database db(path, SQLite::OPEN_READWRITE | flags);
  WaitForLocks(db);
  db.exec("PRAGMA foreign_keys = ON");
  const int version = SchemaVersion(db);  // a foreign file is refused before anything changes
  ConfigureForWriting(db);
  if (version < Known()) Migrate(db, after);
  return db;
}

SQLite::Database ConnectForReading(const std::string& path) {
  SQLite::Database db(path, SQLite::OPEN_READONLY);
  WaitForLocks(db);
  db.exec("PRAGMA foreign_keys = ON");
  return db;
}

// Called by SQLite with how often it was called for this lock before; 0 gives up.
int AskAgain(void* patience_ms, int asked) {
  using Clock = std::chrono::steady_clock;
  thread_local Clock::time_point since;
  if (asked == 0) since = Clock::now();
  const std::chrono::milliseconds patience(reinterpret_cast<std::intptr_t>(patience_ms));
  if (Clock::now() - since > patience) return 0;
  std::this_thread::sleep_for(kAskEvery);
  return 1;
}

}  // namespace

void WaitForLocks(SQLite::Database& db, std::chrono::milliseconds patience) {
  sqlite3_busy_handler(db.getHandle(), AskAgain,
                       reinterpret_cast<void*>(  // NOLINT(performance-no-int-to-ptr): a number
                           static_cast<std::intptr_t>(patience.count())));
}

int SchemaVersion(SQLite::Database& db) {
  const int version = Pragma(db, "user_version");
  const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool ours = version > 0 && Pragma(db, "application_id") == kApplicationId;
  if (!ours && !(version == 0 && empty)) throw StoreError("is not a catalogue of parts");
  if (version > Known())
    throw StoreError("has schema " + std::to_string(version) + ", this program knows up to " +
                     std::to_string(Known()) + "; use a newer program");
  return version;
}

SQLite::Database OpenFile(const std::string& path, Access access, const AfterMigration& after) {
  if (access == Access::kWrite) return ConnectForWriting(path, SQLite::OPEN_CREATE, after);
  try {
    SQLite::Database db = ConnectForReading(path);
    const int version = SchemaVersion(db);
    if (version == Known()) return db;
    if (version == 0) throw StoreError("has an older schema: it is empty; open it for writing");
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() != SQLITE_READONLY) throw;
    // A writer died in the middle of a transaction, which only a writer may roll back.
  }
  try {
    ConnectForWriting(path, 0, after);
  } catch (const SQLite::Exception& error) {
    throw StoreError(std::string("has an older schema or an unfinished write and cannot be ") +
                     "written to mend that: " + error.what());
  }
  return ConnectForReading(path);
}

std::vector<std::string> CheckFile(SQLite::Database& db) {
  std::vector<std::string> faults;
  SQLite::Statement integrity(db, "PRAGMA integrity_check");
  while (integrity.executeStep())
    if (std::string line = integrity.getColumn(0).getString(); line != "ok")
      faults.push_back(std::move(line));
  SQLite::Statement keys(db, "PRAGMA foreign_key_check");
  while (keys.executeStep())
    faults.push_back("a row of table " + keys.getColumn(0).getString() + " belongs to no " +
                     keys.getColumn(2).getString());
  return faults;
}

SqlError ToSqlError(const SQLite::Exception& error) {
  switch (error.getErrorCode()) {
    case SQLITE_BUSY:
      return SqlError(error.what(), StoreFault::kBusy);
    case SQLITE_READONLY:
    case SQLITE_IOERR:
    case SQLITE_FULL:
    case SQLITE_CANTOPEN:
      return SqlError(error.what(), StoreFault::kStorage);
    default:
      return SqlError(error.what());
  }
}

}  // namespace plenum::catalog
