#include "server/resources/operation_resource.h"

#include <filesystem>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "server/jobs/job_memory.h"

namespace plenum::server {
namespace {

constexpr std::uintmax_t kFreeBytesMin = 16 << 20;

// What another process writes is busy: writes wait for it, and the service is ready.
constexpr char kOk[] = "ok", kBusy[] = "busy", kFailed[] = "failed";

const char* Readable(SharedCatalog& catalog) {
  try {
    catalog.View();
    return kOk;
  } catch (const catalog::StoreError& error) {
    return error.fault() == catalog::StoreFault::kBusy ? kBusy : kFailed;
  }
}

// Of a server only the server knows; what it cannot write fails.
bool HasRoom(const std::filesystem::path& catalogue) {
  if (catalog::IsServer(catalogue)) return true;
  std::error_code none;
  const auto space =
      std::filesystem::space(std::filesystem::absolute(catalogue).parent_path(), none);
  return !none && space.available >= kFreeBytesMin;
}

Reply NotReady(const api::Json& checks) {
  api::Json problem = {{"type", "about:blank"},
                       {"title", "Service Unavailable"},
                       {"status", 503},
                       {"detail", "the service cannot take work"}};
  problem["checks"] = checks;
  return {503, "application/problem+json", Dump(problem) + "\n", {{"Retry-After", "5"}}, {}};
}

}  // namespace

LastReadiness::LastReadiness() : reply(NotReady(api::Json::object())) {}

Reply GetReadiness(const Services& services, LastReadiness& last) {
  const std::unique_lock looking(last.looking, std::try_to_lock);
  if (!looking) {
    const std::lock_guard lock(last.mutex);
    return last.reply;
  }
  const FileCheck file = services.catalog.Check();
  const bool has_room = HasRoom(services.file);
  const bool takes_jobs = !services.designs.Stopping() && !services.diagnoses.Stopping();
  const std::pair<const char*, const char*> checks[] = {
      {"catalogue_in_place", file == FileCheck::kReplaced ? kFailed : kOk},
      {"catalogue_readable", Readable(services.catalog)},
      {"catalogue_writable", file == FileCheck::kFailed ? kFailed
                             : file == FileCheck::kBusy ? kBusy
                                                        : kOk},
      {"disk_has_room", has_room ? kOk : kFailed},
      {"takes_jobs", takes_jobs ? kOk : kFailed}};
  api::Json json = api::Json::object();
  bool ready = true;
  for (const auto& [name, state] : checks) {
    json[name] = state;
    ready = ready && state != kFailed;
  }
  Reply reply = ready ? JsonReply(200, {{"status", "ready"}, {"checks", json}}) : NotReady(json);
  const std::lock_guard lock(last.mutex);
  last.reply = reply;
  return reply;
}

Reply GetMetrics(const Services& services, const Call&) {
  Metrics& metrics = services.metrics;
  for (const auto& [kind, jobs] :
       {std::pair{"design", &services.designs}, std::pair{"diagnosis", &services.diagnoses}}) {
    const std::string name = std::string("plenum_") + kind + "_jobs_";
    metrics.Set(name + "queued", "Jobs that wait.", double(jobs->Count(JobStatus::kQueued)));
    metrics.Set(name + "running", "Jobs at work.", double(jobs->Count(JobStatus::kRunning)));
  }
  metrics.Set("plenum_resident_memory_bytes", "Memory of the process.", double(ResidentBytes()));
  metrics.Set("plenum_catalogue_revision", "The newest revision of the catalogue.",
              double(services.catalog.View().revision.number));
  services.measure_connections();
  return {200, "text/plain; version=0.0.4; charset=utf-8", metrics.Text(), {}, {}};
}

}  // namespace plenum::server
