#include "catalog/store/job_store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <mutex>

#include "catalog/store/connection.h"

namespace plenum::catalog {
namespace {

constexpr int kBusyTimeoutMs = 2'000;
constexpr int kSchema = 3;
constexpr int kApplicationId = 1886154346;  // "plnj"

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

constexpr char kNow[] = "strftime('%Y-%m-%dT%H:%M:%SZ', 'now')";

// Without the two that may be long.
constexpr char kColumns[] =
    "id, kind, name, who, coalesce(key, ''), coalesce(digest, ''), revision, hash, model, "
    "model_version, model_hash, status, starts, cancel_asked, submitted_at, "
    "coalesce(ended_at, ''), progress, failure, number, crashes, crashes_max, crash, alone, "
    "client, bytes";
constexpr int kRequestColumn = 25;

constexpr std::array kStatuses = {JobStatus::kQueued, JobStatus::kRunning, JobStatus::kDone,
                                  JobStatus::kCancelled, JobStatus::kFailed};

void SetStatus(JobRecord& job, const std::string& name) {
  for (const JobStatus status : kStatuses) {
    if (name != Name(status)) continue;
    job.status = status;
    return;
  }
  job.status = JobStatus::kFailed;
  job.failure = "its record is damaged: it has the unknown status \"" + name + "\"";
}

JobRecord ReadRow(const SQLite::Statement& row) {
  const auto text = [&](int column) { return row.getColumn(column).getString(); };
  JobRecord job;
  job.id = text(0);
  job.order = {text(1), text(2), {text(3), text(4), text(5)}, "",       row.getColumn(6).getInt64(),
               text(7), text(8), row.getColumn(9).getInt64(), text(10), ""};
  job.starts = row.getColumn(12).getInt();
  job.cancel_asked = row.getColumn(13).getInt() != 0;
  job.submitted_at = text(14);
  job.ended_at = text(15);
  job.progress = text(16);
  job.failure = text(17);
  job.number = row.getColumn(18).getInt64();
  job.crashes = row.getColumn(19).getInt();
  job.crashes_max = row.getColumn(20).getInt();
  job.crash = text(21);
  job.alone = row.getColumn(22).getInt() != 0;
  job.order.client = text(23);
  // Only one of them had begun and so has a result: its size tells it from the others, all alike.
  job.ending = row.getColumn(24).getInt64();
  SetStatus(job, text(11));
  if (row.getColumnCount() > kRequestColumn) {
    job.order.request = text(kRequestColumn);
    job.result = text(kRequestColumn + 1);
  }
  return job;
}

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
    db.exec(kSchema3);
    db.exec("PRAGMA user_version = " + std::to_string(kSchema));
  }
  transaction.commit();
  return db;
}

// Binds the values in order, from the first place on.
template <class... Values>
void Execute(SQLite::Database& db, const std::string& sql, const Values&... values) {
  SQLite::Statement statement(db, sql);
  int place = 0;
  (statement.bind(++place, values), ...);
  statement.exec();
}

}  // namespace

const char* Name(JobStatus status) {
  switch (status) {
    case JobStatus::kQueued:
      return "queued";
    case JobStatus::kRunning:
      return "running";
    case JobStatus::kDone:
      return "done";
    case JobStatus::kCancelled:
      return "cancelled";
    case JobStatus::kFailed:
      return "failed";
  }
  return "";
}

bool Ended(JobStatus status) {
  return status != JobStatus::kQueued && status != JobStatus::kRunning;
}

struct JobStore::Impl {
  Impl(std::string file, const JobsKept& limits)
      : path(std::move(file)), kept(limits), db(Open(path)) {}

  // Runs `action` with the connection to itself and names the file in every error.
  template <class Action>
  auto Do(const Action& action) {
    const std::lock_guard lock(mutex);
    try {
      return action();
    } catch (const SQLite::Exception& error) {
      throw ToStoreError(path, error);
    }
  }

  std::vector<JobRecord> Select(const std::string& columns, const std::string& where,
                                const std::vector<std::string>& arguments) {
    return Do([&] {
      SQLite::Statement query(db, "SELECT " + columns + " FROM job WHERE " + where);
      int place = 0;
      for (const std::string& argument : arguments) query.bind(++place, argument);
      std::vector<JobRecord> jobs;
      while (query.executeStep()) jobs.push_back(ReadRow(query));
      return jobs;
    });
  }
  std::optional<JobRecord> SelectOne(const std::string& where, const std::string& kind,
                                     const std::string& argument) {
    auto found = Select(std::string(kColumns) + ", request, result", "kind = ? AND " + where,
                        {kind, argument});
    return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
  }

  void DropOld(const std::string& kind) {
    Execute(
        db,
        "DELETE FROM job WHERE number IN (SELECT number FROM ("
        "  SELECT number, row_number() OVER newest AS place, sum(bytes) OVER newest AS total"
        "  FROM job WHERE kind = ? AND ended IS NOT NULL WINDOW newest AS (ORDER BY ended DESC))"
        " WHERE place > 1 AND (place > ? OR total > ?))",
        kind, kept.jobs, kept.bytes);
  }

