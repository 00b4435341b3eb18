#include "server/resources/diagnoses_resource.h"

#include <chrono>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/part_revision.h"
#include "server/call/request_log.h"
#include "server/call/service_limits.h"
#include "server/call/signature.h"
#include "server/jobs/job_inputs.h"

namespace plenum::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kSavePatience{60};
constexpr const char* kModel = "model";
constexpr const char* kSave = "save";
constexpr const char* kSavePart = "save_part";
constexpr const char* kSavePartAnyway = "save_part_anyway";
constexpr const char* kSavePartSpecimen = "save_part_specimen";
constexpr const char* kTimeLimit = api::kTimeLimitField;

// What the service takes beside the measurement.
struct Names {
  std::string model, save, save_part, specimen;  // empty: none
  bool save_part_anyway = false;
  double time_limit_s = api::kDiagnosisTimeS;
};

Names ReadNames(const api::Json& document, api::Errors& errors) {
  Names names;
  if (!document.is_object()) return names;  // reported with the measurement
  api::Reader reader(document, "", errors);
  if (reader.Has(kModel)) names.model = reader.Text(kModel);
  if (reader.Has(kSave)) names.save = reader.Text(kSave);
  if (reader.Has(kSavePart)) names.save_part = reader.Text(kSavePart);
  if (reader.Has(kSavePartSpecimen)) names.specimen = reader.Text(kSavePartSpecimen);
  const std::string wrong = api::WhyInvalidSpecimen(names.specimen, names.save_part);
  if (!wrong.empty()) reader.Fail(kSavePartSpecimen, wrong);
  names.save_part_anyway = reader.Bool(kSavePartAnyway, false);
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

struct Request {
  api::DiagnosisRequest diagnosis;
  Names names;
  std::optional<catalog::ModelRevision> model;  // of the diagnosis
};

// The measurement with the numbers of the parts that its rigs name.
api::Json ReadParts(api::Json document, const std::function<Parts()>& parts, api::Errors& errors) {
  if (!api::NamesParts(document)) return document;
  const Parts found = parts();
  if (!found) {
    errors.push_back({"/rig", "names parts, and the catalogue of the job is no longer there"});
    return document;
  }
  return api::WithParts(std::move(document), *found, errors);
}

// `models` are the newest of each name that "model" may ask for, `parts` those that rigs may name;
// null: they cannot be found.
api::Parsed<Request> ReadRequest(std::string_view body,
                                 const std::vector<catalog::ModelRevision>& models,
                                 const std::function<Parts()>& parts, api::Json document) {
  api::Errors errors;
  Request request;
  const Names names = ReadNames(document, errors);
  request.names = names;
  request.diagnosis.time_limit_s = names.time_limit_s;
  if (!names.model.empty() && names.model != "nominal") {
    request.diagnosis.model = ValueOrAdd(api::FindModel(names.model, models, "/model"), errors);
    for (const auto& model : models)
      if (model.name == names.model) request.model = model;
  }
  if (document.is_object()) {
    document.erase(kModel);
    document.erase(kSave);
    document.erase(kSavePart);
    document.erase(kSavePartAnyway);
    document.erase(kSavePartSpecimen);
    document.erase(kTimeLimit);
  }
  document = ReadParts(std::move(document), parts, errors);
  request.diagnosis.dataset =
      ValueOrAdd(api::ParseMeasurement(document, &request.diagnosis.remarks), errors);
  if (!errors.empty()) return errors;
  if (const std::string why = api::WhyNotMeasured(request.diagnosis.dataset, names.save_part);
      !why.empty())
    return api::Errors{{std::string("/") + kSavePart, why}};
  request.diagnosis.measurement = std::move(document);
  request.diagnosis.provenance.files = {api::FileOf(request.diagnosis.dataset.name, body)};
  return request;
}

std::size_t SamplesOf(const calibration::Dataset& dataset) {
  std::size_t samples = 0;
  for (const auto& run : dataset.runs) samples += run.t_s.size();
  return samples;
}

// The turn of a diagnosis that takes much memory, when it comes; none for one that takes little, or
// when the job is cancelled while it waits.
std::shared_ptr<void> AwaitTurn(const calibration::Dataset& dataset, const JobControl& control) {
  static Turnstile large(kLargeDiagnosesMax);
  std::shared_ptr<void> turn;
  if (SamplesOf(dataset) <= kLargeDiagnosisSamples) return turn;
  control.report({{"seconds", 0}, {"share", 0}, {"doing", "waits for another large diagnosis"}});
  while (!(turn = large.Enter()) && !control.cancelled())
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  return turn;
}

// Puts the name under which the model was saved into the answer; where that fails the model itself,
// to be saved later: the diagnosis is worth more than its place.
void Save(SharedCatalog& catalog, const std::string& name, const std::string& who,
          const std::optional<api::SavedModel>& revision, api::Json& answer) {
  answer["saved"] = nullptr;
  if (!revision) return;
  const api::Json model = api::RenderModel(*revision);
  try {
    answer["saved"] = catalog.With(
        [&](catalog::Store& store) {
          return api::RenderModelRevision(store.SaveModel(name, Dump(model), who), false);
        },
        kSavePatience);
  } catch (const catalog::StoreError& error) {
    Log({{"level", "error"}, {"model", name}, {"not_saved", error.what()}});
    answer["not_saved"] = {
        {"detail",
         error.fault() == catalog::StoreFault::kBusy
             ? "the catalogue is being written by another; POST name and model to /v1/models"
             : "the catalogue cannot be written; POST name and model to /v1/models"},
        {"name", name},
        {"model", model}};
  }
}

// Of a recording that the part refers to.
void KeepRecording(SharedCatalog& catalog, const std::string& id, const std::string& recording,
                   const catalog::Signature& by) {
  try {
    catalog.With(
        [&](catalog::Store& store) {
          return catalog::DocumentFiles::Add(store, id, {"", "application/json", recording}, by);
        },
        kSavePatience);
  } catch (const catalog::StoreError& error) {
    Log({{"level", "error"}, {"part", id}, {"recording_not_kept", error.what()}});
  }
}

// Puts what was written into the part, or why nothing was, into the answer; keeps the recording.
void SavePart(SharedCatalog& catalog, const Names& names, const catalog::JobOrder& order,
              const std::vector<api::Provenance::File>& files, api::Json& answer) {
  const catalog::Signature by{.who = order.by.who, .key = "", .request = ""};
  try {
    answer["saved_part"] = catalog.With(
        [&](catalog::Store& store) {
          return api::SavePart(store, names.save_part, answer, files, names.save_part_anyway, by,
                               names.specimen);
        },
        kSavePatience);
    if (!answer["saved_part"].at("revision").is_null())
      KeepRecording(catalog, names.save_part, order.request, by);
  } catch (const catalog::StoreError& error) {
    Log({{"level", "error"}, {"part", names.save_part}, {"not_saved", error.what()}});
    answer["saved_part"] = {
        {"part", names.save_part},
        {"specimen", names.specimen.empty() ? api::Json(nullptr) : api::Json(names.specimen)},
        {"numbers", api::Json::array()},
        {"refused", api::Json::array({"the catalogue could not be written: post again"})},
        {"revision", nullptr}};
  }
}

}  // namespace

