// Which job of a server is begun next, in SQL. Internal to the store.
#ifndef PLENUM_CATALOG_STORE_JOBS_NEXT_JOB_H_
#define PLENUM_CATALOG_STORE_JOBS_NEXT_JOB_H_

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "catalog/store/jobs/job_record.h"
#include "catalog/store/sql/sql_database.h"

namespace plenum::catalog {

// What tells one change of a job from another, also one ending.
inline constexpr char kChange[] = "change";
// The end of a lease of so many milliseconds, one value.
inline constexpr char kLeaseUntil[] =
    "clock_timestamp() + CAST(? AS double precision) * interval '1 ms'";

// The statement with the text in place of the name.
std::string Filled(std::string sql, const std::string& name, const std::string& text);
void BindTexts(SqlStatement& statement, const std::vector<std::string>& values);

struct Beginning {
  std::string attempt, worker;
  std::chrono::milliseconds lease;
};

// Begins the next job of the kinds that programs of this version may do: of the highest priority,
// then of the client with the fewest at work, then of the one who has waited longest for a turn,
// then the first, with its request. None where nothing waits, or others are about to begin what
// does.
std::optional<JobRecord> BeginNext(SqlDatabase& db, const std::string& version,
                                   const std::vector<std::string>& kinds, const Beginning& as);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_STORE_JOBS_NEXT_JOB_H_
