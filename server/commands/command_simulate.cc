#include <cstdio>
#include <memory>

#include "api/catalogue/stores.h"
#include "api/design/evaluation.h"
#include "api/json/json.h"
#include "api/simulate/map.h"
#include "api/simulate/simulation.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/input.h"
#include "server/render/text/text_design.h"
#include "server/render/text/text_response.h"

namespace plenum::server {
namespace {

struct FileOptions {
  std::string file;
  std::string catalog = "catalog.db";
  bool json = false;
};

// A file names parts only by "part"; without one the catalogue is not opened.
bool NamesParts(const api::Json& json) {
  if (json.is_object() && json.contains("part")) return true;
  for (const auto& child : json) {
    if (child.is_structured() && NamesParts(child)) return true;
  }
  return false;
}

void Simulate(const FileOptions& options) {
  const auto request = ReadJson(options.file);
  std::vector<catalog::Part> parts;
  if (NamesParts(request)) parts = OpenCatalog(options.catalog, catalog::Access::kRead).List();
  const auto response = ValueOrRefuse(api::RunSimulation(request, parts));
  std::fputs(options.json ? (Dump(response) + "\n").c_str() : ResponseText(response).c_str(),
             stdout);
}

void Evaluate(const FileOptions& options) {
  const auto request = ReadJson(options.file);
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  const auto answer = ValueOrRefuse(api::RunEvaluation(request, store.List(), store.Models()));
  std::fputs(options.json ? (Dump(answer) + "\n").c_str() : EvaluationText(answer).c_str(), stdout);
}

void Map(const FileOptions& options) {
  const auto answer = ValueOrRefuse(api::RunMap(ReadJson(options.file)));
  std::fputs(options.json ? (Dump(answer) + "\n").c_str() : MapText(answer).c_str(), stdout);
}

Command FileCommand(const char* name, const char* help, void (*run)(const FileOptions&)) {
  auto options = std::make_shared<FileOptions>();
  return {name,
          help,
          {Argument("FILE", "Request as JSON; - is standard input", &options->file),
           JsonFlag(options->json), CatalogOption(options->catalog)},
          [options, run] {
            run(*options);
            return kAnswered;
          }};
}

}  // namespace

Command SimulateCommand() {
  return FileCommand("simulate", "Pressures of one given design over time", Simulate);
}

Command EvaluateCommand() {
  return FileCommand("evaluate", "A given design against requirements", Evaluate);
}

Command MapCommand() {
  return FileCommand("map", "Normalised rise and fall times over a grid", Map);
}

}  // namespace plenum::server
