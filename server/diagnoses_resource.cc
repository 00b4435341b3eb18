#include "server/diagnoses_resource.h"

#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include "api/diagnose.h"
#include "api/reader.h"
#include "server/signature.h"

namespace plenum::server {
namespace {

constexpr const char* kModel = "model";
constexpr const char* kSave = "save";
constexpr const char* kTimeLimit = "time_limit_s";

// What the service takes beside the measurement.
struct Names {
  std::string model, save;  // empty: none
  double time_limit_s = api::kDiagnosisTimeS;
};

Names ReadNames(const api::Json& document, api::Errors& errors) {
  Names names;
  if (!document.is_object()) return names;  // reported with the measurement
  api::Reader reader(document, "", errors);
  if (reader.Has(kModel)) names.model = reader.Text(kModel);
  if (reader.Has(kSave)) names.save = reader.Text(kSave);
  names.time_limit_s =
      reader.Number(kTimeLimit, {0.01, api::kDiagnosisTimeMaxS}, api::kDiagnosisTimeS);
  const std::string why = names.save.empty() ? "" : catalog::WhyInvalidModelName(names.save);
  if (!why.empty()) reader.Fail(kSave, why);
  return names;
}

template <typename T>
T ValueOrAdd(api::Parsed<T> parsed, api::Errors& errors) {
  if (const auto* found = std::get_if<api::Errors>(&parsed)) {
    errors.insert(errors.end(), found->begin(), found->end());
    return {};
  }
  return std::get<T>(std::move(parsed));
}

struct Order {
  api::DiagnosisRequest request;
  std::string save, who;
};

api::Parsed<Order> ReadOrder(SharedCatalog& catalog, api::Json document, const std::string& body) {
  api::Errors errors;
  Order order;
  const Names names = ReadNames(document, errors);
  order.save = names.save;
  order.request.time_limit_s = names.time_limit_s;
  if (!names.model.empty() && names.model != "nominal") {
    const auto models = catalog.With([](const catalog::Store& store) { return store.Models(); });
    order.request.model = ValueOrAdd(api::FindModel(names.model, models, "/model"), errors);
  }
  if (document.is_object()) {
    document.erase(kModel);
    document.erase(kSave);
    document.erase(kTimeLimit);
  }
  order.request.dataset = ValueOrAdd(api::ParseMeasurement(document), errors);
  if (!errors.empty()) return errors;
  order.request.provenance.files = {api::FileOf(order.request.dataset.name, body)};
  return order;
}

api::Json Save(SharedCatalog& catalog, const Order& order,
               const std::optional<api::SavedModel>& revision) {
  if (!revision) return nullptr;
  const std::string text = Dump(api::RenderModel(*revision));
  return catalog.With([&](catalog::Store& store) {
    return api::RenderModelRevision(store.SaveModel(order.save, text, order.who), false);
  });
}

Work DiagnosisWork(SharedCatalog& catalog, Order order) {
  return [&catalog, order = std::move(order)](const JobControl& control) {
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto report = [&](double share, const std::string& doing) {
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      control.report({{"seconds", api::Number(elapsed.count())},
                      {"share", api::Number(share)},
                      {"doing", doing}});
    };
    auto diagnosis =
        api::RunDiagnosis(order.request, {.cancelled = control.cancelled, .progress = report});
    if (!order.save.empty()) diagnosis.answer["saved"] = Save(catalog, order, diagnosis.revision);
    return std::move(diagnosis.answer);
  };
}

}  // namespace

Reply PostDiagnosis(SharedCatalog& catalog, const JobsResource& diagnoses, const Call& call) {
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  auto parsed = ReadOrder(catalog, std::move(std::get<api::Json>(json)), call.body);
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  auto& order = std::get<Order>(parsed);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  order.who = std::get<catalog::Signature>(signature).who;
  const std::string name = order.request.dataset.name;
  return StartJob(diagnoses, call, name, DiagnosisWork(catalog, std::move(order)));
}

}  // namespace plenum::server
