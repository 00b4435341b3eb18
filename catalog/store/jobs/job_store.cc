#include "catalog/store/jobs/job_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mutex>

#include "catalog/store/jobs/job_rows.h"
#include "catalog/store/sql/sqlite_database.h"
#include "catalog/store/sql/sqlite_file.h"

namespace plenum::catalog {
namespace {

constexpr int kBusyTimeoutMs = 2'000;
constexpr int kSchema = 6;
constexpr int kApplicationId = 1886154346;  // "plnj"

// Only one of them had begun and so has a result: its size tells it from the others, all alike.
constexpr char kEnding[] = "bytes";

constexpr char kSchema1[] = R"sql(
CREATE TABLE job (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9007199254740991),
  id TEXT NOT NULL UNIQUE CHECK (length(id) BETWEEN 1 AND 100),
  kind TEXT NOT NULL CHECK (length(kind) BETWEEN 1 AND 100),
  name TEXT NOT NULL CHECK (length(name) <= 1000000),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  key TEXT CHECK (length(key) BETWEEN 1 AND 255),
  digest TEXT CHECK (length(digest) BETWEEN 1 AND 100),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 9007199254740991),
  hash TEXT NOT NULL CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  model TEXT NOT NULL CHECK (length(model) <= 100),
  model_version INTEGER NOT NULL CHECK (model_version BETWEEN 0 AND 9007199254740991),
  model_hash TEXT NOT NULL CHECK (length(model_hash) IN (0, 64)),
  status TEXT NOT NULL
    CHECK (status IN ('queued', 'running', 'done', 'cancelled', 'failed')),
  starts INTEGER NOT NULL DEFAULT 0 CHECK (starts BETWEEN 0 AND 1000000),
  cancel_asked INTEGER NOT NULL DEFAULT 0 CHECK (cancel_asked IN (0, 1)),
  submitted_at TEXT NOT NULL CHECK (length(submitted_at) = 20),
  ended_at TEXT CHECK (length(ended_at) = 20),
  ended INTEGER UNIQUE CHECK (ended BETWEEN 1 AND 9007199254740991),  -- counts endings
  bytes INTEGER NOT NULL CHECK (bytes BETWEEN 0 AND 2147483647),  -- of request and result
  progress TEXT NOT NULL DEFAULT '',
  failure TEXT NOT NULL DEFAULT '',
  request TEXT NOT NULL,
  result TEXT NOT NULL DEFAULT '',
  UNIQUE (kind, key),
  CHECK ((ended IS NULL) = (status IN ('queued', 'running')) AND (ended IS NULL) = (ended_at IS NULL))
) STRICT;
)sql";
constexpr char kSchema2[] = R"sql(
ALTER TABLE job ADD COLUMN crashes INTEGER NOT NULL DEFAULT 0
  CHECK (crashes BETWEEN 0 AND 1000000);
ALTER TABLE job ADD COLUMN crashes_max INTEGER NOT NULL DEFAULT 2
  CHECK (crashes_max BETWEEN 1 AND 1000001);
ALTER TABLE job ADD COLUMN crash TEXT NOT NULL DEFAULT '' CHECK (length(crash) <= 1000);
ALTER TABLE job ADD COLUMN alone INTEGER NOT NULL DEFAULT 0 CHECK (alone IN (0, 1));
)sql";
constexpr char kSchema3[] = R"sql(
ALTER TABLE job ADD COLUMN client TEXT NOT NULL DEFAULT '' CHECK (length(client) <= 100);
)sql";
constexpr char kSchema4[] = R"sql(
ALTER TABLE job ADD COLUMN priority INTEGER NOT NULL DEFAULT 0
  CHECK (priority BETWEEN -100 AND 100);
)sql";
constexpr char kSchema5[] = R"sql(
CREATE TABLE sweep (
  number INTEGER NOT NULL PRIMARY KEY CHECK (number BETWEEN 1 AND 9007199254740991),
  id TEXT NOT NULL UNIQUE CHECK (length(id) BETWEEN 1 AND 100),
  kind TEXT NOT NULL CHECK (length(kind) BETWEEN 1 AND 100),
  name TEXT NOT NULL CHECK (length(name) <= 1000000),
  who TEXT NOT NULL CHECK (length(who) <= 200),
  key TEXT CHECK (length(key) BETWEEN 1 AND 255),
  digest TEXT CHECK (length(digest) BETWEEN 1 AND 100),
  client TEXT NOT NULL CHECK (length(client) <= 100),
  submitted_at TEXT NOT NULL CHECK (length(submitted_at) = 20),
  revision INTEGER NOT NULL CHECK (revision BETWEEN 0 AND 9007199254740991),
  hash TEXT NOT NULL CHECK (length(hash) = 64 AND hash NOT GLOB '*[^0-9a-f]*'),
  plan TEXT NOT NULL,
  UNIQUE (kind, key)
) STRICT;
ALTER TABLE job ADD COLUMN sweep TEXT;
ALTER TABLE job ADD COLUMN place INTEGER NOT NULL DEFAULT 0 CHECK (place BETWEEN 0 AND 1000000);
CREATE INDEX job_of_sweep ON job (sweep, place) WHERE sweep IS NOT NULL;
)sql";

