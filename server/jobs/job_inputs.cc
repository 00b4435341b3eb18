#include "server/jobs/job_inputs.h"

#include <utility>

namespace plenum::server {
namespace {

// Of a job, whose thread waits for nothing else.
constexpr std::chrono::seconds kPatience{60};

}  // namespace

catalog::JobOrder OrderOf(const Call& call, const catalog::Signature& by, std::string name,
                          const catalog::Revision& revision,
                          const std::optional<catalog::ModelRevision>& model) {
  catalog::JobOrder order;
  order.name = std::move(name);
  order.by = by;
  order.client = call.client;
  order.request = call.body;
  order.revision = revision.number;
  order.hash = revision.hash;
  if (model) {
    order.model = model->name;
    order.model_version = model->version;
    order.model_hash = model->hash;
  }
  return order;
}

api::Parsed<CatalogView> PartsOf(SharedCatalog& catalog, const catalog::JobOrder& order) {
  auto view = catalog.ViewAt(order.revision, kPatience);
  if (!view || view->revision.hash != order.hash)
    return api::Errors{{"", "the catalogue has no revision " + std::to_string(order.revision) +
                                " with the hash " + order.hash +
                                " any more; post the request again"}};
  return *std::move(view);
}

api::Parsed<std::vector<catalog::ModelRevision>> ModelsOf(SharedCatalog& catalog,
                                                          const catalog::JobOrder& order) {
  if (order.model.empty()) return std::vector<catalog::ModelRevision>();
  auto model = catalog.With(
      [&](const catalog::Store& store) {
        return store.FindModel(order.model, order.model_version);
      },
      kPatience);
  if (!model || model->hash != order.model_hash)
    return api::Errors{{"/model", "the catalogue has no version " +
                                      std::to_string(order.model_version) + " of \"" + order.model +
                                      "\" with the hash " + order.model_hash +
                                      " any more; post the request again"}};
  return std::vector{*std::move(model)};
}

}  // namespace plenum::server
