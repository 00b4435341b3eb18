#include "catalog/store/jobs/shared_job_store.h"

#include <sys/random.h>

#include <algorithm>
#include <utility>

#include "catalog/store/jobs/job_rows.h"
#include "catalog/store/jobs/next_job.h"
#include "catalog/store/server_session.h"

namespace plenum::catalog {
namespace {

constexpr char kTakeFromLost[] = R"sql(
WITH lost AS (
  SELECT number AS id, cancel_asked = 1 OR crashes + 1 >= crashes_max AS over FROM job
  WHERE status = 'running' AND lease_until < clock_timestamp() LIMIT 100 FOR UPDATE SKIP LOCKED)
UPDATE job SET crashes = least(crashes + 1, 1000000), attempt = '', lease_until = NULL,
  crash = left('the loss of worker ' || worker || ' at ' || @NOW, 1000), change = nextval('job_change'),
  status = CASE WHEN cancel_asked = 1 THEN 'cancelled' WHEN over THEN 'failed' ELSE 'queued' END,
  failure = CASE WHEN over AND cancel_asked = 0 THEN crashes + 1 || ' workers were lost while they '
    'computed this job, so nothing begins it by itself any more; a person can ask for it again'
    ELSE '' END,
  ended = CASE WHEN over THEN nextval('job_ending') END, ended_at = CASE WHEN over THEN @NOW END
FROM lost WHERE number = lost.id
)sql";

// 64 random bits.
std::string RandomToken() {
  std::uint64_t bits = 0;
  if (getrandom(&bits, sizeof bits, 0) != sizeof bits) throw SqlError("no random numbers");
  std::string token;
  for (int shift = 60; shift >= 0; shift -= 4) token += "0123456789abcdef"[bits >> shift & 15];
  return token;
}

// PostgreSQL keeps no NUL.
std::string Plain(std::string text) {
  std::replace(text.begin(), text.end(), '\0', ' ');
  return text;
}

// False where its id or key has a job already.
bool InsertJob(SqlDatabase& db, const std::string& version, const NewJob& job) {
  const JobOrder& order = job.order;
  const auto added = Query(
      db,
      std::string(
          "INSERT INTO job (id, kind, version, name, who, key, digest, revision, hash, "
          "model, model_version, model_hash, client, priority, sweep, place, bytes, "
          "submitted_at) VALUES (?, ?, ?, ?, ?, nullif(?, ''), nullif(?, ''), ?, ?, ?, ?, ?, "
          "?, ?, nullif(?, ''), ?, ?, ") +
          db.words().now + ") ON CONFLICT DO NOTHING RETURNING number",
      job.id, order.kind, version, Plain(order.name), order.by.who, order.by.key, order.by.request,
      order.revision, order.hash, order.model, order.model_version, order.model_hash, order.client,
      order.priority, order.sweep, order.place, static_cast<std::int64_t>(order.request.size()));
  if (!added->Step()) return false;
  Run(db, "INSERT INTO job_request VALUES (?, ?)", added->Integer(0), order.request);
  return true;
}

std::vector<JobRecord> ReadJobs(SqlStatement& query) {
  std::vector<JobRecord> jobs;
  while (query.Step()) jobs.push_back(ReadJob(query));
  return jobs;
}

// Jobs whose column has this value.
void CancelWhere(SqlDatabase& db, const std::string& column, const std::string& value) {
  Run(db,
      std::string("UPDATE job SET status = 'cancelled', cancel_asked = 1, ended = "
                  "nextval('job_ending'), change = nextval('job_change'), ended_at = ") +
          db.words().now + " WHERE " + column + " = ? AND status = 'queued'",
      value);
  Run(db,
      "UPDATE job SET cancel_asked = 1, change = nextval('job_change') WHERE " + column +
          " = ? AND status = 'running'",
      value);
}

}  // namespace

struct SharedJobStore::Impl : ServerSession {
  Impl(const std::string& address, std::string of_program)
      : ServerSession(address), version(std::move(of_program)) {}

