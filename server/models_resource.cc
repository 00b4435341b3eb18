#include "server/models_resource.h"

#include "api/services.h"

namespace plenum::server {
namespace {

api::Json Rendered(const std::vector<catalog::ModelRevision>& models) {
  api::Json list = api::Json::array();
  for (const catalog::ModelRevision& model : models)
    list.push_back(api::RenderModelRevision(model, true));
  return list;
}

}  // namespace

Reply ListModels(SharedCatalog& catalog, const Call&) {
  return JsonReply(
      200, {{"models",
             Rendered(catalog.With([](const catalog::Store& store) { return store.Models(); }))}});
}

Reply GetModel(SharedCatalog& catalog, const Call& call) {
  const auto versions =
      catalog.With([&](const catalog::Store& store) { return store.ModelVersions(call.argument); });
  if (versions.empty())
    return ProblemReply(404, "no model revision is named \"" + call.argument + "\"");
  return JsonReply(200, {{"name", call.argument}, {"versions", Rendered(versions)}});
}

}  // namespace plenum::server
