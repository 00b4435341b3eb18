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

}  // namespace

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
  job.ending = row.Integer(25);
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
