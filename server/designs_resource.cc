#include "server/designs_resource.h"

#include <algorithm>
#include <charconv>
#include <regex>

#include "api/services.h"
#include "server/limits.h"

namespace plenum::server {
namespace {

using std::chrono::milliseconds;

constexpr int kWaitMaxS = 300;
constexpr milliseconds kHeartbeat{1000};

api::Json Links(const std::string& id) {
  const std::string self = "/v1/designs/" + id;
  return {{"self", self}, {"events", self + "/events"}};
}

api::Json Short(const Job& job) {
  return {{"id", job.id}, {"status", Name(job.status)}, {"links", Links(job.id)}};
}

api::Json Full(const Job& job) {
  api::Json json = {{"id", job.id},
                    {"name", job.name},
                    {"status", Name(job.status)},
                    {"progress", job.progress},
                    {"result", job.result},
                    {"links", Links(job.id)}};
  // What went wrong inside is for the log.
  if (job.status == JobStatus::kFailed)
    json["detail"] = "the search failed: a fault of the program";
  return json;
}

api::Json ToJson(const optimizer::Progress& progress) {
  return {{"seconds", api::Number(progress.seconds)},
          {"evaluated", progress.evaluated},
          {"open", progress.open},
          {"best", progress.best ? api::Number(*progress.best) : api::Json()},
          {"lower_bound", api::Number(progress.lower_bound)}};
}

Work DesignWork(api::DesignRequest request, CatalogView catalog) {
  return [request = std::move(request), catalog = std::move(catalog)](const JobControl& control) {
    optimizer::SearchOptions options;
    options.cancelled = control.cancelled;
    options.progress = [&](const optimizer::Progress& progress) {
      control.report(ToJson(progress));
    };
    api::Json answer = api::AnswerRequest(request, options, *catalog.parts);
    answer["catalogue_revision"] = api::RenderRevisionName(catalog.revision);
    return answer;
  };
}

// Seconds of "Prefer: wait=N"; 0 without one. Preferences that are not understood are ignored
// (RFC 7240).
int WaitSeconds(const Call& call) {
  const auto prefer = call.header("Prefer");
  if (!prefer || prefer->size() > 200) return 0;
  static const std::regex kWait(R"re((^|[,;\s])wait\s*=\s*"?(\d{1,6})"?)re", std::regex::icase);
  std::smatch match;
  if (!std::regex_search(*prefer, match, kWait)) return 0;
  return std::min(std::stoi(match[2]), kWaitMaxS);
}

// What a client that waited gets: the result, or nothing when it takes longer.
std::optional<Reply> WaitForResult(const Jobs& jobs, const std::string& id, int seconds) {
  static Turnstile turnstile(kWaitingMax);
  const auto turn = seconds > 0 ? turnstile.Enter() : nullptr;
  if (!turn) return std::nullopt;
  const auto job = jobs.WaitForEnd(id, std::chrono::seconds(seconds));
  if (!job || !Ended(job->status)) return std::nullopt;
  if (job->status == JobStatus::kFailed) return ProblemReply(500, "the search failed");
  if (job->result.is_null()) return ProblemReply(409, "the job was cancelled before it began");
  auto reply = JsonReply(200, job->result);
  reply.headers.emplace_back("Preference-Applied", "wait=" + std::to_string(seconds));
  return reply;
}

Reply NoJob(const std::string& id) {
  return ProblemReply(404, "no design job has the id " + id +
                               "; jobs end with the service, and only the newest are kept");
}

std::string Event(const char* name, const api::Json& data) {
  return std::string("event: ") + name + "\ndata: " + Dump(data) + "\n\n";
}

}  // namespace

Reply PostDesign(SharedCatalog& catalog, Jobs& jobs, const Call& call) {
  auto query_errors = CheckQuery(call, {"validate_only"});
  const bool validate_only = ReadFlag(call, "validate_only", query_errors);
  if (!query_errors.empty()) return ProblemReply(422, query_errors);
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  CatalogView view = catalog.View();
  auto parsed = api::ParseRequirements(
      std::get<api::Json>(json), *view.parts,
      catalog.With([](const catalog::Store& store) { return store.Models(); }));
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  if (validate_only) return JsonReply(200, {{"valid", true}});
  auto& request = std::get<api::DesignRequest>(parsed);

  const std::string name = request.name;
  const auto id = jobs.Submit(name, DesignWork(std::move(request), std::move(view)));
  if (!id) {
    auto reply = ProblemReply(429, "the queue of design jobs is full; try again later");
    reply.headers.emplace_back("Retry-After", "10");
    return reply;
  }
  auto reply = WaitForResult(jobs, *id, WaitSeconds(call));
  if (!reply) {
    const auto job = jobs.Get(*id);
    reply = JsonReply(202, job ? Short(*job) : api::Json{{"id", *id}, {"links", Links(*id)}});
  }
  reply->headers.emplace_back("Location", "/v1/designs/" + *id);
  return *reply;
}

Reply ListDesigns(const Jobs& jobs) {
  api::Json list = api::Json::array();
  for (const auto& job : jobs.List()) {
    list.push_back({{"id", job.id},
                    {"name", job.name},
                    {"status", Name(job.status)},
                    {"progress", job.progress},
                    {"links", Links(job.id)}});
  }
  return JsonReply(200, {{"jobs", std::move(list)}});
}

Reply GetDesign(const Jobs& jobs, const Call& call) {
  const auto job = jobs.Get(call.argument);
  return job ? JsonReply(200, Full(*job)) : NoJob(call.argument);
}

Reply CancelDesign(Jobs& jobs, const Call& call) {
  if (!jobs.Cancel(call.argument)) return NoJob(call.argument);
  const auto job = jobs.Get(call.argument);
  return job ? JsonReply(200, Short(*job)) : NoJob(call.argument);
}

Reply DesignEvents(const Jobs& jobs, const Call& call) {
  static Turnstile turnstile(kStreamsMax);
  if (!jobs.Get(call.argument)) return NoJob(call.argument);
  auto turn = turnstile.Enter();
  if (!turn) {
    auto reply = ProblemReply(429, "too many event streams are open; poll the job instead");
    reply.headers.emplace_back("Retry-After", "5");
    return reply;
  }
  Reply reply{200, "text/event-stream", "", {{"Cache-Control", "no-store"}}, {}};
  reply.stream = [&jobs, id = call.argument, turn = std::move(turn),
                  revision = -1LL](const Write& write) mutable {
    const auto job = jobs.WaitForChange(id, revision, kHeartbeat);
    if (!job || jobs.Stopping()) return false;
    if (Ended(job->status)) {
      write(Event("end", Short(*job)));
      return false;
    }
    if (job->revision == revision) return write(": still there\n\n");
    revision = job->revision;
    return write(Event("progress", {{"status", Name(job->status)}, {"progress", job->progress}}));
  };
  return reply;
}

}  // namespace plenum::server
