#include "server/resources/sweeps_resource.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "api/design/sweep/sweep_request.h"
#include "api/design/sweep/sweep_table.h"
#include "server/call/coding/accepted.h"
#include "server/call/service_limits.h"
#include "server/call/signature.h"
#include "server/jobs/job_inputs.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using catalog::JobRecord;
using catalog::SweepRecord;

constexpr char kPath[] = "/v1/sweeps/";
constexpr char kCsvType[] = "text/csv";

JobStatus StatusOf(const SweepRecord& sweep) {
  const auto any = [&](JobStatus status) {
    const auto found = sweep.jobs.find(status);
    return found != sweep.jobs.end() && found->second > 0;
  };
  if (any(JobStatus::kRunning)) return JobStatus::kRunning;
  const bool some_ended =
      any(JobStatus::kDone) || any(JobStatus::kFailed) || any(JobStatus::kCancelled);
  if (any(JobStatus::kQueued)) return some_ended ? JobStatus::kRunning : JobStatus::kQueued;
  if (any(JobStatus::kCancelled)) return JobStatus::kCancelled;
  return any(JobStatus::kFailed) ? JobStatus::kFailed : JobStatus::kDone;
}

api::Json Links(const std::string& id) {
  return {{"self", kPath + id}, {"table", kPath + id + "/table"}};
}

api::Json Short(const SweepRecord& sweep) {
  return {{"id", sweep.id}, {"status", Name(StatusOf(sweep))}, {"links", Links(sweep.id)}};
}

api::Json Long(const SweepRecord& sweep) {
  api::Json counts = api::Json::object();
  for (const auto& [status, count] : sweep.jobs) counts[Name(status)] = count;
  return {{"id", sweep.id},
          {"name", sweep.name},
          {"status", Name(StatusOf(sweep))},
          {"submitted_at", sweep.submitted_at},
          {"ended_at", sweep.ended_at.empty() ? api::Json() : api::Json(sweep.ended_at)},
          {"catalogue_revision", {{"number", sweep.revision}, {"hash", sweep.hash}}},
          {"jobs", std::move(counts)},
          {"links", Links(sweep.id)}};
}

Reply NoSweep(const std::string& id) {
  return ProblemReply(404, "no sweep has the id " + id +
                               "; one is kept as long as its newest job is among those that are");
}

// Of each patch its job, as far as it is kept.
std::vector<std::optional<JobRecord>> JobsOfPatches(const JobsResource& designs,
                                                    const std::string& id, std::size_t patches) {
  std::vector<std::optional<JobRecord>> jobs(patches);
  for (JobRecord& job : designs.jobs->OfSweep(id)) {
    const auto place = static_cast<std::size_t>(job.order.place);
    if (place < patches) jobs[place] = std::move(job);
  }
  return jobs;
}

api::Json TableOf(const JobsResource& designs, const SweepRecord& sweep) {
  const api::Json plan = api::Json::parse(sweep.plan);
  std::vector<api::SweptAnswer> answers;
  for (const auto& job : JobsOfPatches(designs, sweep.id, plan.at("patches").size())) {
    api::SweptAnswer& answer = answers.emplace_back();
    if (!job) continue;
    answer = {Name(job->status), nullptr, job->failure, designs.path + "/" + job->id};
    const api::Json progress = api::Json::parse(job->progress, nullptr, false);
    if (Ended(job->status) && progress.is_object() && progress.contains("row"))
      answer.row = progress.at("row");
  }
  api::Json table = api::RenderSweepTable(plan, answers);
  table["catalogue_revision"] = {{"number", sweep.revision}, {"hash", sweep.hash}};
  return table;
}

bool WantsCsv(const Call& call) {
  if (const auto format = QueryValue(call, "format")) return *format == "csv";
  const std::string accept = call.header("Accept").value_or("*/*");
  return Wanted(accept, {kCsvType, "text/*"}) >
         Wanted(accept, {"application/json", "application/*", "*/*"});
}

Reply TableReply(const JobsResource& designs, const SweepRecord& sweep, bool as_csv) {
  const api::Json table = TableOf(designs, sweep);
  Reply reply =
      as_csv ? Reply{200, "text/csv; charset=utf-8; header=present", api::SweepCsv(table), {}, {}}
             : JsonReply(200, table);
  reply.headers.emplace_back("Vary", "Accept");
  return reply;
}

Reply SweepAccepted(const JobsResource& designs, const std::string& id) {
  const auto sweep = designs.jobs->FindSweep(id);
  auto reply = JsonReply(202, sweep ? Short(*sweep) : api::Json{{"id", id}, {"links", Links(id)}});
  reply.headers.emplace_back("Location", kPath + id);
  return reply;
}

// The table once all jobs have ended, or 202 when the time is over.
std::optional<Reply> EndedReply(const JobsResource& designs, const std::string& id, bool is_over,
                                int seconds, bool as_csv) {
  const auto sweep = designs.jobs->FindSweep(id);
  if (sweep && sweep->ended_at.empty() && !is_over) return std::nullopt;
  if (!sweep || sweep->ended_at.empty()) return SweepAccepted(designs, id);
  Reply reply = TableReply(designs, *sweep, as_csv);
  reply.headers.emplace_back("Preference-Applied", "wait=" + std::to_string(seconds));
  reply.headers.emplace_back("Location", kPath + id);
  return reply;
}

