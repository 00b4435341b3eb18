#include "server/jobs/job_recovery.h"

#include <string>
#include <vector>

#include "server/call/request_log.h"
#include "server/jobs/crash_marks.h"

namespace plenum::server {
namespace {

std::string Times(int count) {
  return count == 1 ? "once" : count == 2 ? "twice" : std::to_string(count) + " times";
}

// Why the job is not begun again; empty where it is.
std::string WhyOver(const catalog::JobRecord& record) {
  if (record.status == catalog::JobStatus::kFailed) return record.failure;
  if (record.crashes < record.crashes_max) return "";
  return "the program ended while it computed this job, " + Times(record.crashes) + ", the last " +
         "time by " + record.crash + ". This is a fault of the program: please report it. " +
         "Nothing begins the job by itself any more; a person can ask for it again";
}

}  // namespace

void RecoverJobs(catalog::JobStore& store, const std::filesystem::path& marks_file) {
  std::vector<catalog::JobCrash> crashes;
  for (const CrashMark& mark : ReadCrashMarks(marks_file))
    crashes.push_back({mark.job, Describe(mark)});
  store.RequeueInterrupted(crashes);
  for (catalog::JobRecord& record : store.List()) {
    if (!record.ended_at.empty() || record.cancel_asked) continue;
    const std::string why = WhyOver(record);
    if (why.empty()) continue;
    record.status = catalog::JobStatus::kFailed;
    record.failure = why;
    try {
      store.End(record);
    } catch (const catalog::StoreError& error) {
      Log({{"level", "error"}, {"job", record.id}, {"fault", error.what()}});
    }
  }
}

}  // namespace plenum::server
