#include "catalog/store/backup.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "catalog/store/connection.h"
#include "catalog/store/sql/address.h"
#include "catalog/store/sql/sqlite_file.h"

namespace plenum::catalog {
namespace {

namespace fs = std::filesystem;

// A file beside `place`, so that it can take its name; gone with the object unless it was moved.
class Beside {
 public:
  explicit Beside(const fs::path& place) : path_(place.string() + ".XXXXXX") {
    const int file = mkstemp(path_.data());
    if (file < 0)
      throw StoreError(path_ + ": cannot be created beside " + place.string(),
                       StoreFault::kStorage);
    close(file);
  }
  ~Beside() {
    std::error_code ignored;
    for (const char* suffix : {"", "-journal"}) fs::remove(path_ + suffix, ignored);
  }
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

// All pages in one step: one moment of `from`, one transaction of `to`.
void CopyPages(SQLite::Database from, const fs::path& to) {
  SQLite::Database target(to.string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
  WaitForLocks(target);
  // Fails where the file to be replaced is too damaged to be read; then FULL, the default, must do.
  target.tryExec("PRAGMA synchronous = EXTRA");
  SQLite::Backup backup(target, from);
  if (backup.executeStep(-1) != SQLITE_DONE)
    throw SQLite::Exception("is held by another process", SQLITE_BUSY);
}

// Only looks, whatever the file is.
SQLite::Database Peek(const fs::path& path) {
  SQLite::Database db(path.string(), SQLite::OPEN_READONLY);
  WaitForLocks(db);
  return db;
}

// Throws with the first fault that Check finds.
void RequireSound(const Store& store, const fs::path& shown) {
  const std::vector<std::string> faults = store.Check();
  if (!faults.empty()) throw StoreError(shown.string() + " is damaged: " + faults.front());
}

void SyncFolder(const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY);
  if (descriptor < 0) return;
  fsync(descriptor);
  close(descriptor);
}

// An empty file passes as a catalogue to be made; as a backup it would wipe everything.
void RequireFilled(const std::string& draft) {
  SQLite::Database db = Peek(draft);
  if (SchemaVersion(db) == 0) throw StoreError("is empty");
}

// Another program's database is not overwritten; a damaged catalogue may be.
void RequireOurs(const fs::path& catalogue) {
  if (!fs::exists(catalogue)) return;
  try {
    SQLite::Database db = Peek(catalogue);
    SchemaVersion(db);
  } catch (const SQLite::Exception&) {
  } catch (const StoreError& error) {
    throw StoreError(catalogue.string() + " " + error.what());
  }
}

// Pages are copied, which a server does not give.
void RequireFiles(const fs::path& catalogue, const fs::path& copy) {
  for (const fs::path& place : {catalogue, copy})
    if (IsServer(place))
      throw StoreError(Shown(place) +
                       ": is on a server; plenum catalog copy FROM TO copies it into a file, "
                       "pg_dump backs up the server");
  std::error_code missing;
  if (fs::equivalent(catalogue, copy, missing))
    throw StoreError(copy.string() + " is the catalogue itself");
}

}  // namespace

void Backup(const fs::path& catalogue, const fs::path& copy) {
  RequireFiles(catalogue, copy);
  const Beside draft(copy);
  try {
    CopyPages(ConnectFile(catalogue.string(), Access::kRead), draft.path());
  } catch (const SQLite::Exception& error) {
    throw ToStoreError(copy.string() + ": the copy could not be made", error);
  } catch (const StoreError& error) {
    throw StoreError(catalogue.string() + " " + error.what());
  }
  RequireSound(Store(draft.path(), Access::kRead), catalogue);
  fs::permissions(draft.path(), fs::status(catalogue).permissions());
  std::error_code error;
  fs::rename(draft.path(), copy, error);
  if (error)
    throw StoreError(copy.string() + ": cannot be written: " + error.message(),
                     StoreFault::kStorage);
  SyncFolder(copy);
}

void Restore(const fs::path& catalogue, const fs::path& copy) {
  RequireFiles(catalogue, copy);
  RequireOurs(catalogue);
  const Beside draft(catalogue);
  try {
    CopyPages(Peek(copy), draft.path());
    RequireFilled(draft.path());
  } catch (const SQLite::Exception& error) {
    throw ToStoreError(copy.string() + ": cannot be read", error);
  } catch (const StoreError& error) {
    throw StoreError(copy.string() + " " + error.what());
  }
  try {
    RequireSound(Store(draft.path(), Access::kWrite), copy);
  } catch (const StoreError& error) {
    // Names the file that the user gave, not the draft of it.
    std::string what = error.what();
    if (what.starts_with(draft.path())) what.replace(0, draft.path().size(), copy.string());
    throw StoreError(what, error.fault());
  }
  try {
    CopyPages(Peek(draft.path()), catalogue);
  } catch (const SQLite::Exception& error) {
    throw ToStoreError(catalogue.string() + ": was not replaced", error);
  }
}

}  // namespace plenum::catalog
