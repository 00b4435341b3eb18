#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/version.h"
#include "server/call/reply.h"
#include "server/commands/catalog_keeping.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/input.h"
#include "server/commands/output.h"
#include "server/jobs/crash_marks.h"
#include "server/jobs/job_recovery.h"
#include "server/jobs/shared_jobs.h"
#include "server/render/text/text_jobs.h"

namespace plenum::server {
namespace {

struct JobsOptions {
  std::string catalog = catalog::DefaultCatalog();
  std::string id;
  bool json = false;
};

std::string FileOf(const JobsOptions& options) { return options.catalog + "-jobs"; }

// The jobs as the next service will find them.
std::unique_ptr<catalog::JobStore> OpenJobs(const JobsOptions& options) {
  try {
    auto store = std::make_unique<catalog::JobStore>(FileOf(options), catalog::JobsKept());
    RecoverJobs(*store, CrashFile(options.catalog));
    return store;
  } catch (const catalog::StoreError& error) {
    if (error.fault() != catalog::StoreFault::kBusy) throw BadInput(error.what());
    throw BadInput(FileOf(options) +
                   ": a service that runs holds these jobs. Ask it instead: its page lists them;\n"
                   "GET /v1/designs and GET /v1/diagnoses do, too; POST /v1/designs/ID/again does "
                   "one again,\nDELETE /v1/designs/ID cancels it. Or stop the service first.");
  }
}

bool OnServer(const JobsOptions& options) { return catalog::IsServer(options.catalog); }

std::unique_ptr<catalog::SharedJobStore> OpenShared(const JobsOptions& options) {
  try {
    return std::make_unique<catalog::SharedJobStore>(options.catalog, std::string(api::Version()));
  } catch (const catalog::StoreError& error) {
    throw BadInput(error.what());
  }
}

// What a catalogue has that no service was started with.
std::vector<catalog::JobRecord> ListOf(const JobsOptions& options) {
  OpenCatalog(options.catalog, catalog::Access::kRead);  // says what is wrong with the file
  if (OnServer(options)) return OpenShared(options)->List("", kSharedJobsListed);
  if (!std::filesystem::exists(FileOf(options))) return {};
  return OpenJobs(options)->List();
}

void List(const JobsOptions& options) {
  const auto jobs = ListOf(options);
  if (!options.json) return Print(JobsText(jobs));
  api::Json list = api::Json::array();
  for (const catalog::JobRecord& job : jobs) list.push_back(RenderJob(job));
  Print(Dump({{"jobs", std::move(list)}}) + "\n");
}

catalog::JobRecord FindOrRefuse(const JobsOptions& options) {
  for (catalog::JobRecord& job : ListOf(options))
    if (job.id == options.id) return std::move(job);
  throw BadInput("ID: no job has the id " + options.id + "; plenum jobs lists them");
}

void Say(const JobsOptions& options, catalog::JobStatus status, const std::string& text) {
  Print(options.json ? Dump({{"id", options.id}, {"status", catalog::Name(status)}}) + "\n"
                     : text + "\n");
}

void DoAgain(const JobsOptions& options) {
  const catalog::JobRecord job = FindOrRefuse(options);
  if (!catalog::Ended(job.status))
    throw BadInput(std::string("ID: the job is ") + catalog::Name(job.status) + " already; " +
                   (OnServer(options) ? "a worker does it" : "the next plenum serve does it"));
  if (job.status == catalog::JobStatus::kDone)
    throw BadInput("ID: the job is done and its result stands; plenum serve gives it");
  if (OnServer(options)) {
    OpenShared(options)->Again(job.id);
    return Say(options, catalog::JobStatus::kQueued, "queued; the next free worker does it");
  }
  OpenJobs(options)->Again(job.id);
  Say(options, catalog::JobStatus::kQueued, "queued; the next plenum serve does it");
}

void Cancel(const JobsOptions& options) {
  catalog::JobRecord job = FindOrRefuse(options);
  if (catalog::Ended(job.status))
    return Say(options, job.status,
               std::string("nothing to cancel: the job is ") + catalog::Name(job.status));
  if (OnServer(options)) {
    OpenShared(options)->Cancel(job.id);
    if (job.status == catalog::JobStatus::kRunning)
      return Say(options, job.status, "asked to end; its worker ends it within some seconds");
  }
  job.status = catalog::JobStatus::kCancelled;
  if (!OnServer(options)) OpenJobs(options)->End(job);
  Say(options, job.status, "cancelled");
}

}  // namespace

Command JobsCommand() {
  auto options = std::make_shared<JobsOptions>();
  const auto command = [&](const char* name, const char* help, const char* example,
                           void (*run)(const JobsOptions&)) {
    return Command{
        name, help, example, {Argument("ID", "Of the list", &options->id)}, [options, run] {
          run(*options);
          return kAnswered;
        }};
  };
  return {"jobs",
          "Jobs of a catalogue: in a file while no service runs, on a server at any time",
          "plenum jobs",
          {CatalogOption(options->catalog), JsonFlag(options->json)},
          [options] {
            List(*options);
            return kAnswered;
          },
          {command("again", "Queues a job that failed or was cancelled", "plenum jobs again JOB",
                   DoAgain),
           command("cancel", "Ends a job that is queued", "plenum jobs cancel JOB", Cancel)}};
}

}  // namespace plenum::server
