#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "api/measure/diagnose_request.h"
#include "server/call/reply.h"
#include "server/commands/command_options.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/input.h"
#include "server/commands/interrupt.h"
#include "server/render/report_diagnosis.h"
#include "server/render/text_diagnosis.h"

namespace plenum::server {
namespace {

struct DiagnoseCommand {
  std::vector<std::string> files;
  std::string rig, model, save, report;
  std::string catalog = "catalog.db";
  std::vector<std::string> holdout;
  double time_limit_s = api::kDiagnosisTimeS;
  bool json = false;
};

// One line on the terminal, written over and over.
class ProgressLine {
 public:
  void Show(double share, const std::string& what) {
    if (!terminal_) return;
    std::fprintf(stderr, "\r\x1b[K%3.0f %%  %s", 100.0 * share, what.c_str());
    std::fflush(stderr);
  }
  ~ProgressLine() {
    if (terminal_) std::fputs("\r\x1b[K", stderr);
  }

 private:
  const bool terminal_ = isatty(STDERR_FILENO) != 0;
};

api::Json DocumentOf(const std::string& text) { return ValueOrRefuse(api::ParseJson(text)); }

// Every file as a measurement document; CSV with the rig file.
std::vector<api::Json> ReadDocuments(const DiagnoseCommand& command, api::Provenance& provenance) {
  std::vector<api::Json> documents;
  for (const std::string& file : command.files) {
    const std::string text = ReadText(file);
    provenance.files.push_back(api::FileOf(file, text));
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first != std::string::npos && (text[first] == '{' || text[first] == '[')) {
      documents.push_back(DocumentOf(text));
      continue;
    }
    if (command.rig.empty()) {
      if (!file.ends_with(".csv")) documents.push_back(DocumentOf(text));  // says what is wrong
      Refuse({{"--rig", "is required with CSV: the JSON file that describes the rig"}});
    }
    documents.push_back(
        ValueOrRefuse(api::MeasurementFromCsv(text, DocumentOf(ReadText(command.rig)))));
  }
  return documents;
}

std::optional<api::SavedModel> KnownModel(const DiagnoseCommand& command) {
  if (command.model.empty() || command.model == "nominal") return std::nullopt;
  const auto models = OpenCatalog(command.catalog, catalog::Access::kRead).Models();
  return ValueOrRefuse(api::FindModel(command.model, models, "--model"));
}

api::DiagnosisRequest ReadRequest(const DiagnoseCommand& command) {
  api::DiagnosisRequest request;
  api::Json document =
      ValueOrRefuse(api::MergeMeasurements(ReadDocuments(command, request.provenance)));
  if (!command.holdout.empty() && document.is_object()) document["holdout"] = command.holdout;
  request.dataset = ValueOrRefuse(api::ParseMeasurement(document));
  request.model = KnownModel(command);
  request.time_limit_s = command.time_limit_s;
  return request;
}

void WriteReport(const std::string& path, const api::Json& answer) {
  std::ofstream file(path, std::ios::binary);
  file << DiagnosisReport(answer);
  if (!file.flush()) Refuse({{"--report", "cannot write " + path}});
}

void SaveModel(const DiagnoseCommand& command, const std::optional<api::SavedModel>& revision) {
  if (!revision) {
    std::fprintf(stderr, "not saved: the diagnosis settled on no model\n");
    return;
  }
  catalog::Store store = OpenCatalog(command.catalog, catalog::Access::kWrite);
  const auto saved =
      store.SaveModel(command.save, api::RenderModel(*revision).dump(), CommandSignature().who);
  std::fprintf(stderr, "saved as %s, version %lld\n", saved.name.c_str(),
               static_cast<long long>(saved.version));
}

int Diagnose(const DiagnoseCommand& command) {
  CatchInterrupts();
  if (!command.save.empty()) {  // before the long work
    const std::string reason = catalog::WhyInvalidModelName(command.save);
    if (!reason.empty()) Refuse({{"--save", reason}});
  }
  const api::DiagnosisRequest request = ReadRequest(command);
  api::DiagnosisAnswer result;
  {
    ProgressLine line;
    result = api::RunDiagnosis(
        request, {.cancelled = Interrupted, .progress = [&](double share, const std::string& what) {
                    line.Show(share, what);
                  }});
  }
  const api::Json& answer = result.answer;
  std::fputs(command.json ? (Dump(answer) + "\n").c_str() : DiagnosisText(answer).c_str(), stdout);
  if (!command.report.empty()) WriteReport(command.report, answer);
  if (!command.save.empty()) SaveModel(command, result.revision);
  return Interrupted() ? kInterrupted : kAnswered;
}

}  // namespace

void AddDiagnoseCommand(CLI::App& app, int& status) {
  auto options = std::make_shared<DiagnoseCommand>();
  auto* command =
      app.add_subcommand("diagnose", "What the model lacks against measured pressure traces");
  command->add_option("FILE", options->files, "Measurements as JSON or CSV; - is standard input")
      ->required()
      ->type_name("");
  command->add_option("--rig", options->rig, "The rig of CSV files, as JSON")->type_name("FILE");
  command->add_option("--holdout", options->holdout, "Runs that no fit may see")->type_name("RUN");
  command->add_option("--model", options->model, "Predict with a saved model, without fitting")
      ->type_name("NAME");
  command->add_option("--save", options->save, "Keep the revised model for designs")
      ->type_name("NAME");
  command->add_option("--report", options->report, "Write an HTML report")->type_name("FILE");
  command->add_option("--time-limit", options->time_limit_s, "Seconds to search")
      ->check(CLI::Range(0.01, api::kDiagnosisTimeMaxS))
      ->capture_default_str()
      ->type_name("S");
  AddJsonFlag(*command, options->json);
  AddCatalogOption(*command, options->catalog);
  command->callback([options, &status] { status = Diagnose(*options); });
}

}  // namespace plenum::server
