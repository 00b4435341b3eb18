#include "server/designs_resource.h"

#include "api/services.h"

namespace plenum::server {
namespace {

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

}  // namespace

Reply PostDesign(SharedCatalog& catalog, const JobsResource& designs, const Call& call) {
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
  return StartJob(designs, call, name, DesignWork(std::move(request), std::move(view)));
}

}  // namespace plenum::server
