#include "server/resources/routes.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <mutex>

#include "api/catalogue/families.h"
#include "api/design/given/evaluation.h"
#include "api/design/given/unit_of_design.h"
#include "api/json/json.h"
#include "api/json/request_limits.h"
#include "api/measure/csv/recording_request.h"
#include "api/measure/curves.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "server/call/service_limits.h"
#include "server/resources/designs_resource.h"
#include "server/resources/diagnoses_resource.h"
#include "server/resources/documents/documents_resource.h"
#include "server/resources/history_resource.h"
#include "server/resources/models_resource.h"
#include "server/resources/openapi.h"
#include "server/resources/operation_resource.h"
#include "server/resources/pages/api_page.h"
#include "server/resources/pages/docs_resource.h"
#include "server/resources/pages/page_resource.h"
#include "server/resources/parts_resource.h"
#include "server/resources/seed_resource.h"
#include "server/resources/sweeps_resource.h"

namespace plenum::server {
namespace {

constexpr std::string_view kRest = "{path}";

// A turn among those that compute, fewer of which may be large.
std::shared_ptr<void> EnterComputing(bool large) {
  static Turnstile all(kComputingMax), of_large(kLargeComputingMax);
  return (large ? of_large : all).Enter();
}

Reply Found(const api::Json& answer) { return JsonReply(200, answer); }
Reply Found(const std::string& unit) { return UnitReply(unit); }

Reply TooManyCompute(bool large) {
  return large ? BusyReply("large_computing_max", kLargeComputingMax,
                           "other large simulations are under way", 1)
               : BusyReply("computing_max", kComputingMax,
                           "other simulations and maps are under way", 1);
}

// The document of a large request is read in the turn of large requests, which ends before the
// computation begins.
template <typename F>
Reply AnswerAtOnce(const Call& call, F&& run) {
  const bool large = call.turn != nullptr;
  const auto turn = EnterComputing(large);
  if (!turn) return TooManyCompute(large);
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  call.turn = nullptr;
  auto answer = run(std::get<api::Json>(json));
  if (auto* errors = std::get_if<api::Errors>(&answer)) return ProblemReply(422, *errors);
  return Found(std::get<0>(answer));
}

// The request with the answer of the diagnosis that its "from" names by id.
api::Json WithDiagnosis(api::Json request, const JobQueue& diagnoses) {
  api::Json& from = request["from"];
  if (!from.is_string()) return request;
  const std::optional<Job> job = diagnoses.Get(from.get<std::string>());
  if (job) from = job->result ? api::Json::parse(*job->result) : api::Json();
  return request;
}

api::Json RouteTable(const std::vector<Route>& routes) {
  api::Json table = api::Json::array();
  for (const auto& route : routes) {
    table.push_back({{"method", route.method}, {"path", route.path}, {"summary", route.summary}});
  }
  return {{"routes", std::move(table)}};
}

std::function<Reply(const Call&)> Readiness(const Services& services) {
  return [services, last = std::make_shared<LastReadiness>()](const Call&) {
    return GetReadiness(services, *last);
  };
}

void AddJobRoutes(const JobsResource& jobs, std::vector<Route>& routes) {
  const std::string one = jobs.path + "/{id}";
  routes.push_back({"GET", jobs.path, "the " + jobs.noun + " jobs, newest first", Access::kRead,
                    [jobs](const Call&) { return ListJobs(jobs); }});
  routes.push_back({"GET", one, "one " + jobs.noun + " job: status, progress, result",
                    Access::kRead, [jobs](const Call& call) { return GetJob(jobs, call); }});
  routes.push_back({"DELETE", one, "cancels the job", Access::kWrite,
                    [jobs](const Call& call) { return CancelJob(jobs, call); }});
  routes.push_back({"POST", one + "/again", "does a job again that failed or was cancelled",
                    Access::kWrite, [jobs](const Call& call) { return DoJobAgain(jobs, call); }});
  routes.push_back({"GET", one + "/events", "progress as server-sent events", Access::kRead,
                    [jobs](const Call& call) { return JobEvents(jobs, call); }});
}

// Before "/v1/parts/{id}", which would take their last words for ids.
void AddManyPartsRoutes(SharedCatalog& catalog, std::vector<Route>& routes) {
  const auto parts = [&](Reply (*answer)(SharedCatalog&, const Call&)) {
    return [&catalog, answer](const Call& call) { return answer(catalog, call); };
  };
  const auto one = std::find_if(routes.begin(), routes.end(),
                                [](const Route& route) { return route.path == "/v1/parts/{id}"; });
  const Route many[] = {
      {"GET", "/v1/parts/export", "parts of a family as CSV; query family", Access::kRead,
       parts(ExportParts)},
      {"POST",
       "/v1/parts/import",
       "parts of a family from a table; query family, dry_run, what the table leaves open",
       Access::kWrite,
       parts(ImportParts),
       {"text/csv", "text/tab-separated-values", "application/vnd.ms-excel",
        "application/octet-stream"}},
      {"GET", "/v1/parts/compare", "parts side by side, what differs marked; query ids",
       Access::kRead, parts(GetPartsComparison)},
      {"GET", "/v1/parts/check", "duplicates, odd numbers, what is missing or estimated",
       Access::kRead, parts(GetPartsCheck)},
      {"GET", "/v1/parts/{id}/protocol",
       "how to measure a part; query sensor_noise_kpa, sensor_resolution_kpa, sampling_hz, "
       "bottle_l, bottle_uncertainty",
       Access::kRead, parts(GetProtocol)}};
  routes.insert(one, std::begin(many), std::end(many));
}

void AddUnits(SharedCatalog& catalog, const JobsResource& designs, std::vector<Route>& routes) {
  routes.push_back({"GET", designs.path + "/{id}/{rank}/fmu",
                    "a design of the job's answer as a unit for co-simulation (FMI 2.0)",
                    Access::kRead, [&catalog, designs](const Call& call) {
                      const auto turn = EnterComputing(false);
                      return turn ? GetUnit(catalog, designs, call) : TooManyCompute(false);
                    }});
  routes.push_back({"POST", "/v1/fmus",
                    "evaluation/1 in: the design as a unit for co-simulation (FMI 2.0) out",
                    Access::kRead, [&catalog](const Call& call) {
                      return AnswerAtOnce(call, [&](const api::Json& request) {
                        return api::MakeUnitFile(request, *catalog.Snapshot(), catalog.Models());
                      });
                    }});
}

void AddRecordings(std::vector<Route>& routes) {
  routes.push_back(
      {"POST", "/v1/measurements",
       "recording/1 in, a CSV of any dialect: measurement/1 and what was understood out",
       Access::kRead,
       [](const Call& call) { return AnswerAtOnce(call, api::ReadRecordingRequest); }});
}

void AddCatalogUpdate(const Services& services, std::vector<Route>& routes) {
  routes.push_back(
      {"POST", "/v1/catalog/update",
       "takes over what the installed catalogue has newer; query dry_run", Access::kWrite,
       [&catalog = services.catalog, file = services.file, seed = services.seed](const Call& call) {
         return UpdateCatalog(catalog, file, seed, call);
       }});
}

void AddSweepRoutes(SharedCatalog& catalog, const JobsResource& designs,
                    std::vector<Route>& routes) {
  const std::string all = "/v1/sweeps", one = all + "/{id}";
  routes.push_back(
      {"POST", all,
       "sweep/1 in, a design job for each of its patches out; query validate_only, priority",
       Access::kWrite,
       [&catalog, designs](const Call& call) { return PostSweep(catalog, designs, call); }});
  routes.push_back({"GET", all, "the sweeps, newest first", Access::kRead,
                    [designs](const Call&) { return ListSweeps(designs); }});
  routes.push_back({"GET", one, "one sweep: status, its jobs", Access::kRead,
                    [designs](const Call& call) { return GetSweep(designs, call); }});
  routes.push_back({"DELETE", one, "cancels what has not ended", Access::kWrite,
                    [designs](const Call& call) { return CancelSweep(designs, call); }});
  routes.push_back({"GET", one + "/table", "its answers side by side; query format: json or csv",
                    Access::kRead,
                    [designs](const Call& call) { return GetSweepTable(designs, call); }});
}

void AddQueueRoutes(const Services& services, const JobsResource& designs,
                    std::vector<Route>& routes) {
  AddSweepRoutes(services.catalog, designs, routes);
  routes.push_back({"GET", "/v1/queue", "jobs that wait and run, of all services; who does them",
                    Access::kRead,
                    [queue = services.queue](const Call&) { return GetQueue(queue()); }});
}

// What people read in a browser.
void AddPages(const Services& services, std::vector<Route>& routes) {
  routes.push_back({"GET", "/", "the web page", Access::kOpen, GetPage});
  routes.push_back({"GET", "/assets/{id}", "a file of the web page", Access::kOpen, GetAsset});
  routes.push_back({"GET", "/docs", "leads to the documentation", Access::kOpen, RedirectToDocs});
  routes.push_back({"GET", "/docs/{path}", "a file of the documentation", Access::kOpen,
                    [docs = services.docs](const Call& call) { return GetDocs(docs, call); }});
  routes.push_back({"GET", "/openapi", "this description, for reading", Access::kOpen, GetApiPage});
}

// Made when it is first asked for: it takes longer than all else of a start.
std::function<Reply(const Call&)> Description(const std::vector<Route>& routes) {
  struct Made {
    std::once_flag once;
    Reply reply;
  };
  return [routes, made = std::make_shared<Made>()](const Call&) {
    std::call_once(made->once, [&] { made->reply = Shared(JsonReply(200, OpenApi(routes))); });
    return made->reply;
  };
}

}  // namespace

std::vector<Route> Routes(const Services& services) {
  SharedCatalog& catalog = services.catalog;
  const auto parts = [&](Reply (*answer)(SharedCatalog&, const Call&)) {
    return [&catalog, answer](const Call& call) { return answer(catalog, call); };
  };
  const JobsResource design_jobs{&services.designs, "/v1/designs", "design"};
  const JobsResource diagnosis_jobs{&services.diagnoses, "/v1/diagnoses", "diagnosis"};
  std::vector<Route> routes = {
      {"POST", design_jobs.path,
       "requirements/1 in, a job that ranks designs out; query validate_only, priority",
       Access::kWrite,
       [&catalog, design_jobs](const Call& call) {
         return PostDesign(catalog, design_jobs, call);
       }},
      {"POST", diagnosis_jobs.path,
       "measurement/1 in, a job that finds what the model lacks out; query priority",
       Access::kWrite,
       [&catalog, diagnosis_jobs](const Call& call) {
         return PostDiagnosis(catalog, diagnosis_jobs, call);
       }},
      {"POST", "/v1/simulations",
       "simulation/1 in, response/1 out; with from, a diagnosis or its id, curves/1", Access::kRead,
       [&catalog, &diagnoses = services.diagnoses](const Call& call) {
         return AnswerAtOnce(call, [&](const api::Json& request) {
           return api::AsksForCurves(request) ? api::RunCurves(WithDiagnosis(request, diagnoses))
                                              : api::RunSimulation(request, *catalog.Snapshot());
         });
       }},
      {"POST", "/v1/evaluations", "evaluation/1 in: parts at settings against requirements",
       Access::kRead,
       [&](const Call& call) {
         return AnswerAtOnce(call, [&](const api::Json& request) {
           return api::RunEvaluation(request, *catalog.Snapshot(), catalog.Models());
         });
       }},
      {"POST", "/v1/maps", "map/1 in, rise time, fall time and frequency over the grid out",
       Access::kRead, [](const Call& call) { return AnswerAtOnce(call, api::RunMap); }},
      {"GET", "/v1/parts",
       "parts; query q, family, field_min, field_max, sort, facets, limit, cursor, revision",
       Access::kRead, parts(ListParts)},
      {"POST", "/v1/parts", "adds a part", Access::kWrite, parts(AddPart)},
      {"GET", "/v1/parts/{id}", "one part, with ETag", Access::kRead, parts(GetPart)},
      {"PUT", "/v1/parts/{id}", "replaces the part that If-Match names", Access::kWrite,
       parts(ReplacePart)},
      {"DELETE", "/v1/parts/{id}", "removes the part that If-Match names", Access::kWrite,
       parts(RemovePart)},
      {"GET", "/v1/parts/{id}/history", "changes of a part, newest first", Access::kRead,
       parts(PartHistory)},
      {"GET", "/v1/families", "families of parts: fields, ranges, what they mean", Access::kRead,
       [](const Call&) { return JsonReply(200, api::RenderFamilies()); }},
      {"GET", "/v1/revisions", "writes to the catalogue, newest first", Access::kRead,
       parts(ListRevisions)},
      {"GET", "/v1/revisions/{id}", "one write with its changes", Access::kRead,
       parts(GetRevision)},
      {"GET", "/v1/models", "saved model revisions, the newest of each name", Access::kRead,
       parts(ListModels)},
      {"POST", "/v1/models", "saves a model revision: its name and model/1", Access::kWrite,
       parts(SaveModel)},
      {"GET", "/v1/models/{id}", "all versions of a saved model revision", Access::kRead,
       parts(GetModel)},
      {"POST", "/v1/revisions/{id}/undo", "takes the changes of a write back", Access::kWrite,
       parts(UndoRevision)},
      {"GET", "/healthz", "whether the service runs", Access::kOpen,
       [](const Call&) {
         return JsonReply(200, {{"status", "ok"}});
       }},
      {"GET", "/readyz", "whether it can take work", Access::kOpen, Readiness(services)},
      {"GET", "/metrics", "what it did and holds, for Prometheus", Access::kRead,
       [services](const Call& call) { return GetMetrics(services, call); }},
      {"GET", "/v1/limits", "how much a request may ask for", Access::kRead,
       [limits = RenderLimits(QuotaOf(services.job_options), services.jobs_kept)](const Call&) {
         return JsonReply(200, {{"limits", limits}});
       }},
  };
  AddManyPartsRoutes(catalog, routes);
  for (Route& route : DocumentRoutes(catalog)) routes.push_back(std::move(route));
  AddUnits(catalog, design_jobs, routes);
  AddRecordings(routes);
  AddCatalogUpdate(services, routes);
  for (const JobsResource* jobs : {&design_jobs, &diagnosis_jobs}) AddJobRoutes(*jobs, routes);
  AddQueueRoutes(services, design_jobs, routes);
  AddPages(services, routes);
  routes.push_back({"GET", "/openapi.json", "this description, OpenAPI 3.1", Access::kOpen, {}});
  routes.push_back({"GET", "/v1", "this table", Access::kRead, {}});
  routes.back().answer = [reply = Shared(JsonReply(200, RouteTable(routes)))](const Call&) {
    return reply;
  };
  (routes.end() - 2)->answer = Description(routes);
  return routes;
}

bool Matches(const Route& route, std::string_view path, std::string& argument) {
  const std::string_view pattern = route.path;
  if (pattern.ends_with(kRest)) {
    const auto before = pattern.substr(0, pattern.size() - kRest.size());
    if (!path.starts_with(before)) return false;
    argument = path.substr(before.size());
    return true;
  }
  argument.clear();
  for (std::string_view rest = pattern;;) {
    const auto wanted = rest.substr(0, rest.find('/')), given = path.substr(0, path.find('/'));
    const bool varies = wanted.starts_with('{');
    if (varies ? given.empty() : wanted != given) return false;
    if (varies) argument.append(argument.empty() ? "" : "/").append(given);
    const bool ends = wanted.size() == rest.size();
    if (ends != (given.size() == path.size())) return false;
    if (ends) return true;
    rest.remove_prefix(wanted.size() + 1);
    path.remove_prefix(given.size() + 1);
  }
}

}  // namespace plenum::server
