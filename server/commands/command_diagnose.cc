#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/catalogue/documents/part_files.h"
#include "api/catalogue/stores.h"
#include "api/json/reader.h"
#include "api/measure/diagnose_request.h"
#include "api/measure/rig_parts.h"
#include "api/protocol/part_revision.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/designs/progress_line.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/files/measurement_files.h"
#include "server/commands/interrupt.h"
#include "server/commands/output.h"
#include "server/render/report_diagnosis.h"
#include "server/render/text/text_diagnosis.h"
#include "server/render/text/text_protocol.h"
#include "server/render/text/text_remarks.h"

namespace plenum::server {
namespace {

struct DiagnoseOptions {
  std::vector<std::string> files;
  CsvOptions csv;
  std::string model, save, report, save_part, specimen;
  std::string catalog = catalog::DefaultCatalog();
  std::vector<std::string> holdout, assume;
  std::optional<double> time_limit_s;
  bool json = false, save_part_anyway = false;
};

std::optional<api::SavedModel> KnownModel(const DiagnoseOptions& options) {
  if (options.model.empty() || options.model == "nominal") return std::nullopt;
  const auto models = OpenCatalog(options.catalog, catalog::Access::kRead).Models();
  return ValueOrRefuse(api::FindModel(options.model, models, "--model"));
}

// What the option says, else the measurement, as that of a protocol's template does.
double TakeTimeLimit(const DiagnoseOptions& options, api::Json& document, api::Errors& errors) {
  if (!document.is_object() || !document.contains(api::kTimeLimitField))
    return options.time_limit_s.value_or(api::kDiagnosisTimeS);
  api::Reader reader(document, "", errors);
  const double limit_s =
      reader.Number(api::kTimeLimitField, {0.01, api::kDiagnosisTimeMaxS}, api::kDiagnosisTimeS);
  document.erase(api::kTimeLimitField);
  return options.time_limit_s.value_or(limit_s);
}

api::DiagnosisRequest ReadRequest(const DiagnoseOptions& options) {
  api::DiagnosisRequest request;
  api::Json document =
      ReadMeasurement(options.files, options.csv, options.assume, request.provenance);
  if (!options.holdout.empty() && document.is_object()) document["holdout"] = options.holdout;
  if (!options.assume.empty() && document.is_object()) document["assume"] = options.assume;
  api::Errors errors;
  request.time_limit_s = TakeTimeLimit(options, document, errors);
  if (api::NamesParts(document))
    document = api::WithParts(std::move(document),
                              OpenCatalog(options.catalog, catalog::Access::kRead).List(), errors);
  if (!errors.empty()) Refuse(errors);
  request.dataset = ValueOrRefuse(api::ParseMeasurement(document, &request.remarks));
  if (const std::string why = api::WhyInvalidSpecimen(options.specimen, options.save_part);
      !why.empty())
    Refuse({{"--save-part-specimen", why}});
  if (const std::string why = api::WhyNotMeasured(request.dataset, options.save_part); !why.empty())
    Refuse({{"--save-part", why}});
  request.measurement = std::move(document);
  request.model = KnownModel(options);
  return request;
}

void WriteReport(const std::string& path, const api::Json& answer) {
  std::ofstream file(path, std::ios::binary);
  file << DiagnosisReport(answer);
  if (!file.flush()) Refuse({{"--report", "cannot write " + path}});
}

void SaveModel(const DiagnoseOptions& options, const std::optional<api::SavedModel>& revision) {
  if (!revision) {
    std::fprintf(stderr, "not saved: the diagnosis settled on no model\n");
    return;
  }
  catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kWrite);
  const auto saved =
      store.SaveModel(options.save, api::RenderModel(*revision).dump(), CommandSignature().who);
  std::fprintf(stderr, "saved as %s, version %lld\n", saved.name.c_str(),
               static_cast<long long>(saved.version));
}

// Of the recordings that the part refers to since it was saved.
void KeepRecordings(catalog::Store& store, const DiagnoseOptions& options) {
  for (const std::string& file : options.files) {
    const auto kept = catalog::DocumentFiles::Add(
        store, options.save_part, {"", api::MediaTypeOf(file), ReadText(file)}, CommandSignature());
    for (const catalog::FieldError& error : kept.errors)
      Tell(file + ": the file is not kept: " + error.detail);
  }
}

int Diagnose(const DiagnoseOptions& options) {
  CatchInterrupts();
  if (!options.save.empty()) {  // before the long work
    const std::string reason = catalog::WhyInvalidModelName(options.save);
    if (!reason.empty()) Refuse({{"--save", reason}});
  }
  const api::DiagnosisRequest request = ReadRequest(options);
  api::DiagnosisAnswer result;
  {
    ProgressLine line;
    result = api::RunDiagnosis(
        request, {.cancelled = Interrupted, .progress = [&](double share, const std::string& what) {
                    line.Show(share, what);
                  }});
  }
  api::Json& answer = result.answer;
  if (!options.save_part.empty()) {
    catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kWrite);
    answer["saved_part"] =
        api::SavePart(store, options.save_part, answer, request.provenance.files,
                      options.save_part_anyway, CommandSignature(), options.specimen);
    if (!answer["saved_part"]["revision"].is_null()) KeepRecordings(store, options);
  }
  Print(options.json ? Dump(answer) + "\n"
                     : RecordingText(answer) + MeasuredText(answer) + DiagnosisText(answer));
  if (!options.report.empty()) WriteReport(options.report, answer);
  if (!options.save.empty()) SaveModel(options, result.revision);
  return Interrupted() ? kInterrupted : kAnswered;
}

std::vector<Option> DiagnosisOptions(DiagnoseOptions& options) {
  return {{"--holdout", "Runs that no fit may see", &options.holdout, {.value_name = "RUN"}},
          {"--assume",
           "What readings in suspect units are: kpa_abs, psi, and so on, or as_written",
           &options.assume,
           {.value_name = "UNIT"}},
          {"--model",
           "Predict with a saved model, without fitting",
           &options.model,
           {.value_name = "NAME"}},
          {"--save", "Keep the revised model for designs", &options.save, {.value_name = "NAME"}},
          {"--save-part",
           "Write the measured numbers of this part into the catalogue",
           &options.save_part,
           {.value_name = "ID"}},
          {"--save-part-anyway", "Also where they contradict what stands there",
           &options.save_part_anyway},
          {"--save-part-specimen",
           "The piece of the part's type that was measured",
           &options.specimen,
           {.value_name = "NAME"}},
          {"--report", "Write an HTML report", &options.report, {.value_name = "FILE"}},
          {"--time-limit",
           "Seconds to search; without it what the measurement says, or 60",
           &options.time_limit_s,
           {.value_name = "S", .allowed = Within{0.01, api::kDiagnosisTimeMaxS}}},
          JsonFlag(options.json),
          CatalogOption(options.catalog)};
}

}  // namespace

Command DiagnoseCommand() {
  auto options = std::make_shared<DiagnoseOptions>();
  std::vector<Option> table = {
      Argument("FILE", "Measurements as JSON or CSV; - is standard input", &options->files),
  };
  for (Option& option : CsvOptionTable(options->csv)) table.push_back(std::move(option));
  for (Option& option : DiagnosisOptions(*options)) table.push_back(std::move(option));
  return {"diagnose", "What the model lacks against measured pressure traces",
          "plenum diagnose examples/simulated_recording.json --report report.html",
          std::move(table), [options] { return Diagnose(*options); }};
}

}  // namespace plenum::server