  template <class Action>
  auto Read(const Action& action) {
    return Do(Purpose::kRead, action);
  }
  // The statement's first row, if there is one: whether it did something.
  template <class... Values>
  bool Act(const std::string& sql, const Values&... values) {
    return Do(Purpose::kRows, [&](SqlDatabase& on) { return Query(on, sql, values...)->Step(); });
  }
  std::int64_t Count(const std::string& what, const std::vector<std::string>& values) {
    return Read([&](SqlDatabase& on) {
      const auto query = on.Prepare("SELECT " + what);
      BindTexts(*query, values);
      return query->Step() ? query->Integer(0) : 0;
    });
  }
  std::vector<JobRecord> Select(const std::string& where, const std::vector<std::string>& values) {
    return Read([&](SqlDatabase& on) {
      const auto query = on.Prepare("SELECT " + JobColumns(kChange) + " FROM job WHERE " + where);
      BindTexts(*query, values);
      return ReadJobs(*query);
    });
  }
  std::optional<JobRecord> SelectOne(const std::string& where,
                                     const std::vector<std::string>& values) {
    auto found = Select(where, values);
    return found.empty() ? std::nullopt : std::optional(std::move(found.front()));
  }

  const std::string version;
};

SharedJobStore::SharedJobStore(const std::string& address, std::string version)
    : impl_(std::make_unique<Impl>(address, std::move(version))) {}

SharedJobStore::~SharedJobStore() = default;

std::optional<JobRecord> SharedJobStore::Add(const std::string& id, const JobOrder& order) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    return InsertJob(db, impl_->version, {id, order});
  });
  return Peek(order.kind, id);  // also where the first answer was lost
}

std::optional<SweepRecord> SharedJobStore::AddSweep(const SweepRecord& sweep,
                                                    const std::vector<NewJob>& jobs) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    SweepRecord plain = sweep;
    plain.name = Plain(plain.name);
    if (!InsertSweep(db, plain)) return false;
    for (const NewJob& job : jobs)
      if (!InsertJob(db, impl_->version, job)) throw SqlError("an id of a job is taken");
    return true;
  });
  return FindSweep(sweep.kind, sweep.id);  // also where the first answer was lost
}

std::optional<SweepRecord> SharedJobStore::FindSweep(const std::string& kind,
                                                     const std::string& id) const {
  return impl_->Read([&](SqlDatabase& db) { return SelectSweep(db, kind, "id", id); });
}

std::optional<SweepRecord> SharedJobStore::FindSweepKey(const std::string& kind,
                                                        const std::string& key) const {
  return impl_->Read([&](SqlDatabase& db) { return SelectSweep(db, kind, "key", key); });
}

std::vector<SweepRecord> SharedJobStore::Sweeps(const std::string& kind, int limit) const {
  return impl_->Read([&](SqlDatabase& db) { return SelectSweeps(db, kind, limit); });
}

std::vector<JobRecord> SharedJobStore::OfSweep(const std::string& id) const {
  return impl_->Select("sweep = ? ORDER BY place", {id});
}

std::size_t SharedJobStore::Count(const std::string& kind, JobStatus status) const {
  return static_cast<std::size_t>(impl_->Count("count(*) FROM job WHERE status = ? AND kind = ?",
                                               {catalog::Name(status), kind}));
}

std::size_t SharedJobStore::Waiting(const std::string& kind,
                                    const std::optional<std::string>& client,
                                    bool of_sweeps) const {
  std::vector<std::string> values = {kind};
  if (client) values.push_back(*client);
  return static_cast<std::size_t>(
      impl_->Count(std::string("count(*) FROM job WHERE status = 'queued' AND kind = ?") +
                       (client ? " AND client = ?" : "") +
                       (of_sweeps ? " AND sweep IS NOT NULL" : " AND sweep IS NULL"),
                   values));
}

std::optional<JobRecord> SharedJobStore::Peek(const std::string& kind,
                                              const std::string& id) const {
  return impl_->SelectOne("kind = ? AND id = ?", {kind, id});
}