// One job after the other is awaited, so that a look costs as much as that of one job.
Reply AwaitSweep(const JobsResource& designs, const Call& call, const std::string& id) {
  const int seconds = WaitSeconds(call);
  auto turn = seconds > 0 ? EnterWaiting() : nullptr;
  if (!turn) return SweepAccepted(designs, id);
  Reply reply;
  reply.later = [designs, id, seconds, turn = std::move(turn), as_csv = WantsCsv(call),
                 jobs = designs.jobs->OfSweep(id), next = std::size_t{0},
                 until = Clock::now() +
                         std::chrono::seconds(seconds)]() mutable -> std::optional<Reply> {
    for (; next < jobs.size(); ++next) {
      const auto job = designs.jobs->Look(jobs[next].id);
      if (job && !Ended(job->status)) break;
    }
    const bool is_over = Clock::now() >= until || designs.jobs->Stopping();
    if (next < jobs.size() && !is_over) return std::nullopt;
    return EndedReply(designs, id, is_over, seconds, as_csv);
  };
  return reply;
}

Reply StartSweep(const JobsResource& designs, const Call& call, const catalog::Signature& by,
                 int priority, const catalog::Revision& revision, const api::SweepRequest& sweep) {
  SweepRecord record;
  record.name = sweep.name;
  record.by = by;
  record.client = call.client;
  record.revision = revision.number;
  record.hash = revision.hash;
  record.plan = Dump(sweep.plan);
  std::vector<catalog::JobOrder> orders;
  orders.reserve(sweep.requests.size());
  const catalog::Signature without_key{by.who, "", ""};
  for (const api::SweptRequest& request : sweep.requests) {
    orders.push_back(OrderOf(call, without_key, request.name, revision, request.model));
    orders.back().request = Dump(request.requirements);
    orders.back().priority = priority;
  }
  const auto [status, id] = designs.jobs->SubmitSweep(std::move(record), std::move(orders));
  if (status == Submitted::kKeyReused) return KeyReused();
  if (status == Submitted::kRefused) return FullQueue(designs, false, true);
  if (status == Submitted::kClientRefused) return FullQueue(designs, true, true);
  return AwaitSweep(designs, call, id);
}

}  // namespace

Reply PostSweep(SharedCatalog& catalog, const JobsResource& designs, const Call& call) {
  static Turnstile turnstile(kSweepsReadMax);
  auto query_errors = CheckQuery(call, {"validate_only", "priority"});
  const bool validate_only = ReadFlag(call, "validate_only", query_errors);
  const int priority = ReadPriority(call, query_errors);
  if (!query_errors.empty()) return ProblemReply(422, query_errors);
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  const auto turn = turnstile.Enter();
  if (!turn)
    return BusyReply("sweeps_read_max", kSweepsReadMax, "other sweeps are being checked", 1);
  const CatalogView view = catalog.View();
  auto parsed = api::ParseSweep(std::get<api::Json>(json), *view.parts(), catalog.Models());
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  const auto& sweep = std::get<api::SweepRequest>(parsed);
  if (validate_only) return JsonReply(200, {{"valid", true}, {"patches", sweep.requests.size()}});
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  return StartSweep(designs, call, std::get<catalog::Signature>(signature), priority, view.revision,
                    sweep);
}

Reply ListSweeps(const JobsResource& designs) {
  api::Json list = api::Json::array();
  for (const SweepRecord& sweep : designs.jobs->Sweeps()) list.push_back(Long(sweep));
  return JsonReply(200, {{"sweeps", std::move(list)}});
}

Reply GetSweep(const JobsResource& designs, const Call& call) {
  const auto sweep = designs.jobs->FindSweep(call.argument);
  if (!sweep) return NoSweep(call.argument);
  api::Json json = Long(*sweep);
  const api::Json plan = api::Json::parse(sweep->plan);
  const auto jobs = JobsOfPatches(designs, sweep->id, plan.at("patches").size());
  api::Json& patches = json["patches"] = api::Json::array();
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const auto& job = jobs[i];
    patches.push_back({{"name", plan.at("patches").at(i).at("name")},
                       {"id", job ? api::Json(job->id) : api::Json()},
                       {"status", job ? api::Json(Name(job->status)) : api::Json()},
                       {"link", job ? api::Json(designs.path + "/" + job->id) : api::Json()}});
  }
  return JsonReply(200, json);
}

Reply GetSweepTable(const JobsResource& designs, const Call& call) {
  auto errors = CheckQuery(call, {"format"});
  const auto format = QueryValue(call, "format");
  if (format && *format != "json" && *format != "csv")
    errors.push_back({"", "query format must be json or csv"});
  if (!errors.empty()) return ProblemReply(422, errors);
  const auto sweep = designs.jobs->FindSweep(call.argument);
  return sweep ? TableReply(designs, *sweep, WantsCsv(call)) : NoSweep(call.argument);
}

Reply CancelSweep(const JobsResource& designs, const Call& call) {
  if (!designs.jobs->FindSweep(call.argument)) return NoSweep(call.argument);
  designs.jobs->CancelSweep(call.argument);
  const auto sweep = designs.jobs->FindSweep(call.argument);
  return sweep ? JsonReply(200, Short(*sweep)) : NoSweep(call.argument);
}

}  // namespace plenum::server
