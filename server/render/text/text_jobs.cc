#include "server/render/text/text_jobs.h"

#include <sstream>

#include "server/render/text/text_table.h"

namespace plenum::server {
namespace {

constexpr std::size_t kColumnsMax = 100;
constexpr std::size_t kNameMax = 24;  // what the other columns leave of a line

// Words on lines of at most kColumnsMax characters, all but the first indented.
std::string Wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string lines, line;
  for (std::string word; words >> word;) {
    if (!line.empty() && line.size() + 1 + word.size() > kColumnsMax) {
      lines += line + "\n";
      line = "   ";
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line + "\n";
}

// "2026-01-31 12:00" of 2026-01-31T12:00:00Z.
std::string Minute(const std::string& time) {
  return time.size() < 16 ? time : time.substr(0, 10) + " " + time.substr(11, 5);
}

}  // namespace

std::string JobsText(const std::vector<catalog::JobRecord>& jobs) {
  if (jobs.empty()) return "no jobs\n";
  using Align = Table::Align;
  Table table({{"id", Align::kLeft},
               {"kind", Align::kLeft},
               {"status", Align::kLeft},
               {"asked for (UTC)", Align::kLeft},
               {"attempts"},
               {"crashes"},
               {"name", Align::kLeft}});
  std::string failures;
  for (const catalog::JobRecord& job : jobs) {
    table.Add({job.id, job.order.kind, catalog::Name(job.status), Minute(job.submitted_at),
               std::to_string(job.starts), std::to_string(job.crashes),
               Cut(job.order.name, kNameMax)});
    if (job.status == catalog::JobStatus::kFailed)
      failures += Wrapped(job.id + " failed: " + job.failure);
  }
  return table.Text() + (failures.empty() ? "" : "\n" + failures);
}

api::Json RenderJob(const catalog::JobRecord& job) {
  api::Json json = {
      {"id", job.id},
      {"kind", job.order.kind},
      {"name", job.order.name},
      {"status", catalog::Name(job.status)},
      {"submitted_at", job.submitted_at},
      {"ended_at", job.ended_at.empty() ? api::Json() : api::Json(job.ended_at)},
      {"attempts", job.starts},
      {"crashes", job.crashes},
      {"last_crash", job.crash.empty() ? api::Json() : api::Json(job.crash)},
      {"catalogue_revision", {{"number", job.order.revision}, {"hash", job.order.hash}}}};
  if (job.status == catalog::JobStatus::kFailed) json["detail"] = job.failure;
  return json;
}

}  // namespace plenum::server
