#include "server/resources/jobs_resource.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <optional>
#include <string_view>
#include <utility>

#include "api/json/words.h"
#include "server/call/coding/accepted.h"
#include "server/call/coding/gzip.h"
#include "server/call/entity_tag.h"
#include "server/call/lower_case.h"
#include "server/call/service_limits.h"
#include "server/call/signature.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr milliseconds kHeartbeat{900};  // streams are asked once a second
constexpr std::size_t kCompressedBytesMin = 4 << 10;

std::string SelfOf(const JobsResource& resource, const std::string& id) {
  return resource.path + "/" + id;
}

api::Json Links(const JobsResource& resource, const std::string& id) {
  const std::string self = SelfOf(resource, id);
  return {{"self", self}, {"events", self + "/events"}};
}

api::Json Short(const JobsResource& resource, const Job& job) {
  return {{"id", job.id}, {"status", Name(job.status)}, {"links", Links(resource, job.id)}};
}

std::string WhyFailed(const JobsResource& resource, const Job& job) {
  return "the " + resource.noun + " failed: " + job.failure;
}

api::Json Long(const JobsResource& resource, const Job& job) {
  api::Json json = {
      {"id", job.id},
      {"name", job.name},
      {"status", Name(job.status)},
      {"submitted_at", job.submitted_at},
      {"ended_at", job.ended_at.empty() ? api::Json() : api::Json(job.ended_at)},
      {"attempts", job.attempts},
      {"crashes", job.crashes},
      {"last_crash", job.crash.empty() ? api::Json() : api::Json(job.crash)},
      {"catalogue_revision", {{"number", job.catalogue.number}, {"hash", job.catalogue.hash}}},
      {"sweep", job.sweep.empty() ? api::Json() : api::Json(job.sweep)},
      {"progress", job.progress}};
  if (job.status == JobStatus::kFailed) json["detail"] = WhyFailed(resource, job);
  return json;
}

// A result as it is stored, between two texts: the bytes are sent as they are, or as they were
// compressed once.
Reply Around(const JobsResource& resource, const Job& job, std::string before, std::string after,
             bool as_gzip, const std::string& etag = "") {
  Reply reply{200, "application/json", "", {{"Vary", "Accept-Encoding"}}, {}};
  const auto compressed = as_gzip && job.result->size() >= kCompressedBytesMin
                              ? resource.jobs->Compressed(job)
                              : nullptr;
  if (compressed) {
    reply.tail = GzipOf(before, compressed, after);
    // Until its blocks have left, the text counts as being read.
    Bytes& blocks = reply.tail[1];
    blocks =
        Bytes(std::make_shared<const std::pair<Bytes, Bytes>>(blocks, job.result), blocks.get());
    reply.headers.emplace_back("Content-Encoding", "gzip");
  } else {
    reply.body = std::move(before);
    reply.tail = {job.result, std::make_shared<const std::string>(std::move(after))};
  }
  if (!etag.empty()) reply.headers.emplace_back("ETag", compressed ? OfGzip(etag) : etag);
  return reply;
}

// The document without its result, which is stored as text.
Reply FullReply(const JobsResource& resource, Job job, const std::string& etag, bool as_gzip) {
  resource.jobs->AddResult(job);
  api::Json json = Long(resource, job);
  json["links"] = Links(resource, job.id);
  std::string head = Dump(json);
  head.pop_back();
  head += ",\"result\":";
  if (job.result) return Around(resource, job, std::move(head), "}\n", as_gzip, etag);
  Reply reply{200, "application/json", head + "null}\n", {}, {}};
  if (!etag.empty()) reply.headers.emplace_back("ETag", etag);
  return reply;
}

// Of a job that ended, which stays as it is until it ends again.
std::string ETagOf(const JobsResource& resource, const Job& job) {
  return Ended(job.status) ? ETag(Dump(Long(resource, job)) + std::to_string(job.revision)) : "";
}

// Blanks and quotation marks around it off, in lower case.
std::string Unquoted(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\"");
  if (first == std::string_view::npos) return "";
  return LowerCase(std::string(text.substr(first, text.find_last_not_of(" \t\"") - first + 1)));
}

