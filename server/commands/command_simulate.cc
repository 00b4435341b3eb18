#include <cstdio>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "api/catalogue/stores.h"
#include "api/design/given/evaluation.h"
#include "api/json/json.h"
#include "api/measure/curves.h"
#include "api/measure/stated_document.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/files/measurement_files.h"
#include "server/commands/output.h"
#include "server/render/text/text_design.h"
#include "server/render/text/text_response.h"

namespace plenum::server {
namespace {

struct FileOptions {
  std::string file;
  std::string catalog = catalog::DefaultCatalog();
  bool json = false;
};

struct SimulateOptions {
  std::string file, from, run, model = "after";
  CsvOptions csv;
  std::vector<std::string> measurement;
  std::string catalog = catalog::DefaultCatalog();
  bool json = false;
};

// The request that the options stand for.
api::Json CurvesRequest(const SimulateOptions& options) {
  api::Json request = {{"schema", "simulation/1"},
                       {"from", ReadJson(options.from, api::kResultBytesMax)},
                       {"model", options.model}};
  if (!options.run.empty()) request["run"] = options.run;
  api::Provenance files;
  if (!options.measurement.empty())
    request["measurement"] = ReadMeasurement(options.measurement, options.csv, {}, files);
  return request;
}

int Simulate(const SimulateOptions& options) {
  if (options.file.empty() == options.from.empty())
    Refuse({{"FILE", "or --from is required, and not both: a simulation, or a diagnosis"}});
  const auto request = options.from.empty() ? ReadJson(options.file) : CurvesRequest(options);
  api::Json response;
  std::string text;
  if (api::AsksForCurves(request)) {
    response = ValueOrRefuse(api::RunCurves(request));
    text = CurvesText(response);
  } else {
    std::vector<catalog::Part> parts;
    if (api::NamesAnyPart(request))
      parts = OpenCatalog(options.catalog, catalog::Access::kRead).List();
    response = ValueOrRefuse(api::RunSimulation(request, parts));
    text = ResponseText(response);
  }
  Print(options.json ? Dump(response) + "\n" : text);
  return kAnswered;
}

struct EvaluateOptions {
  std::string file, beside;
  std::string catalog = catalog::DefaultCatalog();
  bool json = false;
};

// The first design of a saved answer.
api::Json FirstDesign(const std::string& file) {
  const api::Json answer = ReadJson(file);
  if (answer.is_object() && answer.contains("designs") && answer["designs"].is_array() &&
      !answer["designs"].empty())
    return answer["designs"][0];
  throw BadInput("--beside " + file + ": must be the answer of plenum design with a design in it");
}

void Evaluate(const EvaluateOptions& options) {
  auto request = ReadJson(options.file);
  if (!options.beside.empty() && request.is_object())
    request["beside"] = FirstDesign(options.beside);
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  const auto answer = ValueOrRefuse(api::RunEvaluation(request, store.List(), store.Models()));
  Print(options.json ? Dump(answer) + "\n" : EvaluationText(answer));
}

void Map(const FileOptions& options) {
  const auto answer = ValueOrRefuse(api::RunMap(ReadJson(options.file)));
  Print(options.json ? Dump(answer) + "\n" : MapText(answer));
}

Command FileCommand(const char* name, const char* help, const char* example,
                    void (*run)(const FileOptions&)) {
  auto options = std::make_shared<FileOptions>();
  return {name,
          help,
          example,
          {Argument("FILE", "Request as JSON; - is standard input", &options->file),
           JsonFlag(options->json), CatalogOption(options->catalog)},
          [options, run] {
            run(*options);
            return kAnswered;
          }};
}

}  // namespace

Command SimulateCommand() {
  auto options = std::make_shared<SimulateOptions>();
  std::vector<Option> table = {
      {"FILE", "Request as JSON; - is standard input", &options->file, {.value_name = ""}},
      {"--from", "The answer of a diagnosis: its curves", &options->from, {.value_name = "FILE"}},
      {"--run", "One of its runs; all without it", &options->run, {.value_name = "ID"}},
      {"--model",
       "The model of the diagnosis",
       &options->model,
       {.shows_default = true,
        .allowed =
            OneOf(std::begin(api::kModelsOfADiagnosis), std::end(api::kModelsOfADiagnosis))}},
      {"--measurement",
       "What was measured, where the answer names readings by hash",
       &options->measurement,
       {.value_name = "FILE"}}};
  for (Option& option : CsvOptionTable(options->csv)) table.push_back(std::move(option));
  table.push_back(JsonFlag(options->json));
  table.push_back(CatalogOption(options->catalog));
  return {"simulate", "Pressures of one given design, or of a model of a diagnosis, over time",
          "plenum simulate examples/simulation_effects.json", std::move(table),
          [options] { return Simulate(*options); }};
}

Command EvaluateCommand() {
  auto options = std::make_shared<EvaluateOptions>();
  return {"evaluate",
          "A given design against requirements",
          "plenum evaluate examples/gripper_by_hand.json",
          {Argument("FILE", "Request as JSON; - is standard input", &options->file),
           {"--beside",
            "A saved answer: why the given design is not its first",
            &options->beside,
            {.value_name = "RESULT"}},
           JsonFlag(options->json),
           CatalogOption(options->catalog)},
          [options] {
            Evaluate(*options);
            return kAnswered;
          }};
}

Command MapCommand() {
  return FileCommand("map", "Normalised rise and fall times over a grid",
                     "plenum map examples/map.json", Map);
}

}  // namespace plenum::server
