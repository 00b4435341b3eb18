// What the end of the last service left of its jobs.
#ifndef PLENUM_SERVER_JOBS_JOB_RECOVERY_H_
#define PLENUM_SERVER_JOBS_JOB_RECOVERY_H_

#include <filesystem>

#include "api/catalogue/stores.h"

namespace plenum::server {

// For who opened the store, before any job begins: jobs that were under way are queued again, to
// run alone. Jobs that crashed the program (`marks_file`, server/jobs/crash_marks.h) as often as
// they may and those whose record is damaged end as failed. No job is a reason to throw.
void RecoverJobs(catalog::JobStore& store, const std::filesystem::path& marks_file);

}  // namespace plenum::server

#endif  // PLENUM_SERVER_JOBS_JOB_RECOVERY_H_
