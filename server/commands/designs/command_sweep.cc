#include <memory>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/design/sweep/sweep_answer.h"
#include "api/design/sweep/sweep_request.h"
#include "api/design/sweep/sweep_table.h"
#include "api/json/json.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/designs/progress_line.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/interrupt.h"
#include "server/commands/output.h"
#include "server/render/text/text_design.h"
#include "server/render/text/text_jobs.h"

namespace plenum::server {
namespace {

struct SweepOptions {
  std::string file;
  std::string catalog = catalog::DefaultCatalog();
  bool csv = false, json = false;
};

api::Json AnswerWithProgress(const api::SweepRequest& sweep,
                             const std::vector<catalog::Part>& parts) {
  ProgressLine line;
  return api::AnswerSweep(
      sweep, parts, Interrupted, [&](std::size_t place, const optimizer::Progress* progress) {
        line.Show(std::to_string(place + 1) + " of " + std::to_string(sweep.requests.size()) +
                  ", " + sweep.requests[place].patch +
                  (progress != nullptr ? ": " + ProgressText(*progress) : ""));
      });
}

int Sweep(const SweepOptions& options) {
  CatchInterrupts();
  const api::Json document = ReadJson(options.file);
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  const auto [revision, parts] = store.ListWithHead();
  const auto sweep = ValueOrRefuse(api::ParseSweep(document, parts, store.Models()));
  api::Json table = AnswerWithProgress(sweep, parts);
  table["catalogue_revision"] = api::RenderRevisionName(revision);
  Print(options.csv ? api::SweepCsv(table) : options.json ? Dump(table) + "\n" : SweepText(table));
  return Interrupted() ? kInterrupted : kAnswered;
}

}  // namespace

Command SweepCommand() {
  auto options = std::make_shared<SweepOptions>();
  return {
      "sweep",
      "The best design for each of many requirements that differ in a few fields, as one table",
      "plenum sweep examples/how_often.json",
      {Argument("FILE", "sweep/1 as JSON; - is standard input", &options->file),
       {"--csv", "The table as CSV on standard output", &options->csv},
       {"--json", "One JSON document on standard output", &options->json, {.excludes = "--csv"}},
       CatalogOption(options->catalog)},
      [options] { return Sweep(*options); }};
}

}  // namespace plenum::server
