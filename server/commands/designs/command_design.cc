#include <algorithm>
#include <cstdio>
#include <memory>

#include "api/catalogue/part_document.h"
#include "api/catalogue/stores.h"
#include "api/design/answer.h"
#include "api/design/read/requirements_reader.h"
#include "api/json/json.h"
#include "server/call/reply.h"
#include "server/commands/commands.h"
#include "server/commands/designs/progress_line.h"
#include "server/commands/exit_status.h"
#include "server/commands/files/input.h"
#include "server/commands/interrupt.h"
#include "server/commands/output.h"
#include "server/render/text/text_design.h"
#include "server/render/text/text_guarantee.h"

namespace plenum::server {
namespace {

struct DesignOptions {
  std::string file;
  std::string catalog = catalog::DefaultCatalog();
  std::optional<int> top;
  std::optional<double> time_limit_s;
  bool proof = false;
  std::string solver, list;
  bool wide = false;
  bool json = false;
};

// The requirements with what the flags say instead; checked like the rest.
api::Json ReadRequirements(const DesignOptions& options) {
  auto request = ReadJson(options.file);
  if (!request.is_object()) return request;
  const auto set = [&](const char* field, const api::Json& value) {
    auto& ranking = request["ranking"];
    if (ranking.is_null() || ranking.is_object()) ranking[field] = value;
  };
  if (options.top) set("count", *options.top);
  if (options.time_limit_s) set("time_limit_s", *options.time_limit_s);
  if (options.proof) set("proof", true);
  if (!options.solver.empty()) set("solver", options.solver);
  if (!options.list.empty()) set("list", options.list);
  return request;
}

api::Json AnswerWithProgress(const api::DesignRequest& request,
                             const std::vector<catalog::Part>& parts) {
  ProgressLine line;
  optimizer::SearchOptions options;
  options.cancelled = Interrupted;
  options.progress = [&](const optimizer::Progress& progress) {
    line.Show(ProgressText(progress));
  };
  return api::AnswerRequest(request, options, parts);
}

// What a person sees beside a list on paper: the best design that is guaranteed, and what to
// measure first. Empty where the request says itself what it wants of a guarantee, or has no best
// design.
std::string GuaranteeBeside(const api::DesignRequest& request,
                            const std::vector<catalog::Part>& parts) {
  constexpr double kSecondsMost = 10.0;
  if (request.request.contains("guarantee") || !request.pareto.empty() || request.robust ||
      request.model || request.proof || !api::WhyNotGuaranteed(request.problem, {}).empty())
    return "";
  api::DesignRequest best = request;
  best.guarantee = api::GuaranteeRequest{};
  best.problem.count = 1;
  best.problem.list = optimizer::ListOf::kCombinations;
  best.time_limit_s = std::min(request.time_limit_s, kSecondsMost);
  return GuaranteeText(AnswerWithProgress(best, parts));
}

int Design(const DesignOptions& options) {
  CatchInterrupts();
  const auto requirements = ReadRequirements(options);
  const catalog::Store store = OpenCatalog(options.catalog, catalog::Access::kRead);
  const auto [revision, parts] = store.ListWithHead();
  const auto request = ValueOrRefuse(api::ParseRequirements(requirements, parts, store.Models()));
  auto json = AnswerWithProgress(request, parts);
  json["catalogue_revision"] = api::RenderRevisionName(revision);
  Print(options.json ? Dump(json) + "\n" : DesignText(json, options.wide));
  if (!options.json && !json.at("designs").empty() && !Interrupted()) {
    std::fflush(stdout);
    Print("\n" + GuaranteeBeside(request, parts));
  }
  return Interrupted() ? kInterrupted : kAnswered;
}

}  // namespace

Command DesignCommand() {
  auto options = std::make_shared<DesignOptions>();
  return {"design",
          "Ranked designs for a requirements file",
          "plenum design examples/exosuit.json --top 3",
          {Argument("FILE", "Requirements as JSON; - is standard input", &options->file),
           {"--top", "Number of designs", &options->top, {.value_name = "N"}},
           {"--time-limit", "Seconds to search", &options->time_limit_s, {.value_name = "S"}},
           {"--solver",
            "Of continuous settings: ipopt, or nlopt for a second opinion",
            &options->solver,
            {.value_name = "NAME"}},
           {"--list",
            "kinds: of each kind of design the best; or combinations: all alike",
            &options->list,
            {.value_name = "WHAT"}},
           {"--wide", "All figures of each design in the table", &options->wide},
           {"--proof", "Keep the record of the search, for verify", &options->proof},
           JsonFlag(options->json),
           CatalogOption(options->catalog)},
          [options] { return Design(*options); }};
}

}  // namespace plenum::server
