#include "catalog/store.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <mutex>
#include <set>
#include <utility>

#include "catalog/migrations.h"
#include "catalog/rows.h"

namespace plenum::catalog {
namespace {

constexpr int kBusyTimeoutMs = 10'000;
constexpr int kApplicationId = 1886154349;  // "plnm", set by the first migration
constexpr int kSqliteReadOnly = 8;          // SQLITE_READONLY

int Pragma(SQLite::Database& db, const std::string& name) {
  return db.execAndGet("PRAGMA " + name).getInt();
}

bool Exists(SQLite::Database& db, const std::string& id) {
  SQLite::Statement query(db, "SELECT 1 FROM part WHERE id = ?");
  query.bind(1, id);
  return query.executeStep();
}

bool Delete(SQLite::Database& db, const std::string& id) {
  SQLite::Statement statement(db, "DELETE FROM part WHERE id = ?");
  statement.bind(1, id);
  return statement.exec() > 0;
}

void CountWrite(SQLite::Database& db) { db.exec("UPDATE revision SET number = number + 1"); }

// A rollback journal, not a write-ahead log: the shipped file must also open from a folder without
// write permission, and SQLite 3.40 can corrupt a write-ahead log that several connections reset.
// Writes are rare and take milliseconds, so readers hardly wait. EXTRA also syncs the folder when
// the journal goes, so a commit that was acknowledged outlasts a power cut.
void ConfigureForWriting(SQLite::Database& db) {
  db.exec("PRAGMA foreign_keys = ON");
  SQLite::Statement(db, "PRAGMA journal_mode = DELETE").executeStep();
  db.exec("PRAGMA synchronous = EXTRA");
}

// Number of migrations that the file has seen. Throws where it is not a catalogue or a newer one.
int SchemaVersion(SQLite::Database& db) {
  const int version = Pragma(db, "user_version");
  const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool ours = version > 0 && Pragma(db, "application_id") == kApplicationId;
  if (!ours && !(version == 0 && empty)) throw StoreError("is not a catalogue of parts");
  const auto known = static_cast<int>(Migrations().size());
  if (version > known)
    throw StoreError("has schema " + std::to_string(version) + ", this program knows up to " +
                     std::to_string(known) + "; use a newer program");
  return version;
}

// Applies the next migration, if any is left. The version is read again under the lock: another
// process may have migrated meanwhile.
bool MigrateOnce(SQLite::Database& db) {
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::IMMEDIATE);
  const int version = SchemaVersion(db);
  if (version == static_cast<int>(Migrations().size())) return false;
  const Migration& next = Migrations()[version];
  db.exec(next.sql);
  SQLite::Statement record(
      db, "INSERT INTO migration VALUES (?, ?, strftime('%Y-%m-%dT%H:%M:%SZ', 'now'))");
  record.bind(1, version + 1);
  record.bind(2, std::string(next.name));
  record.exec();
  db.exec("PRAGMA user_version = " + std::to_string(version + 1));
  transaction.commit();
  return true;
}

SQLite::Database OpenForReading(const std::string& path) {
  SQLite::Database db(path, SQLite::OPEN_READONLY, kBusyTimeoutMs);
  try {
    Pragma(db, "user_version");
    return db;
  } catch (const SQLite::Exception& error) {
    if (error.getErrorCode() != kSqliteReadOnly) throw;
  }
  // A writer died in the middle of a transaction and only a writer may roll it back.
  SQLite::Database writer(path, SQLite::OPEN_READWRITE, kBusyTimeoutMs);
  Pragma(writer, "user_version");
  return {path, SQLite::OPEN_READONLY, kBusyTimeoutMs};
}

SQLite::Database Open(const std::string& path, Access access) {
  if (access == Access::kWrite)
    return {path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs};
  return OpenForReading(path);
}

}  // namespace

struct Store::Impl {
  Impl(std::string file, Access access) : path(std::move(file)), db(Open(path, access)) {}

  // Runs `action` with the connection to itself and names the file in every error.
  template <class Action>
  auto Do(const Action& action) {
    const std::lock_guard lock(mutex);
    try {
      return action(db);
    } catch (const SQLite::Exception& error) {
      throw StoreError(path + ": " + error.what());
    } catch (const StoreError& error) {
      throw StoreError(path + " " + error.what());
    }
  }

  // Runs `action` in one transaction, committed only if it answers kDone.
  template <class Action>
  WriteResult Write(const Action& action) {
    return Do([&](SQLite::Database& connection) -> WriteResult {
      SQLite::Transaction transaction(connection, SQLite::TransactionBehavior::IMMEDIATE);
      const WriteStatus status = action(connection);
      if (status != WriteStatus::kDone) return {status, {}};
      CountWrite(connection);
      transaction.commit();
      return {};
    });
  }

