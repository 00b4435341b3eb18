// Jobs from the columns of their tables, which a file and a server call the same.
#ifndef PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_
#define PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_

#include <string>

#include "catalog/store/jobs/job_record.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// Without the two that may be long. `ending`: what tells one ending of a job from another.
inline std::string JobColumns(const char* ending) {
  return std::string(
             "id, kind, name, who, coalesce(key, ''), coalesce(digest, ''), revision, hash, model, "
             "model_version, model_hash, status, starts, cancel_asked, submitted_at, "
             "coalesce(ended_at, ''), progress, failure, number, crashes, crashes_max, crash, "
             "alone, client, priority, ") +
         ending;
}
inline constexpr int kRequestColumn = 26;

// Of a row of JobColumns and, where they were asked for, `request` and `result`. One that makes no
// sense is given as failed, with the reason.
JobRecord ReadJob(const SqlStatement& row);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_