// Requests and results in a table of their own: SQLite walks over all pages of a long text to the
// columns behind it.
constexpr char kSchema6[] = R"sql(
CREATE TABLE job_text (
  number INTEGER NOT NULL PRIMARY KEY REFERENCES job (number),
  request TEXT NOT NULL,
  result TEXT NOT NULL DEFAULT ''
) STRICT;
INSERT INTO job_text SELECT number, request, result FROM job;
ALTER TABLE job DROP COLUMN request;
ALTER TABLE job DROP COLUMN result;
CREATE TRIGGER job_text_goes_with_job AFTER DELETE ON job
  BEGIN DELETE FROM job_text WHERE number = OLD.number; END;
)sql";

// The requests and results are their client's, whoever may read the catalogue. SQLite gives its log
// the mode of the file.
void KeepFromOthers(const std::string& path) {
  // An existing file is not opened here: closing it would end the locks that this process has on
  // it.
  const int file = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (file >= 0)
    close(file);
  else
    chmod(path.c_str(), 0600);
}

SQLite::Database Open(const std::string& path) {
  KeepFromOthers(path);
  SQLite::Database db(path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE, kBusyTimeoutMs);
  // Before anything is read, so that the log needs no memory shared with other processes.
  SQLite::Statement(db, "PRAGMA locking_mode = EXCLUSIVE").executeStep();
  const int schema = db.execAndGet("PRAGMA user_version").getInt();
  const bool empty = db.execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
  const bool ours = db.execAndGet("PRAGMA application_id").getInt() == kApplicationId;
  if (!ours && !empty) throw StoreError("is not a file of jobs");
  if (schema > kSchema)
    throw StoreError("has schema " + std::to_string(schema) + ", this program knows up to " +
                     std::to_string(kSchema) + "; use a newer program");
  SQLite::Statement(db, "PRAGMA journal_mode = WAL").executeStep();
  db.exec("PRAGMA synchronous = FULL");
  SQLite::Transaction transaction(db, SQLite::TransactionBehavior::EXCLUSIVE);
  if (empty) {
    db.exec(kSchema1);
    db.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
  }
  if (empty || schema < kSchema) {
    if (empty || schema < 2) db.exec(kSchema2);
    if (empty || schema < 3) db.exec(kSchema3);
    if (empty || schema < 4) db.exec(kSchema4);
    if (empty || schema < 5) db.exec(kSchema5);
    db.exec(kSchema6);
    db.exec("PRAGMA user_version = " + std::to_string(kSchema));
  }
  transaction.commit();
  return db;
}

void InsertJob(SqlDatabase& db, const std::string& id, const JobOrder& order) {
  Run(db,
      std::string("INSERT INTO job (id, kind, name, who, key, digest, revision, hash, model, "
                  "model_version, model_hash, client, priority, sweep, place, status, "
                  "submitted_at, bytes) VALUES (?, ?, ?, ?, nullif(?, ''), nullif(?, ''), "
                  "?, ?, ?, ?, ?, ?, ?, nullif(?, ''), ?, 'queued', ") +
          db.words().now + ", ?)",
      id, order.kind, order.name, order.by.who, order.by.key, order.by.request, order.revision,
      order.hash, order.model, order.model_version, order.model_hash, order.client, order.priority,
      order.sweep, order.place, static_cast<std::int64_t>(order.request.size()));
  Run(db, "INSERT INTO job_text (number, request) SELECT number, ? FROM job WHERE id = ?",
      order.request, id);
}

void SetResult(SqlDatabase& db, const std::string& id, const std::string& result) {
  Run(db, "UPDATE job_text SET result = ? WHERE number = (SELECT number FROM job WHERE id = ?)",
      result, id);
}

