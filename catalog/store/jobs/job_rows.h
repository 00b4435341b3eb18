// Jobs from the columns of their tables, which a file and a server call the same.
#ifndef PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_
#define PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_

#include <optional>
#include <string>
#include <vector>

#include "catalog/store/jobs/job_record.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// Without the two that may be long. `ending`: what tells one ending of a job from another.
inline std::string JobColumns(const char* ending) {
  return std::string(
             "id, kind, name, who, coalesce(key, ''), coalesce(digest, ''), revision, hash, model, "
             "model_version, model_hash, status, starts, cancel_asked, submitted_at, "
             "coalesce(ended_at, ''), progress, failure, number, crashes, crashes_max, crash, "
             "alone, client, priority, coalesce(sweep, ''), place, ") +
         ending;
}
inline constexpr int kRequestColumn = 28;
// How the old jobs of a kind are found, in SQL: all but the newest that ended, whose three values
// are the kind, how many are kept and how many bytes. A sweep is old when all its jobs are.
inline constexpr char kOldJobs[] = R"sql(
WITH old AS (SELECT number FROM (
  SELECT number, row_number() OVER newest AS place, sum(bytes) OVER newest AS total
  FROM job WHERE kind = ? AND ended IS NOT NULL WINDOW newest AS (ORDER BY ended DESC)) AS those
  WHERE place > 1 AND (place > ? OR total > ?))
DELETE FROM job WHERE number IN (SELECT number FROM old) AND (sweep IS NULL OR NOT EXISTS (
  SELECT 1 FROM job AS other
  WHERE other.sweep = job.sweep AND other.number NOT IN (SELECT number FROM old)))
)sql";
inline constexpr char kEmptySweeps[] =
    "DELETE FROM sweep WHERE kind = ? AND NOT EXISTS (SELECT 1 FROM job WHERE job.sweep = "
    "sweep.id)";

// Of a row of JobColumns and, where they were asked for, `request` and `result`. One that makes no
// sense is given as failed, with the reason.
JobRecord ReadJob(const SqlStatement& row);

// Writes a sweep without its jobs; false where its id or key has one already.
bool InsertSweep(SqlDatabase& db, const SweepRecord& sweep);
// Sweeps of a kind, without their plans, newest first.
std::vector<SweepRecord> SelectSweeps(SqlDatabase& db, const std::string& kind, int limit);
// The sweep whose `column` has the value, with its plan.
std::optional<SweepRecord> SelectSweep(SqlDatabase& db, const std::string& kind, const char* column,
                                       const std::string& value);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_JOB_ROWS_H_
