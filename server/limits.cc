#include "server/limits.h"

#include "api/limits.h"
#include "api/problem.h"

namespace plenum::server {

api::Json RenderLimits(const JobOptions& jobs, const catalog::JobsKept& kept) {
  api::Json limits = {{"head_bytes_max", kHeadBytesMax},
                      {"headers_max", kHeadersMax},
                      {"path_bytes_max", kPathBytesMax},
                      {"head_seconds_max", kHeadSecondsMax},
                      {"idle_seconds_max", kIdleSecondsMax},
                      {"body_bytes_max", kBodyBytesMax},
                      {"body_bytes_per_second_min", kBytesPerSecondMin},
                      {"buffered_bytes_max", kBufferedBytesMax},
                      {"large_body_bytes", kLargeBodyBytes},
                      {"large_bodies_max", kLargeBodiesMax},
                      {"connections_max", kConnectionsMax},
                      {"requests_at_a_time_max", kRequestThreads},
                      {"computing_max", kComputingMax},
                      {"waiting_max", kWaitingMax},
                      {"wait_seconds_max", kWaitSecondsMax},
                      {"event_streams_max", kStreamsMax},
                      {"jobs_running_max", jobs.workers},
                      {"jobs_queued_max", jobs.queued_max},
                      {"jobs_kept_max", kept.jobs},
                      {"jobs_kept_bytes_max", kept.bytes}};
  limits.update(api::RenderRequestLimits());
  return limits;
}

Reply LimitReply(int status, const std::string& name, const api::Json& value,
                 const std::string& detail) {
  api::Json document = api::ProblemDocument(status, detail);
  document["limit"] = {{"name", name}, {"value", value}};
  return {status, "application/problem+json", Dump(document) + "\n", {}, {}};
}

Reply BusyReply(const std::string& name, const api::Json& value, const std::string& detail,
                int retry_after_s) {
  Reply reply = LimitReply(429, name, value, detail);
  reply.headers.emplace_back("Retry-After", std::to_string(retry_after_s));
  return reply;
}

}  // namespace plenum::server
