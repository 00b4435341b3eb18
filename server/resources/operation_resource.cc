#include "server/resources/operation_resource.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "api/catalogue/stores.h"
#include "api/json/json.h"

namespace plenum::server {
namespace {

constexpr std::uintmax_t kFreeBytesMin = 16 << 20;

std::size_t Count(const Jobs& jobs, JobStatus status) {
  const auto list = jobs.List();
  return static_cast<std::size_t>(std::count_if(
      list.begin(), list.end(), [&](const Job& job) { return job.status == status; }));
}

// SQLite writes the file and makes its journal beside it.
bool IsWritable(const std::filesystem::path& catalog) {
  const auto folder = std::filesystem::absolute(catalog).parent_path();
  return access(catalog.c_str(), W_OK) == 0 && access(folder.c_str(), W_OK) == 0;
}

bool IsReadable(SharedCatalog& catalog) {
  try {
    catalog.View();
    return true;
  } catch (const catalog::StoreError&) {
    return false;
  }
}

double ResidentBytes() {
  long long pages = 0, resident = 0;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr) return 0.0;
  if (std::fscanf(file, "%lld %lld", &pages, &resident) != 2) resident = 0;
  std::fclose(file);
  return static_cast<double>(resident * sysconf(_SC_PAGESIZE));
}

}  // namespace

Reply GetReadiness(const Services& services, const Call&) {
  api::Json checks = api::Json::object();
  bool ready = true;
  const auto check = [&](const char* name, bool holds) {
    checks[name] = holds ? "ok" : "failed";
    ready = ready && holds;
  };
  const auto has_room = [&](const Jobs& jobs) {
    return !jobs.Stopping() && Count(jobs, JobStatus::kQueued) < services.job_options.queued_max;
  };
  std::error_code none;
  const auto space = std::filesystem::space(services.file, none);
  check("catalogue_readable", IsReadable(services.catalog));
  check("catalogue_writable", IsWritable(services.file));
  check("disk_has_room", !none && space.available >= kFreeBytesMin);
  check("design_queue_has_room", has_room(services.designs));
  check("diagnosis_queue_has_room", has_room(services.diagnoses));
  const api::Json document = {{"status", ready ? "ready" : "not ready"}, {"checks", checks}};
  if (ready) return JsonReply(200, document);
  api::Json problem = {{"type", "about:blank"},
                       {"title", "Service Unavailable"},
                       {"status", 503},
                       {"detail", "the service cannot take work"}};
  problem["checks"] = checks;
  return {503, "application/problem+json", Dump(problem) + "\n", {{"Retry-After", "5"}}, {}};
}

Reply GetMetrics(const Services& services, const Call&) {
  Metrics& metrics = services.metrics;
  for (const auto& [kind, jobs] :
       {std::pair{"design", &services.designs}, std::pair{"diagnosis", &services.diagnoses}}) {
    const std::string name = std::string("plenum_") + kind + "_jobs_";
    metrics.Set(name + "queued", "Jobs that wait.", double(Count(*jobs, JobStatus::kQueued)));
    metrics.Set(name + "running", "Jobs at work.", double(Count(*jobs, JobStatus::kRunning)));
  }
  metrics.Set("plenum_resident_memory_bytes", "Memory of the process.", ResidentBytes());
  metrics.Set("plenum_catalogue_revision", "The newest revision of the catalogue.",
              double(services.catalog.View().revision.number));
  services.measure_connections();
  return {200, "text/plain; version=0.0.4; charset=utf-8", metrics.Text(), {}, {}};
}

}  // namespace plenum::server
