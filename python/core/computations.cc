#include "python/core/computations.h"

#include <algorithm>
#include <thread>

#include "api/catalogue/part_document.h"
#include "api/design/answer.h"
#include "api/design/given/evaluation.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/sweep/sweep_answer.h"
#include "api/design/verification.h"
#include "api/measure/csv/measurement_csv.h"
#include "api/measure/curves.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/rig_parts.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "python/core/documents.h"
#include "python/core/part_store.h"

namespace plenum::python {
namespace {

using catalog::Access;
using PartList = std::vector<catalog::Part>;

PartList PartsFor(const api::Json& request, const std::string& catalogue) {
  return api::NamesAnyPart(request) ? OpenCatalogue(catalogue, Access::kRead).List() : PartList();
}

api::Json RunSimulation(const api::Json& request, const PartList& parts) {
  return ValueOrRefuse(api::AsksForCurves(request) ? api::RunCurves(request)
                                                   : api::RunSimulation(request, parts));
}

TextWithArrays RunToArrays(const api::Json& request, const PartList& parts) {
  if (api::AsksForCurves(request)) return {Dump(RunSimulation(request, parts)), {}};
  auto [document, arrays] = ValueOrRefuse(api::RunSimulationToArrays(request, parts));
  return {Dump(document), std::move(arrays)};
}

std::string ErrorsAsDocument(const api::Errors& errors) {
  api::Json list = api::Json::array();
  for (const api::Error& error : errors)
    list.push_back({{"pointer", error.pointer}, {"detail", error.detail}});
  return Dump({{"errors", std::move(list)}});
}

api::Json ToJson(const optimizer::Progress& progress) {
  return {{"seconds", api::Number(progress.seconds)},
          {"evaluated", progress.evaluated},
          {"best", progress.best ? api::Number(*progress.best) : api::Json()},
          {"lower_bound", api::Number(progress.lower_bound)}};
}

}  // namespace

std::string Design(const std::string& requirements, const std::string& catalogue, Watch& watch) {
  const catalog::Store store = OpenCatalogue(catalogue, Access::kRead);
  const auto [revision, parts] = store.ListWithHead();
  const auto request =
      ValueOrRefuse(api::ParseRequirements(Parse(requirements), parts, store.Models()));
  optimizer::SearchOptions options;
  options.cancelled = [&] { return watch.cancelled(); };
  options.progress = [&](const optimizer::Progress& progress) {
    watch.Tell(Dump(ToJson(progress)));
  };
  api::Json answer = api::AnswerRequest(request, options, parts);
  answer["catalogue_revision"] = api::RenderRevisionName(revision);
  return Dump(answer);
}

std::string Sweep(const std::string& sweep, const std::string& catalogue, Watch& watch) {
  const catalog::Store store = OpenCatalogue(catalogue, Access::kRead);
  const auto [revision, parts] = store.ListWithHead();
  const auto request = ValueOrRefuse(api::ParseSweep(Parse(sweep), parts, store.Models()));
  api::Json table = api::AnswerSweep(
      request, parts, [&] { return watch.cancelled(); },
      [&](std::size_t place, const optimizer::Progress*) {
        watch.Tell(Dump({{"done", place}, {"of", request.requests.size()}}));
      });
  table["catalogue_revision"] = api::RenderRevisionName(revision);
  return Dump(table);
}

std::string Evaluate(const std::string& request, const std::string& catalogue) {
  const catalog::Store store = OpenCatalogue(catalogue, Access::kRead);
  return Dump(ValueOrRefuse(api::RunEvaluation(Parse(request), store.List(), store.Models())));
}

std::string Simulate(const std::string& request, const std::string& catalogue) {
  const api::Json json = Parse(request);
  return Dump(RunSimulation(json, PartsFor(json, catalogue)));
}

std::string Map(const std::string& request) {
  return Dump(ValueOrRefuse(api::RunMap(Parse(request))));
}

std::vector<TextWithArrays> SimulateMany(const std::vector<std::string>& requests,
                                         const std::string& catalogue, int threads, Watch& watch) {
  const bool named = std::any_of(requests.begin(), requests.end(), [](const std::string& text) {
    return text.find("\"part\"") != std::string::npos;
  });
  const PartList parts = named ? OpenCatalogue(catalogue, Access::kRead).List() : PartList();
  std::vector<TextWithArrays> answers(requests.size());
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    const api::SignalStack stack;
    for (std::size_t i = next++; i < requests.size() && !watch.cancelled(); i = next++) {
      try {
        answers[i] = RunToArrays(Parse(requests[i]), parts);
      } catch (const Refused& refused) {
        answers[i] = {ErrorsAsDocument(refused.errors()), {}};
      }
      watch.Tell(Dump({{"done", std::min(next.load(), requests.size())}, {"of", requests.size()}}));
    }
  };
  std::vector<std::future<void>> workers;
  workers.reserve(static_cast<std::size_t>(std::max(threads, 1)));
  for (int i = 0; i < std::max(threads, 1); ++i)
    workers.push_back(std::async(std::launch::async, work));
  for (auto& worker : workers) worker.get();
  return answers;
}

std::string Diagnose(const std::vector<std::string>& measurements, const DiagnosisWish& wish,
                     const std::string& catalogue, Watch& watch) {
  std::vector<api::Json> documents;
  documents.reserve(measurements.size());
  for (const std::string& text : measurements) documents.push_back(Parse(text));
  api::Json document = ValueOrRefuse(api::MergeMeasurements(documents));
  api::Errors errors;
  if (api::NamesParts(document))
    document =
        api::WithParts(std::move(document), OpenCatalogue(catalogue, Access::kRead).List(), errors);
  if (!errors.empty()) throw Refused(std::move(errors));
  api::DiagnosisRequest request;
  request.time_limit_s = wish.time_limit_s;
  for (const auto& [name, text] : wish.files)
    request.provenance.files.push_back(api::FileOf(name, text));
  request.dataset = ValueOrRefuse(api::ParseMeasurement(document, &request.remarks));
  request.measurement = std::move(document);
  if (!wish.model.empty() && wish.model != "nominal")
    request.model = ValueOrRefuse(
        api::FindModel(wish.model, OpenCatalogue(catalogue, Access::kRead).Models(), "model"));
  const api::DiagnosisAnswer result =
      api::RunDiagnosis(request, {.cancelled = [&] { return watch.cancelled(); },
                                  .progress =
                                      [&](double share, const std::string& what) {
                                        watch.Tell(Dump({{"share", share}, {"doing", what}}));
                                      }});
  return Dump(result.answer);
}

std::string MeasurementFromCsv(const std::string& csv, const std::string& rig) {
  return Dump(ValueOrRefuse(api::MeasurementFromCsv(csv, Parse(rig))));
}

std::string Verify(const std::string& result, const std::string& catalogue, bool brute_force,
                   Watch& watch) {
  const auto [revision, parts] = OpenCatalogue(catalogue, Access::kRead).ListWithHead();
  std::optional<api::BruteForce> wish;
  if (brute_force)
    wish = api::BruteForce{.progress = [&](double share) {
      watch.Tell(Dump({{"share", share}, {"doing", "all combinations"}}));
    }};
  return Dump(ValueOrRefuse(
      api::VerifyAnswer(Parse(result), parts, revision, wish, [&] { return watch.cancelled(); })));
}

}  // namespace plenum::python