void UpdateEnded(SqlDatabase& db, const JobRecord& record, const std::string& ended_at) {
  Run(db,
      "UPDATE job SET status = ?, progress = ?, failure = ?, bytes = bytes + ?, "
      "ended = (SELECT coalesce(max(ended), 0) + 1 FROM job), ended_at = ? WHERE id = ?",
      std::string(Name(record.status)), record.progress, record.failure,
      static_cast<std::int64_t>(record.result.size()), ended_at, record.id);
  SetResult(db, record.id, record.result);
}

}  // namespace

struct JobStore::Impl {
  Impl(std::string file, const JobsKept& limits)
      : path(std::move(file)),
        kept(limits),
        db(MakeSqliteDatabase(std::make_shared<SQLite::Database>(Open(path)))) {}

  // Runs `action` with the connection to itself and names the file in every error.
  template <class Action>
  auto Do(const Action& action) {
    const std::lock_guard lock(mutex);
    try {
      return action(*db);
    } catch (const SqlError& error) {
      throw ToStoreError(path, error);
    }
  }

  std::vector<JobRecord> Select(const std::string& columns, const std::string& where,
                                const std::vector<std::string>& arguments) {
    return Do([&](SqlDatabase& jobs_file) {
      const auto query = jobs_file.Prepare("SELECT " + columns + " FROM job " + where);
      int place = 0;
      for (const std::string& argument : arguments) query->Bind(++place, argument);
      std::vector<JobRecord> jobs;
      while (query->Step()) jobs.push_back(ReadJob(*query));
      return jobs;
    });
  }
  std::optional<JobRecord> SelectOne(const std::string& where, const std::string& kind,
                                     const std::string& argument) {
    auto found =
        Select(JobColumns(kEnding) + ", request, result",
               "JOIN job_text USING (number) WHERE kind = ? AND " + where, {kind, argument});
    return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
  }

  void DropOld(const std::string& kind) {
    Run(*db, kOldJobs, kind, kept.jobs, kept.bytes);
    Run(*db, kEmptySweeps, kind);
  }

  const std::string path;
  const JobsKept kept;
  const std::unique_ptr<SqlDatabase> db;
  std::mutex mutex;
};

JobStore::JobStore(const std::filesystem::path& path, const JobsKept& kept) {
  try {
    impl_ = std::make_unique<Impl>(path.string(), kept);
  } catch (const SQLite::Exception& error) {
    const StoreError known = ToStoreError(path.string() + ": the jobs cannot be kept", error);
    if (known.fault() != StoreFault::kBusy) throw known;
    throw StoreError(path.string() + " is held by another service of the same catalogue",
                     StoreFault::kBusy);
  } catch (const StoreError& error) {
    throw StoreError(path.string() + " " + error.what());
  }
}

JobStore::~JobStore() = default;

std::vector<std::string> CheckJobs(const std::filesystem::path& path) {
  try {
    SQLite::Database db(path.string(), SQLite::OPEN_READONLY, kBusyTimeoutMs);
    if (db.execAndGet("PRAGMA application_id").getInt() != kApplicationId)
      throw StoreError(path.string() + " is not a file of jobs");
    return CheckFile(db);
  } catch (const SQLite::Exception& error) {
    throw ToStoreError(path.string(), error);
  }
}

JobRecord JobStore::Add(const std::string& id, const JobOrder& order) {
  impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    InsertJob(db, id, order);
    transaction.Commit();
  });
  return Find(order.kind, id).value();
}

std::optional<SweepRecord> JobStore::AddSweep(const SweepRecord& sweep,
                                              const std::vector<NewJob>& jobs) {
  const bool added = impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    if (!InsertSweep(db, sweep)) return false;
    for (const NewJob& job : jobs) InsertJob(db, job.id, job.order);
    transaction.Commit();
    return true;
  });
  return added ? FindSweep(sweep.kind, sweep.id) : std::nullopt;
}

std::optional<SweepRecord> JobStore::FindSweep(const std::string& kind,
                                               const std::string& id) const {
  return impl_->Do([&](SqlDatabase& db) { return SelectSweep(db, kind, "id", id); });
}

std::optional<SweepRecord> JobStore::FindSweepKey(const std::string& kind,
                                                  const std::string& key) const {
  return impl_->Do([&](SqlDatabase& db) { return SelectSweep(db, kind, "key", key); });
}

