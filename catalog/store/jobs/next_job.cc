#include "catalog/store/jobs/next_job.h"

#include <utility>

#include "catalog/store/jobs/job_rows.h"

namespace plenum::catalog {
namespace {

// Whose turn it is among the clients that wait. A scan of the index that skips from client to
// client, so that it costs as much as there are clients, not jobs.
constexpr char kClientsInTurn[] = R"sql(
WITH RECURSIVE top AS MATERIALIZED (
  SELECT max(priority) AS priority FROM job WHERE status = 'queued' AND version = ? AND kind IN @KINDS
), waiting (client) AS (
  (SELECT client FROM job WHERE status = 'queued' AND version = ? AND kind IN @KINDS
   AND priority = (SELECT priority FROM top) ORDER BY client LIMIT 1)
  UNION ALL
  SELECT (SELECT other.client FROM job AS other
          WHERE status = 'queued' AND version = ? AND kind IN @KINDS
            AND priority = (SELECT priority FROM top) AND other.client > waiting.client
          ORDER BY other.client LIMIT 1)
  FROM waiting WHERE waiting.client IS NOT NULL
)
SELECT client, (SELECT priority FROM top),
  (SELECT count(*) FROM job AS one WHERE one.status = 'running' AND one.client = waiting.client) AS at_work,
  coalesce((SELECT max(turn) FROM job AS one WHERE one.client = waiting.client), 0) AS last
FROM waiting WHERE client IS NOT NULL ORDER BY at_work, last, client
)sql";
constexpr char kBegin[] = R"sql(
UPDATE job SET status = 'running', starts = least(starts + 1, 1000000), attempt = ?, worker = ?,
  turn = nextval('job_turn'), change = nextval('job_change'), lease_until = @LEASE
WHERE number = (SELECT number FROM job
  WHERE status = 'queued' AND version = ? AND kind IN @KINDS AND priority = ? AND client = ?
  ORDER BY number LIMIT 1 FOR UPDATE SKIP LOCKED)
RETURNING @COLUMNS, (SELECT request FROM job_request AS of WHERE of.number = job.number), ''
)sql";

// "(?, ?)"
std::string PlacesOf(const std::vector<std::string>& values) {
  std::string places;
  for (std::size_t i = 0; i < values.size(); ++i) places += i == 0 ? "(?" : ", ?";
  return places + ")";
}

// With their priority, the next one first.
std::vector<std::pair<std::string, std::int64_t>> ClientsInTurn(
    SqlDatabase& db, const std::string& version, const std::vector<std::string>& kinds) {
  const auto turns = db.Prepare(Filled(kClientsInTurn, "@KINDS", PlacesOf(kinds)));
  std::vector<std::string> values;
  for (int i = 0; i < 3; ++i) {
    values.push_back(version);
    values.insert(values.end(), kinds.begin(), kinds.end());
  }
  BindTexts(*turns, values);
  std::vector<std::pair<std::string, std::int64_t>> clients;
  while (turns->Step()) clients.emplace_back(turns->Text(0), turns->Integer(1));
  return clients;
}

}  // namespace

std::string Filled(std::string sql, const std::string& name, const std::string& text) {
  for (auto at = sql.find(name); at != std::string::npos; at = sql.find(name, at + text.size()))
    sql.replace(at, name.size(), text);
  return sql;
}

void BindTexts(SqlStatement& statement, const std::vector<std::string>& values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    statement.Bind(static_cast<int>(i + 1), values[i]);
}

std::optional<JobRecord> BeginNext(SqlDatabase& db, const std::string& version,
                                   const std::vector<std::string>& kinds, const Beginning& as) {
  const std::string begin =
      Filled(Filled(Filled(kBegin, "@KINDS", PlacesOf(kinds)), "@LEASE", kLeaseUntil), "@COLUMNS",
             JobColumns(kChange));
  for (const auto& [client, priority] : ClientsInTurn(db, version, kinds)) {
    const auto update = db.Prepare(begin);
    int place = 0;
    update->Bind(++place, as.attempt);
    update->Bind(++place, as.worker);
    update->Bind(++place, std::int64_t{as.lease.count()});
    update->Bind(++place, version);
    for (const std::string& kind : kinds) update->Bind(++place, kind);
    update->Bind(++place, priority);
    update->Bind(++place, client);
    if (update->Step()) return ReadJob(*update);
  }
  return std::nullopt;
}

}  // namespace plenum::catalog