std::optional<JobRecord> SharedJobStore::FindKey(const std::string& kind,
                                                 const std::string& key) const {
  return impl_->SelectOne("kind = ? AND key = ?", {kind, key});
}

std::string SharedJobStore::Result(const std::string& kind, const std::string& id) const {
  return impl_->Read([&](SqlDatabase& db) {
    const auto query =
        Query(db, "SELECT result FROM job JOIN job_result USING (number) WHERE kind = ? AND id = ?",
              kind, id);
    return query->Step() ? query->Text(0) : std::string();
  });
}

std::vector<JobRecord> SharedJobStore::List(const std::string& kind, int limit) const {
  const std::string newest = " ORDER BY number DESC LIMIT " + std::to_string(limit);
  return kind.empty() ? impl_->Select("true" + newest, {})
                      : impl_->Select("kind = ?" + newest, {kind});
}

void SharedJobStore::Cancel(const std::string& id) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    CancelWhere(db, "id", id);
    return true;
  });
}

void SharedJobStore::CancelSweep(const std::string& id) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    CancelWhere(db, "sweep", id);
    return true;
  });
}

bool SharedJobStore::Again(const std::string& id) {
  return impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    const auto queued = Query(
        db,
        "UPDATE job SET status = 'queued', version = ?, ended = NULL, ended_at = NULL, "
        "cancel_asked = 0, progress = '', failure = '', attempt = '', crashes_max = greatest(10, "
        "crashes + 1), change = nextval('job_change') WHERE id = ? AND status IN ('failed', "
        "'cancelled') RETURNING number",
        impl_->version, id);
    if (!queued->Step()) return false;
    const std::int64_t number = queued->Integer(0);
    Run(db,
        "UPDATE job SET bytes = (SELECT octet_length(request) FROM job_request WHERE number = ?) "
        "WHERE number = ?",
        number, number);
    Run(db, "DELETE FROM job_result WHERE number = ?", number);
    return true;
  });
}

std::int64_t SharedJobStore::LastChange() const {
  return impl_->Count("last_value FROM job_change", {});
}

QueueState SharedJobStore::Queue(std::chrono::milliseconds lease) const {
  return impl_->Read([&](SqlDatabase& db) {
    QueueState state;
    const auto jobs =
        Query(db,
              "SELECT count(*) FILTER (WHERE status = 'queued'), count(*) FILTER (WHERE status = "
              "'running'), coalesce(min(submitted_at COLLATE \"C\") FILTER (WHERE status = "
              "'queued'), '') "
              "FROM job WHERE status = 'queued' OR status = 'running'");
    if (jobs->Step()) {
      state.waiting = jobs->Integer(0);
      state.running = jobs->Integer(1);
      state.oldest = jobs->Text(2);
    }
    const auto workers =
        Query(db,
              "SELECT count(*), coalesce(sum(threads), 0)::bigint FROM worker WHERE seen_at > "
              "clock_timestamp() - CAST(? AS double precision) * interval '1 ms'",
              std::int64_t{lease.count()});
    if (workers->Step()) {
      state.workers = workers->Integer(0);
      state.threads = workers->Integer(1);
    }
    return state;
  });
}

std::optional<JobClaim> SharedJobStore::Claim(const std::vector<std::string>& kinds,
                                              const std::string& worker,
                                              std::chrono::milliseconds lease) {
  const std::string attempt = RandomToken();
  bool again = false;
  return impl_->Do(Purpose::kRows, [&](SqlDatabase& db) -> std::optional<JobClaim> {
    std::optional<JobRecord> job;
    if (std::exchange(again, true)) {  // the first answer was lost
      const auto claimed =
          Query(db,
                "SELECT " + JobColumns(kChange) +
                    ", request, '' FROM job JOIN job_request USING (number) WHERE status = "
                    "'running' AND attempt = ?",
                attempt);
      if (claimed->Step()) job = ReadJob(*claimed);
    }
    if (!job) job = BeginNext(db, impl_->version, kinds, {attempt, worker, lease});
    if (!job) return std::nullopt;
    return JobClaim{*std::move(job), attempt};
  });
}

