#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "api/catalogue/stores.h"
#include "server/call/service_limits.h"
#include "server/call/shared_catalog.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/interrupt.h"
#include "server/commands/memory_patience.h"
#include "server/jobs/job_memory.h"
#include "server/jobs/job_worker.h"
#include "server/jobs/shared_jobs.h"
#include "server/resources/designs_resource.h"
#include "server/resources/diagnoses_resource.h"

namespace plenum::server {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct WorkOptions {
  std::string catalog = catalog::DefaultCatalog();
  int threads = 0;
  int lease_s = 30;
  int drain_s = 60;
};

int ThreadsOf(const WorkOptions& options) {
  if (options.threads > 0) return options.threads;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Until the jobs at work have ended, the time is over or a second signal comes.
void AwaitJobs(const JobWorker& worker, seconds time) {
  const auto until = std::chrono::steady_clock::now() + time;
  while (!worker.Idle() && std::chrono::steady_clock::now() < until)
    if (WaitForInterrupt(milliseconds(100))) return;
}

void DoJobs(const WorkOptions& options) {
  if (!catalog::IsServer(options.catalog))
    throw BadInput(
        "--catalog: workers need a catalogue on a server, postgresql://USER@HOST/DATABASE; the "
        "jobs of one in a file are done by its plenum serve");
  BlockInterrupts();
  WaitForMemory();
  OpenCatalog(options.catalog, catalog::Access::kRead);  // says what is wrong with it
  try {
    SharedCatalog parts(options.catalog);
    JobMemory memory(kJobMemoryBytesMax);
    JobWorker worker(options.catalog,
                     {{"design", DesignWork(parts, memory)}, {"diagnosis", DiagnosisWork(parts)}},
                     {.threads = ThreadsOf(options),
                      .lease = seconds(options.lease_s),
                      .kept = kSharedJobsKept});
    std::fprintf(stderr, "plenum works for %s, %d jobs at a time\n",
                 catalog::Shown(options.catalog).c_str(), ThreadsOf(options));
    WaitForInterrupt();
    std::fputs("stopping: no more jobs\n", stderr);
    worker.Drain();
    AwaitJobs(worker, seconds(options.drain_s));
    worker.Stop();
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

}  // namespace

Command WorkerCommand() {
  auto options = std::make_shared<WorkOptions>();
  return {"worker",
          "Does the jobs of a catalogue on a server",
          "plenum worker --catalog postgresql://plenum@db.example/plenum",
          {CatalogOption(options->catalog),
           {"--threads",
            "Jobs at a time; without it as many as there are processors",
            &options->threads,
            {.value_name = "N", .allowed = Within{1, 1024}}},
           {"--lease",
            "Seconds after which another takes a job whose worker says nothing any more",
            &options->lease_s,
            {.value_name = "S", .shows_default = true, .allowed = Within{2, 3600}}},
           {"--drain",
            "Seconds that jobs at work may go on after SIGTERM; then they go back to the queue",
            &options->drain_s,
            {.value_name = "S", .shows_default = true, .allowed = Within{0, 86'400}}}},
          [options] {
            DoJobs(*options);
            return kAnswered;
          }};
}

}  // namespace plenum::server
