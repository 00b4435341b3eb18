#include <fstream>
#include <memory>
#include <string>

#include "api/catalogue/stores.h"
#include "api/design/given/unit_of_design.h"
#include "api/design/verification.h"
#include "server/commands/commands.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/output.h"

namespace plenum::server {
namespace {

struct ExportOptions {
  std::string file, fmu;
  std::string catalog = catalog::DefaultCatalog();
  int rank = 1;
};

int Export(const ExportOptions& options) {
  const api::Json request = ValueOrRefuse(
      api::EvaluationOfRank(ReadJson(options.file, api::kResultBytesMax), options.rank));
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  const std::string unit = ValueOrRefuse(api::MakeUnitFile(request, store.List(), store.Models()));
  std::ofstream file(options.fmu, std::ios::binary);
  file << unit;
  if (!file.flush()) Refuse({{"--fmu", "cannot write " + options.fmu}});
  Tell(options.fmu + ": design " + std::to_string(options.rank) +
       " as a unit for co-simulation (FMI 2.0, 64-bit Linux)");
  return kAnswered;
}

}  // namespace

Command ExportCommand() {
  constexpr double kRankMax = 500;
  auto options = std::make_shared<ExportOptions>();
  return {"export",
          "A design as a unit (FMU) that the simulator of a robot drives",
          "plenum export result.json --rank 2 --fmu supply.fmu",
          {Argument("FILE", "Answer of design --json; - is standard input", &options->file),
           {"--fmu", "The file to write", &options->fmu, {.value_name = "FILE", .required = true}},
           {"--rank",
            "Which design of the answer",
            &options->rank,
            {.value_name = "N", .shows_default = true, .allowed = Within{1, kRankMax}}},
           CatalogOption(options->catalog)},
          [options] { return Export(*options); }};
}

}  // namespace plenum::server
