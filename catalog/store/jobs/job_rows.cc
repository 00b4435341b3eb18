#include "catalog/store/jobs/job_rows.h"

#include <array>

namespace plenum::catalog {
namespace {

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

std::string SweepColumns(const char* plan) {
  std::string columns =
      "SELECT number, id, name, who, coalesce(key, ''), coalesce(digest, ''), client, "
      "submitted_at, revision, hash, (SELECT coalesce(max(ended_at), '') FROM job WHERE job.sweep "
      "= "
      "sweep.id), ";
  for (const JobStatus status : kStatuses)
    columns += std::string("(SELECT count(*) FROM job WHERE job.sweep = sweep.id AND status = '") +
               Name(status) + "'), ";
  return columns + plan + " FROM sweep WHERE kind = ? ";
}

SweepRecord ReadSweep(const SqlStatement& row, const std::string& kind) {
  SweepRecord sweep;
  sweep.kind = kind;
  int column = 0;
  sweep.number = row.Integer(column++);
  for (std::string* text : {&sweep.id, &sweep.name, &sweep.by.who, &sweep.by.key, &sweep.by.request,
                            &sweep.client, &sweep.submitted_at})
    *text = row.Text(column++);
  sweep.revision = row.Integer(column++);
  sweep.hash = row.Text(column++);
  sweep.ended_at = row.Text(column++);
  for (const JobStatus status : kStatuses)
    sweep.jobs[status] = static_cast<int>(row.Integer(column++));
  sweep.plan = row.Text(column);
  if (sweep.jobs[JobStatus::kQueued] + sweep.jobs[JobStatus::kRunning] > 0) sweep.ended_at.clear();
  return sweep;
}

}  // namespace

bool InsertSweep(SqlDatabase& db, const SweepRecord& sweep) {
  const auto added =
      Query(db,
            std::string("INSERT INTO sweep (id, kind, name, who, key, digest, client, revision, "
                        "hash, plan, submitted_at) VALUES (?, ?, ?, ?, nullif(?, ''), nullif(?, "
                        "''), ?, ?, ?, ?, ") +
                db.words().now + ") ON CONFLICT DO NOTHING RETURNING number",
            sweep.id, sweep.kind, sweep.name, sweep.by.who, sweep.by.key, sweep.by.request,
            sweep.client, sweep.revision, sweep.hash, sweep.plan);
  return added->Step();
}

std::vector<SweepRecord> SelectSweeps(SqlDatabase& db, const std::string& kind, int limit) {
  const auto query =
      Query(db, SweepColumns("''") + "ORDER BY number DESC LIMIT " + std::to_string(limit), kind);
  std::vector<SweepRecord> sweeps;
  while (query->Step()) sweeps.push_back(ReadSweep(*query, kind));
  return sweeps;
}

std::optional<SweepRecord> SelectSweep(SqlDatabase& db, const std::string& kind, const char* column,
                                       const std::string& value) {
  const auto query = Query(db, SweepColumns("plan") + "AND " + column + " = ?", kind, value);
  return query->Step() ? std::optional(ReadSweep(*query, kind)) : std::nullopt;
}

JobRecord ReadJob(const SqlStatement& row) {
  const auto text = [&](int column) { return row.Text(column); };
  JobRecord job;
  job.id = text(0);
  job.order.kind = text(1);
  job.order.name = text(2);
  job.order.by = {text(3), text(4), text(5)};
  job.order.revision = row.Integer(6);
  job.order.hash = text(7);
  job.order.model = text(8);
  job.order.model_version = row.Integer(9);
  job.order.model_hash = text(10);
  job.starts = static_cast<int>(row.Integer(12));
  job.cancel_asked = row.Integer(13) != 0;
  job.submitted_at = text(14);
  job.ended_at = text(15);
  job.progress = text(16);
  job.failure = text(17);
  job.number = row.Integer(18);
  job.crashes = static_cast<int>(row.Integer(19));
  job.crashes_max = static_cast<int>(row.Integer(20));
  job.crash = text(21);
  job.alone = row.Integer(22) != 0;
  job.order.client = text(23);
  job.order.priority = static_cast<int>(row.Integer(24));
  job.order.sweep = text(25);
  job.order.place = static_cast<int>(row.Integer(26));
  job.ending = row.Integer(27);
  SetStatus(job, text(11));
  if (row.columns() > kRequestColumn) {
    job.order.request = text(kRequestColumn);
    job.result = text(kRequestColumn + 1);
  }
  return job;
}

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

}  // namespace plenum::catalog