// What a client that waited gets.
Reply ResultReply(const JobsResource& resource, Job job, int waited_s, bool as_gzip) {
  resource.jobs->AddResult(job);
  if (job.status == JobStatus::kFailed) return ProblemReply(500, WhyFailed(resource, job));
  if (!job.result) return ProblemReply(409, "the job was cancelled before it began");
  Reply reply = Around(resource, job, "", "\n", as_gzip);
  reply.headers.emplace_back("Preference-Applied", "wait=" + std::to_string(waited_s));
  return reply;
}

Reply JobAccepted(const JobsResource& resource, const std::string& id) {
  const auto job = resource.jobs->Look(id);
  auto reply = JsonReply(
      202, job ? Short(resource, *job) : api::Json{{"id", id}, {"links", Links(resource, id)}});
  reply.headers.emplace_back("Location", SelfOf(resource, id));
  return reply;
}

Reply NoJob(const JobsResource& resource, const std::string& id) {
  return ProblemReply(404, "no " + resource.noun + " job has the id " + id +
                               "; of those that ended only the newest are kept");
}

std::string Event(const char* name, const api::Json& data) {
  return std::string("event: ") + name + "\ndata: " + Dump(data) + "\n\n";
}

}  // namespace

// Preferences that are not understood are ignored
// (RFC 7240).
int WaitSeconds(const Call& call) {
  const auto header = call.header("Prefer");
  if (!header || header->size() > 200) return 0;
  std::string_view rest = *header;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of(",;"), rest.size());
    const std::string_view preference = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    const std::size_t equal = preference.find('=');
    if (equal == std::string_view::npos || Unquoted(preference.substr(0, equal)) != "wait")
      continue;
    const std::string value = Unquoted(preference.substr(equal + 1));
    int seconds = 0;
    const auto [last, error] = std::from_chars(value.data(), value.data() + value.size(), seconds);
    if (error == std::errc() && last == value.data() + value.size() && seconds >= 0)
      return std::min(seconds, kWaitSecondsMax);
  }
  return 0;
}

std::shared_ptr<void> EnterWaiting() {
  static Turnstile turnstile(kWaitingMax);
  return turnstile.Enter();
}

int ReadPriority(const Call& call, api::Errors& errors) {
  const auto given = QueryValue(call, "priority");
  if (!given) return 0;
  int priority = 0;
  const char* const end = given->data() + given->size();
  const auto [last, error] = std::from_chars(given->data(), end, priority);
  if (error == std::errc() && last == end && priority >= -catalog::kPriorityMax && priority <= 0)
    return priority;
  errors.push_back({"", "query priority must be a whole number from " +
                            std::to_string(-catalog::kPriorityMax) + " to 0, not " +
                            api::Quoted(*given)});
  return 0;
}

Reply FullQueue(const JobsResource& resource, bool of_client, bool as_sweep) {
  const JobOptions& options = resource.jobs->options();
  const QueueLimits limits = LimitsOf(options, as_sweep);
  const std::string prefix = as_sweep ? "sweep_" : "";
  const std::string jobs = resource.noun + (as_sweep ? " jobs of sweeps" : " jobs");
  if (of_client)
    return BusyReply(prefix + "jobs_queued_per_client_max", limits.of_client,
                     "as many " + jobs + " of yours wait as may; try again later", 10);
  return BusyReply(prefix + "jobs_queued_max", limits.all,
                   "the queue of " + jobs + " is full; try again later", 10);
}