Work DiagnosisWork(SharedCatalog& catalog) {
  return [&catalog](const catalog::JobOrder& order,
                    const JobControl& control) -> api::Parsed<api::Json> {
    auto models = ModelsOf(catalog, order);
    if (auto* errors = std::get_if<api::Errors>(&models)) return *errors;
    auto json = api::ParseJson(order.request);
    if (auto* errors = std::get_if<api::Errors>(&json)) return *errors;
    const auto parts_of_order = [&]() -> Parts {
      const auto view = PartsOf(catalog, order);
      return std::holds_alternative<CatalogView>(view) ? std::get<CatalogView>(view).parts()
                                                       : nullptr;
    };
    auto parsed = ReadRequest(order.request, std::get<std::vector<catalog::ModelRevision>>(models),
                              parts_of_order, std::get<api::Json>(std::move(json)));
    if (auto* errors = std::get_if<api::Errors>(&parsed)) return *errors;
    const auto& request = std::get<Request>(parsed);

    const auto turn = AwaitTurn(request.diagnosis.dataset, control);
    const auto start = Clock::now();
    const auto report_of = [&](double share, const std::string& doing) -> api::Json {
      const std::chrono::duration<double> elapsed = Clock::now() - start;
      return {{"seconds", api::Number(elapsed.count())},
              {"share", api::Number(share)},
              {"doing", doing}};
    };
    const auto report = [&](double share, const std::string& doing) {
      control.report(report_of(share, doing));
    };
    const auto cancelled = [&] {
      return control.cancelled() ||
             Clock::now() - start > std::chrono::seconds(api::kDiagnosisSecondsMax);
    };
    auto diagnosis =
        api::RunDiagnosis(request.diagnosis, {.cancelled = cancelled, .progress = report});
    const Names& names = request.names;
    if (!names.save.empty())
      Save(catalog, names.save, order.by.who, diagnosis.revision, diagnosis.answer);
    if (!names.save_part.empty())
      SavePart(catalog, names, order, request.diagnosis.provenance.files, diagnosis.answer);
    // The last progress, which a list of jobs shows in place of the answer.
    auto outcome = report_of(1.0, "ended");
    outcome["outcome"] = diagnosis.answer.at("verdict");
    control.report(std::move(outcome));
    return std::move(diagnosis.answer);
  };
}

Reply PostDiagnosis(SharedCatalog& catalog, const JobsResource& diagnoses, const Call& call) {
  auto query_errors = CheckQuery(call, {"priority"});
  const int priority = ReadPriority(call, query_errors);
  if (!query_errors.empty()) return ProblemReply(422, query_errors);
  auto json = api::ParseJson(call.body);
  if (auto* errors = std::get_if<api::Errors>(&json)) return ProblemReply(400, *errors);
  const auto models = catalog.Models();
  auto parsed = ReadRequest(
      call.body, models, [&] { return catalog.Snapshot(); }, std::move(std::get<api::Json>(json)));
  if (auto* errors = std::get_if<api::Errors>(&parsed)) return ProblemReply(422, *errors);
  const auto signature = SignatureOf(call);
  if (const auto* refused = std::get_if<Reply>(&signature)) return *refused;
  const auto& request = std::get<Request>(parsed);
  const auto head = catalog.Head();
  auto order = OrderOf(call, std::get<catalog::Signature>(signature),
                       request.diagnosis.dataset.name, head, request.model);
  order.priority = priority;
  return StartJob(diagnoses, call, std::move(order));
}

}  // namespace plenum::server
