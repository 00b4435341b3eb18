#include "server/render/text/text_jobs.h"

#include <sstream>
#include <utility>

#include "server/render/text/text_ranked.h"
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

using api::Json;
using Align = Table::Align;

std::string LastStep(const std::string& pointer) { return pointer.substr(pointer.rfind('/') + 1); }

std::string ShownInTable(const Json& value) {
  if (value.is_string()) return Cut(value.get<std::string>(), kNameMax);
  if (value.is_boolean()) return value.get<bool>() ? "yes" : "no";
  return Short(value);
}

// Of its answer, else of its job.
std::string StatusOf(const Json& row) {
  const Json& outcome = row.at("outcome");
  return ShownInTable(outcome.is_null() ? row.at("status") : outcome);
}

// Its pumps or bottles, else its configuration.
std::string SourceOfPart(const Json& row) {
  std::string source;
  if (row.at("parts").is_array())
    for (const Json& part : row.at("parts")) {
      const auto words = part.get<std::string>();
      for (const std::string family :
           {"compressor ", "cylinder ", "co2 ", "vacuum_pump ", "ejector "})
        if (const auto at = words.find(family); at == 0 || words.find("× " + family) != words.npos)
          source += (source.empty() ? "" : " + ") + words.substr(0, at) +
                    words.substr(at + family.size());
    }
  return source.empty() ? ShownInTable(row.at("configuration")) : source;
}

}  // namespace

std::string JobsText(const std::vector<catalog::JobRecord>& jobs) {
  if (jobs.empty()) return "no jobs\n";
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

std::string SweepText(const Json& sweep) {
  std::vector<Table::Column> columns = {{"patch", Align::kLeft}};
  for (const Json& pointer : sweep.at("varied"))
    columns.push_back({LastStep(pointer.get<std::string>())});
  for (const char* name : {"mass kg", "cost €", "objective"}) columns.push_back({name});
  columns.push_back({"status", Align::kLeft});
  for (const char* name : {"gap", "seconds"}) columns.push_back({name});
  columns.push_back({"source", Align::kLeft});
  Table table(std::move(columns));
  std::string why;
  for (const Json& row : sweep.at("rows")) {
    std::vector<std::string> cells = {Cut(row.at("name").get<std::string>(), kNameMax)};
    for (const Json& value : row.at("values")) cells.push_back(ShownInTable(value));
    for (const char* number : {"mass_kg", "cost_eur", "objective"})
      cells.push_back(Short(row.at(number)));
    cells.push_back(StatusOf(row));
    cells.push_back(Percent(row.at("gap")));
    cells.push_back(Short(row.at("seconds")));
    cells.push_back(SourceOfPart(row));
    table.Add(std::move(cells));
    for (const char* reason : {"conflict", "detail"})
      if (row.at(reason).is_string())
        why += row.at("name").get<std::string>() + ": " + row.at(reason).get<std::string>() + "\n";
  }
  return table.Text() + (why.empty() ? "" : "\n" + why);
}

}  // namespace plenum::server
