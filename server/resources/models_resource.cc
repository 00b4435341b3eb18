#include "server/resources/models_resource.h"

#include "api/catalogue/stores.h"
#include "api/json/json.h"
#include "api/json/reader.h"
#include "api/measure/model_document.h"
#include "server/call/signature.h"

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
  return JsonReply(200, {{"models", Rendered(catalog.Models())}});
}

Reply GetModel(SharedCatalog& catalog, const Call& call) {
  const auto versions =
      catalog.With([&](const catalog::Store& store) { return store.ModelVersions(call.argument); });
  if (versions.empty())
    return ProblemReply(404, "no model revision is named \"" + call.argument + "\"");
  return JsonReply(200, {{"name", call.argument}, {"versions", Rendered(versions)}});
}

Reply SaveModel(SharedCatalog& catalog, const Call& call) {
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  api::Errors errors;
  api::Reader reader(std::get<api::Json>(json), "", errors);
  const std::string name = reader.Text("name");
  const std::string why = catalog::WhyInvalidModelName(name);
  if (!name.empty() && !why.empty()) reader.Fail("name", why);
  const api::Json* document = reader.Raw("model");
  if (document == nullptr) reader.Fail("model", "is required: a document model/1");
  reader.Finish();
  if (!errors.empty()) return ProblemReply(422, errors);
  auto model = api::ParseModel(*document);
  if (auto* wrong = std::get_if<api::Errors>(&model)) {
    for (api::Error& error : *wrong) error.pointer = "/model" + error.pointer;
    return ProblemReply(422, *wrong);
  }
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  const std::string text = Dump(api::RenderModel(std::get<api::SavedModel>(model)));
  return catalog.With([&](catalog::Store& store) {
    const auto saved = store.SaveModel(name, text, std::get<catalog::Signature>(signature));
    return saved ? JsonReply(201, api::RenderModelRevision(*saved, true)) : KeyReused();
  });
}

}  // namespace plenum::server