std::vector<SweepRecord> JobStore::Sweeps(const std::string& kind, int limit) const {
  return impl_->Do([&](SqlDatabase& db) { return SelectSweeps(db, kind, limit); });
}

std::vector<JobRecord> JobStore::OfSweep(const std::string& id) const {
  return impl_->Select(JobColumns(kEnding), "WHERE sweep = ? ORDER BY place", {id});
}

void JobStore::Start(const std::string& id) {
  impl_->Do([&](SqlDatabase& db) {
    Run(db, "UPDATE job SET status = 'running', starts = min(starts + 1, 1000000) WHERE id = ?",
        id);
  });
}

void JobStore::Requeue(const std::string& id) {
  impl_->Do([&](SqlDatabase& db) {
    Run(db, "UPDATE job SET status = 'queued', starts = max(0, starts - 1) WHERE id = ?", id);
  });
}

void JobStore::AskToCancel(const std::string& id) {
  impl_->Do([&](SqlDatabase& db) {
    Run(db, "UPDATE job SET cancel_asked = 1 WHERE id = ? AND ended IS NULL", id);
  });
}

void JobStore::RequeueInterrupted(const std::vector<JobCrash>& crashes) {
  impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    for (const JobCrash& crash : crashes)
      Run(db,
          "UPDATE OR IGNORE job SET crashes = min(crashes + 1, 1000000), crash = substr(?, 1, "
          "1000) "
          "WHERE number = ? AND status = 'running'",
          crash.what, crash.number);
    db.Execute("UPDATE OR IGNORE job SET status = 'queued', alone = 1 WHERE status = 'running'");
    transaction.Commit();
  });
}

void JobStore::Again(const std::string& id) {
  impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    SetResult(db, id, "");
    Run(db,
        "UPDATE job SET status = 'queued', ended = NULL, ended_at = NULL, cancel_asked = 0, "
        "progress = '', failure = '', bytes = (SELECT length(CAST(request AS BLOB)) FROM job_text "
        "WHERE job_text.number = job.number), alone = crashes > 0, crashes_max = max(2, crashes + "
        "1) WHERE id = ?",
        id);
    transaction.Commit();
  });
}

std::string JobStore::End(const JobRecord& record) {
  return End(std::span<const JobRecord>(&record, 1));
}

std::string JobStore::End(std::span<const JobRecord> records) {
  std::string ended_at;
  impl_->Do([&](SqlDatabase& db) {
    SqlTransaction transaction(db, Purpose::kWrite);
    if (records.empty()) return;
    const auto now = Query(db, std::string("SELECT ") + db.words().now);
    if (now->Step()) ended_at = now->Text(0);
    for (const JobRecord& record : records) UpdateEnded(db, record, ended_at);
    impl_->DropOld(records.back().order.kind);
    transaction.Commit();
  });
  return ended_at;
}

std::optional<JobRecord> JobStore::Find(const std::string& kind, const std::string& id) const {
  return impl_->SelectOne("id = ?", kind, id);
}

std::optional<JobRecord> JobStore::Peek(const std::string& kind, const std::string& id) const {
  auto found = impl_->Select(JobColumns(kEnding), "WHERE kind = ? AND id = ?", {kind, id});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::string JobStore::Result(const std::string& kind, const std::string& id) const {
  return impl_->Do([&](SqlDatabase& db) {
    const auto query =
        Query(db, "SELECT result FROM job JOIN job_text USING (number) WHERE kind = ? AND id = ?",
              kind, id);
    return query->Step() ? query->Text(0) : std::string();
  });
}

std::optional<JobRecord> JobStore::FindKey(const std::string& kind, const std::string& key) const {
  return impl_->SelectOne("key = ?", kind, key);
}

std::vector<JobRecord> JobStore::Unfinished(const std::string& kind) const {
  return impl_->Select(JobColumns(kEnding), "WHERE kind = ? AND ended IS NULL ORDER BY number",
                       {kind});
}

std::vector<JobRecord> JobStore::Ended(const std::string& kind) const {
  return impl_->Select(JobColumns(kEnding),
                       "WHERE kind = ? AND ended IS NOT NULL ORDER BY number DESC", {kind});
}

std::vector<JobRecord> JobStore::List() const {
  return impl_->Select(JobColumns(kEnding), "ORDER BY number DESC", {});
}

}  // namespace plenum::catalog
