#include "server/routes.h"

#include "api/services.h"
#include "server/designs_resource.h"
#include "server/history_resource.h"
#include "server/models_resource.h"
#include "server/page_resource.h"
#include "server/parts_resource.h"

namespace plenum::server {
namespace {

constexpr std::string_view kVariable = "{id}";

template <typename F>
Reply AnswerAtOnce(const Call& call, F&& run) {
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  auto answer = run(std::get<api::Json>(json));
  if (auto* errors = std::get_if<api::Errors>(&answer)) return ProblemReply(422, *errors);
  return JsonReply(200, std::get<api::Json>(answer));
}

api::Json RouteTable(const std::vector<Route>& routes) {
  api::Json table = api::Json::array();
  for (const auto& route : routes) {
    table.push_back({{"method", route.method}, {"path", route.path}, {"summary", route.summary}});
  }
  return {{"routes", std::move(table)}};
}

}  // namespace

std::vector<Route> Routes(SharedCatalog& catalog, Jobs& jobs) {
  const auto parts = [&](Reply (*answer)(SharedCatalog&, const Call&)) {
    return [&catalog, answer](const Call& call) { return answer(catalog, call); };
  };
  std::vector<Route> routes = {
      {"POST", "/v1/designs",
       "requirements/1 in, a job that ranks designs out; query validate_only",
       [&](const Call& call) { return PostDesign(catalog, jobs, call); }},
      {"GET", "/v1/designs", "the jobs, newest first",
       [&](const Call&) { return ListDesigns(jobs); }},
      {"GET", "/v1/designs/{id}", "one job: status, progress, result",
       [&](const Call& call) { return GetDesign(jobs, call); }},
      {"DELETE", "/v1/designs/{id}", "cancels the job",
       [&](const Call& call) { return CancelDesign(jobs, call); }},
      {"GET", "/v1/designs/{id}/events", "progress as server-sent events",
       [&](const Call& call) { return DesignEvents(jobs, call); }},
      {"POST", "/v1/simulations", "simulation/1 in, response/1 out",
       [&](const Call& call) {
         return AnswerAtOnce(call, [&](const api::Json& request) {
           return api::RunSimulation(request, *catalog.Snapshot());
         });
       }},
      {"POST", "/v1/maps", "map/1 in, rise time, fall time and frequency over the grid out",
       [](const Call& call) { return AnswerAtOnce(call, api::RunMap); }},
      {"GET", "/v1/parts",
       "parts; query family, field_min, field_max, sort, facets, limit, cursor, revision",
       parts(ListParts)},
      {"POST", "/v1/parts", "adds a part", parts(AddPart)},
      {"GET", "/v1/parts/export", "parts of a family as CSV; query family", parts(ExportParts)},
      {"POST", "/v1/parts/import", "parts of a family from CSV; query family, dry_run",
       parts(ImportParts)},
      {"GET", "/v1/parts/{id}", "one part, with ETag", parts(GetPart)},
      {"PUT", "/v1/parts/{id}", "replaces the part that If-Match names", parts(ReplacePart)},
      {"DELETE", "/v1/parts/{id}", "removes the part that If-Match names", parts(RemovePart)},
      {"GET", "/v1/parts/{id}/history", "changes of a part, newest first", parts(PartHistory)},
      {"GET", "/v1/families", "families of parts: fields, ranges, what they mean",
       [](const Call&) { return JsonReply(200, api::RenderFamilies()); }},
      {"GET", "/v1/revisions", "writes to the catalogue, newest first", parts(ListRevisions)},
      {"GET", "/v1/revisions/{id}", "one write with its changes", parts(GetRevision)},
      {"GET", "/v1/models", "saved model revisions, the newest of each name", parts(ListModels)},
      {"GET", "/v1/models/{id}", "all versions of a saved model revision", parts(GetModel)},
      {"POST", "/v1/revisions/{id}/undo", "takes the changes of a write back", parts(UndoRevision)},
      {"GET", "/healthz", "whether the service runs",
       [](const Call&) {
         return JsonReply(200, {{"status", "ok"}});
       }},
  };
  routes.push_back({"GET", "/", "the web page", GetPage});
  routes.push_back({"GET", "/assets/{id}", "a file of the web page", GetAsset});
  routes.push_back({"GET", "/v1", "this table", {}});
  routes.back().answer = [table = RouteTable(routes)](const Call&) {
    return JsonReply(200, table);
  };
  return routes;
}

bool Matches(const Route& route, std::string_view path, std::string& argument) {
  const std::string_view pattern = route.path;
  const auto at = pattern.find(kVariable);
  if (at == std::string_view::npos) return path == pattern;
  const auto head = pattern.substr(0, at);
  const auto tail = pattern.substr(at + kVariable.size());
  if (path.size() <= head.size() + tail.size() || !path.starts_with(head) ||
      !path.ends_with(tail)) {
    return false;
  }
  const auto middle = path.substr(at, path.size() - head.size() - tail.size());
  if (middle.find('/') != std::string_view::npos) return false;
  argument = middle;
  return true;
}

}  // namespace plenum::server