  const std::string path;
  const JobsKept kept;
  SQLite::Database db;
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
  impl_->Do([&] {
    SQLite::Statement insert(
        impl_->db,
        std::string(
            "INSERT INTO job (id, kind, name, who, key, digest, revision, hash, "
            "model, model_version, model_hash, client, status, submitted_at, bytes, request) "
            "VALUES (?, ?, ?, ?, nullif(?, ''), nullif(?, ''), ?, ?, ?, ?, ?, ?, "
            "'queued', ") +
            kNow + ", ?, ?)");
    int place = 0;
    for (const std::string* text :
         {&id, &order.kind, &order.name, &order.by.who, &order.by.key, &order.by.request})
      insert.bind(++place, *text);
    insert.bind(++place, order.revision);
    insert.bind(++place, order.hash);
    insert.bind(++place, order.model);
    insert.bind(++place, order.model_version);
    insert.bind(++place, order.model_hash);
    insert.bind(++place, order.client);
    insert.bind(++place, static_cast<std::int64_t>(order.request.size()));
    insert.bind(++place, order.request);
    insert.exec();
  });
  return Find(order.kind, id).value();
}

void JobStore::Start(const std::string& id) {
  impl_->Do([&] {
    Execute(impl_->db,
            "UPDATE job SET status = 'running', starts = min(starts + 1, 1000000) WHERE id = ?",
            id);
  });
}

void JobStore::Requeue(const std::string& id) {
  impl_->Do([&] {
    Execute(impl_->db, "UPDATE job SET status = 'queued', starts = max(0, starts - 1) WHERE id = ?",
            id);
  });
}

void JobStore::AskToCancel(const std::string& id) {
  impl_->Do([&] {
    Execute(impl_->db, "UPDATE job SET cancel_asked = 1 WHERE id = ? AND ended IS NULL", id);
  });
}

void JobStore::RequeueInterrupted(const std::vector<JobCrash>& crashes) {
  impl_->Do([&] {
    SQLite::Transaction transaction(impl_->db, SQLite::TransactionBehavior::IMMEDIATE);
    for (const JobCrash& crash : crashes)
      Execute(impl_->db,
              "UPDATE OR IGNORE job SET crashes = min(crashes + 1, 1000000), crash = substr(?, 1, "
              "1000) "
              "WHERE number = ? AND status = 'running'",
              crash.what, crash.number);
    impl_->db.exec(
        "UPDATE OR IGNORE job SET status = 'queued', alone = 1 WHERE status = 'running'");
    transaction.commit();
  });
}

void JobStore::Again(const std::string& id) {
  impl_->Do([&] {
    Execute(impl_->db,
            "UPDATE job SET status = 'queued', ended = NULL, ended_at = NULL, cancel_asked = 0, "
            "progress = '', failure = '', result = '', bytes = length(CAST(request AS BLOB)), "
            "alone = crashes > 0, crashes_max = max(2, crashes + 1) WHERE id = ?",
            id);
  });
}

std::string JobStore::End(const JobRecord& record) {
  std::string ended_at;
  impl_->Do([&] {
    SQLite::Transaction transaction(impl_->db, SQLite::TransactionBehavior::IMMEDIATE);
    Execute(impl_->db,
            std::string("UPDATE job SET status = ?, progress = ?, result = ?, failure = ?, "
                        "bytes = bytes + ?, ended = (SELECT coalesce(max(ended), 0) + 1 FROM job), "
                        "ended_at = ") +
                kNow + " WHERE id = ?",
            std::string(Name(record.status)), record.progress, record.result, record.failure,
            static_cast<std::int64_t>(record.result.size()), record.id);
    SQLite::Statement when(impl_->db, "SELECT ended_at FROM job WHERE id = ?");
    when.bind(1, record.id);
    if (when.executeStep()) ended_at = when.getColumn(0).getString();
    impl_->DropOld(record.order.kind);
    transaction.commit();
  });
  return ended_at;
}

std::optional<JobRecord> JobStore::Find(const std::string& kind, const std::string& id) const {
  return impl_->SelectOne("id = ?", kind, id);
}

std::optional<JobRecord> JobStore::Peek(const std::string& kind, const std::string& id) const {
  auto found = impl_->Select(kColumns, "kind = ? AND id = ?", {kind, id});
  return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
}

std::string JobStore::Result(const std::string& kind, const std::string& id) const {
  return impl_->Do([&] {
    SQLite::Statement query(impl_->db, "SELECT result FROM job WHERE kind = ? AND id = ?");
    query.bind(1, kind);
    query.bind(2, id);
    return query.executeStep() ? query.getColumn(0).getString() : std::string();
  });
}

std::optional<JobRecord> JobStore::FindKey(const std::string& kind, const std::string& key) const {
  return impl_->SelectOne("key = ?", kind, key);
}

std::vector<JobRecord> JobStore::Unfinished(const std::string& kind) const {
  return impl_->Select(kColumns, "kind = ? AND ended IS NULL ORDER BY number", {kind});
}

std::vector<JobRecord> JobStore::Ended(const std::string& kind) const {
  return impl_->Select(kColumns, "kind = ? AND ended IS NOT NULL ORDER BY number DESC", {kind});
}

std::vector<JobRecord> JobStore::List() const {
  return impl_->Select(kColumns, "true ORDER BY number DESC", {});
}

}  // namespace plenum::catalog