Reply StartJob(const JobsResource& resource, const Call& call, catalog::JobOrder order) {
  const auto [status, id] = resource.jobs->Submit(std::move(order));
  if (status == Submitted::kKeyReused) return KeyReused();
  if (status == Submitted::kRefused) return FullQueue(resource, false);
  if (status == Submitted::kClientRefused) return FullQueue(resource, true);
  const int seconds = WaitSeconds(call);
  auto turn = seconds > 0 ? EnterWaiting() : nullptr;
  if (!turn) return JobAccepted(resource, id);
  Reply reply;
  reply.later = [resource, id = id, seconds, turn = std::move(turn), as_gzip = WantsGzip(call),
                 until = Clock::now() + std::chrono::seconds(seconds)]() -> std::optional<Reply> {
    const bool over = Clock::now() >= until || resource.jobs->Stopping();
    const auto job = resource.jobs->Look(id);
    if (job && !Ended(job->status) && !over) return std::nullopt;
    if (!job || !Ended(job->status)) return JobAccepted(resource, id);
    auto ended = ResultReply(resource, *job, seconds, as_gzip);
    ended.headers.emplace_back("Location", SelfOf(resource, id));
    return ended;
  };
  return reply;
}

Reply GetQueue(const catalog::QueueState& queue) {
  return JsonReply(200, {{"waiting", queue.waiting},
                         {"running", queue.running},
                         {"workers", queue.workers},
                         {"threads", queue.threads},
                         {"oldest", queue.oldest.empty() ? api::Json() : api::Json(queue.oldest)}});
}

Reply ListJobs(const JobsResource& resource) {
  api::Json list = api::Json::array();
  for (const auto& job : resource.jobs->List()) {
    list.push_back(Long(resource, job));
    list.back()["links"] = Links(resource, job.id);
  }
  return JsonReply(200, {{"jobs", std::move(list)}});
}

Reply GetJob(const JobsResource& resource, const Call& call) {
  const auto job = resource.jobs->Look(call.argument);
  if (!job) return NoJob(resource, call.argument);
  const std::string etag = ETagOf(resource, *job);
  if (!etag.empty())
    for (const std::string& known : {etag, OfGzip(etag)})
      if (IsKnown(call, known))
        return {304, "", "", {{"ETag", known}, {"Vary", "Accept-Encoding"}}, {}};
  return FullReply(resource, *job, etag, WantsGzip(call));
}

Reply DoJobAgain(const JobsResource& resource, const Call& call) {
  const std::string& id = call.argument;
  switch (resource.jobs->Again(id)) {
    case Asked::kUnknown:
      return NoJob(resource, id);
    case Asked::kUnderWay:
      return ProblemReply(409, "the job is queued or running; it need not be asked for again");
    case Asked::kDone:
      return ProblemReply(409,
                          "the job is done and its result stands; post the request again for "
                          "the catalogue as it is now");
    case Asked::kRefused:
      return FullQueue(resource, false);
    case Asked::kClientRefused:
      return FullQueue(resource, true);
    case Asked::kQueued:
      break;
  }
  return JobAccepted(resource, id);
}

Reply CancelJob(const JobsResource& resource, const Call& call) {
  if (!resource.jobs->Cancel(call.argument)) return NoJob(resource, call.argument);
  const auto job = resource.jobs->Look(call.argument);
  return job ? JsonReply(200, Short(resource, *job)) : NoJob(resource, call.argument);
}

Reply JobEvents(const JobsResource& resource, const Call& call) {
  static Turnstile turnstile(kStreamsMax);
  if (!resource.jobs->Look(call.argument)) return NoJob(resource, call.argument);
  auto turn = turnstile.Enter();
  if (!turn) {
    return BusyReply("event_streams_max", kStreamsMax,
                     "too many event streams are open; poll the job instead", 5);
  }
  Reply reply{200, "text/event-stream", "", {{"Cache-Control", "no-store"}}, {}};
  reply.produce = [resource, id = call.argument, turn = std::move(turn), revision = -1LL,
                   written = Clock::now()](std::string& piece) mutable {
    const auto job = resource.jobs->Look(id);
    if (!job || resource.jobs->Stopping()) return Flow::kEnds;
    if (Ended(job->status)) {
      piece = Event("end", Short(resource, *job));
      return Flow::kEnds;
    }
    const auto now = Clock::now();
    if (job->revision != revision)
      piece = Event("progress", {{"status", Name(job->status)}, {"progress", job->progress}});
    else if (now - written >= kHeartbeat)
      piece = ": still there\n\n";
    if (!piece.empty()) written = now;
    revision = job->revision;
    return Flow::kWaits;
  };
  return reply;
}

}  // namespace plenum::server