  std::vector<Part> Read(const std::optional<Filter>& filter) {
    return Do([&](SQLite::Database& connection) {
      SQLite::Transaction one_moment(connection);
      return ReadParts(connection, filter);
    });
  }

  std::string path;
  SQLite::Database db;
  std::mutex mutex;
};

Store::Store(const std::filesystem::path& path, Access access) {
  try {
    impl_ = std::make_unique<Impl>(path.string(), access);
  } catch (const SQLite::Exception& error) {
    throw StoreError(path.string() + ": cannot be opened for " +
                     (access == Access::kRead ? "reading" : "writing") + ": " + error.what());
  }
  impl_->Do([&](SQLite::Database& db) {
    if (access == Access::kWrite) {
      SchemaVersion(db);  // a foreign file is refused before anything in it changes
      ConfigureForWriting(db);
      while (MigrateOnce(db)) {
      }
    } else if (SchemaVersion(db) < static_cast<int>(Migrations().size())) {
      throw StoreError("has an older schema; open it once for writing to migrate it");
    }
  });
}

Store::~Store() = default;
Store::Store(Store&&) noexcept = default;
Store& Store::operator=(Store&&) noexcept = default;

std::vector<Part> Store::List(const std::optional<std::string>& family) const {
  return impl_->Read(family ? std::optional(Filter{"family", *family}) : std::nullopt);
}

std::optional<Part> Store::Get(const std::string& id) const {
  std::vector<Part> found = impl_->Read(Filter{"id", id});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

WriteResult Store::Add(const Part& part) {
  if (auto errors = Validate(part); !errors.empty())
    return {WriteStatus::kInvalid, std::move(errors)};
  return impl_->Write([&](SQLite::Database& db) {
    if (Exists(db, part.id)) return WriteStatus::kExists;
    PartWriter(db).Insert(part);
    return WriteStatus::kDone;
  });
}

WriteResult Store::Replace(const Part& part) {
  if (auto errors = Validate(part); !errors.empty())
    return {WriteStatus::kInvalid, std::move(errors)};
  return impl_->Write([&](SQLite::Database& db) {
    if (!Delete(db, part.id)) return WriteStatus::kNotFound;
    PartWriter(db).Insert(part);
    return WriteStatus::kDone;
  });
}

WriteResult Store::Remove(const std::string& id) {
  return impl_->Write([&](SQLite::Database& db) {
    return Delete(db, id) ? WriteStatus::kDone : WriteStatus::kNotFound;
  });
}

void Store::ReplaceSeed(const std::vector<Part>& parts) {
  std::vector<Part> seed = parts;
  for (Part& part : seed) {
    part.origin = "seed";
    if (const auto errors = Validate(part); !errors.empty())
      throw StoreError(impl_->path + ": seed part \"" + part.id + "\", " + errors.front().field +
                       ": " + errors.front().detail);
  }
  std::sort(seed.begin(), seed.end(), [](const Part& a, const Part& b) { return a.id < b.id; });
  impl_->Write([&](SQLite::Database& db) {
    db.exec("DELETE FROM part WHERE origin = 'seed'");
    std::set<std::string> of_users;
    SQLite::Statement query(db, "SELECT id FROM part");
    while (query.executeStep()) of_users.insert(query.getColumn(0).getString());
    PartWriter writer(db);
    for (const Part& part : seed)
      if (!of_users.contains(part.id)) writer.Insert(part);
    return WriteStatus::kDone;
  });
  impl_->Do([](SQLite::Database& db) { db.exec("VACUUM"); });
}

std::vector<std::string> Store::Check() const {
  std::vector<std::string> faults = impl_->Do([](SQLite::Database& db) {
    std::vector<std::string> found;
    SQLite::Statement integrity(db, "PRAGMA integrity_check");
    while (integrity.executeStep())
      if (std::string line = integrity.getColumn(0).getString(); line != "ok")
        found.push_back(std::move(line));
    SQLite::Statement keys(db, "PRAGMA foreign_key_check");
    while (keys.executeStep())
      found.push_back("a row of table " + keys.getColumn(0).getString() + " belongs to no " +
                      keys.getColumn(2).getString());
    return found;
  });
  if (!faults.empty()) return faults;  // what is damaged cannot be read part by part
  for (const Part& part : List())
    for (const FieldError& error : Validate(part))
      faults.push_back(part.id + ", " + error.field + ": " + error.detail);
  return faults;
}

long long Store::DataVersion() const {
  return impl_->Do([](SQLite::Database& db) {
    return static_cast<long long>(db.execAndGet("SELECT number FROM revision").getInt64());
  });
}

}  // namespace plenum::catalog