Heartbeat SharedJobStore::See(const JobClaim& claim) const {
  return impl_->Read([&](SqlDatabase& db) -> Heartbeat {
    const auto held = Query(
        db, "SELECT cancel_asked FROM job WHERE number = ? AND status = 'running' AND attempt = ?",
        claim.job.number, claim.attempt);
    if (!held->Step()) return {};
    return {true, held->Integer(0) != 0};
  });
}

Heartbeat SharedJobStore::Extend(const JobClaim& claim, const std::string& progress,
                                 std::chrono::milliseconds lease) {
  return impl_->Do(Purpose::kRows, [&](SqlDatabase& db) -> Heartbeat {
    const auto held =
        Query(db, Filled("UPDATE job SET lease_until = @LEASE", "@LEASE", kLeaseUntil) +
                      (progress.empty() ? "" : ", progress = ?, change = nextval('job_change')") +
                      " WHERE number = ? AND status = 'running' AND attempt = ? "
                      "RETURNING cancel_asked");
    int place = 0;
    held->Bind(++place, std::int64_t{lease.count()});
    if (!progress.empty()) held->Bind(++place, progress);
    held->Bind(++place, claim.job.number);
    held->Bind(++place, claim.attempt);
    if (!held->Step()) return {};
    return {true, held->Integer(0) != 0};
  });
}

bool SharedJobStore::End(const JobClaim& claim, const JobRecord& outcome) {
  return impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    const std::int64_t number = claim.job.number;
    const auto ended = Query(
        db,
        std::string("UPDATE job SET status = ?, progress = ?, failure = ?, bytes = bytes + ?, "
                    "lease_until = NULL, ended = nextval('job_ending'), change = "
                    "nextval('job_change'), ended_at = ") +
            db.words().now +
            " WHERE number = ? AND status = 'running' AND attempt = ? RETURNING number",
        Name(outcome.status), outcome.progress, Plain(outcome.failure),
        static_cast<std::int64_t>(outcome.result.size()), number, claim.attempt);
    if (!ended->Step())
      return Query(db, "SELECT 1 FROM job WHERE number = ? AND attempt = ? AND ended IS NOT NULL",
                   number, claim.attempt)
          ->Step();
    if (!outcome.result.empty())
      Run(db, "INSERT INTO job_result VALUES (?, ?)", number, outcome.result);
    return true;
  });
}

void SharedJobStore::GiveBack(const JobClaim& claim) {
  impl_->Act(
      "UPDATE job SET status = 'queued', starts = greatest(0, starts - 1), attempt = '', "
      "lease_until = NULL, change = nextval('job_change') WHERE number = ? AND status = 'running' "
      "AND attempt = ? RETURNING number",
      claim.job.number, claim.attempt);
}

void SharedJobStore::TakeFromLost() {
  impl_->Do(Purpose::kRows, [](SqlDatabase& db) {
    Run(db, Filled(kTakeFromLost, "@NOW", db.words().now));
    return true;
  });
}

void SharedJobStore::Seen(const WorkerRecord& worker) {
  impl_->Act(
      "INSERT INTO worker VALUES (?, ?, ?, ?, clock_timestamp()) ON CONFLICT (id) DO UPDATE SET "
      "threads = excluded.threads, seen_at = excluded.seen_at RETURNING id",
      worker.id, worker.name, worker.version, worker.threads);
}

void SharedJobStore::Leave(const std::string& worker_id) {
  impl_->Act(
      "DELETE FROM worker WHERE id = ? OR seen_at < clock_timestamp() - interval '1 day' RETURNING "
      "id",
      worker_id);
}

void SharedJobStore::DropOld(const std::string& kind, const JobsKept& kept) {
  impl_->Do(Purpose::kRows, [&](SqlDatabase& db) {
    Run(db, kOldJobs, kind, kept.jobs, kept.bytes);
    Run(db, kEmptySweeps, kind);
    return true;
  });
}

}  // namespace plenum::catalog
