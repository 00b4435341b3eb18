#include "api/design/guaranteed.h"

#include <algorithm>
#include <chrono>

#include "api/design/designs.h"
#include "api/design/explanation.h"
#include "api/design/read/selection.h"
#include "api/design/savings/measure_first.h"
#include "api/design/savings/measure_together.h"
#include "optimizer/explain/explained_search.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

constexpr double kShareOfAList = 0.4;  // of the time limit

// What a list has in the document, beside what it shares with the other one.
Json OfTheList(Json document) {
  Json list = Json::object();
  for (const char* field : {"status", "list", "designs", "by_configuration", "orderable",
                            "price_basis", "best_on_measured_flow", "proof", "conflict",
                            "conflicts", "relaxation", "conflicts_complete", "seconds"})
    if (document.contains(field)) list[field] = std::move(document[field]);
  return list;
}

// Valves that the guaranteed list leaves out.
int OpenValves(const optimizer::Problem& problem) {
  if (!NeedsHoldingValves(problem)) return 0;
  return static_cast<int>(
      std::count_if(problem.parts.valves.begin(), problem.parts.valves.end(),
                    [](const model::Valve& valve) { return !model::Holds(valve.kind); }));
}

}  // namespace

Json RenderMost(const optimizer::Design& design, const optimizer::Problem& guaranteed) {
  double mass_kg = design.totals.mass_kg, volume_m3 = design.totals.volume_m3;
  for (const optimizer::Choice& choice : design.parts) {
    const int part = optimizer::FindPart(guaranteed.parts, choice.family, choice.id);
    if (part < 0) {  // made to measure
      mass_kg += guaranteed.guarantee->made_share * choice.mass_kg;
      volume_m3 += guaranteed.guarantee->made_share * choice.volume_m3;
      continue;
    }
    const model::PartBasics& basics = optimizer::BasicsOf(guaranteed.parts, choice.family, part);
    mass_kg += choice.quantity * basics.mass_slack_kg;
    volume_m3 += choice.quantity * basics.body_volume_slack_m3;
  }
  return {{"mass_kg_max", Number(mass_kg)}, {"volume_l_max", Number(volume_m3 * 1e3)}};
}

Json RenderGuarantee(const Tolerance& tolerance, const optimizer::Answer& guaranteed,
                     const optimizer::Answer& on_paper) {
  Json json = {{"tolerance", RenderTolerance(tolerance)},
               {"objective_on_paper", nullptr},
               {"objective_guaranteed", nullptr},
               {"costs", nullptr},
               {"costs_share", nullptr}};
  if (!on_paper.designs.empty())
    json["objective_on_paper"] = Number(on_paper.designs.front().objective);
  if (guaranteed.designs.empty()) return json;
  const double objective = guaranteed.designs.front().objective;
  json["objective_guaranteed"] = Number(objective);
  // Known prices and sums where unknown ones count as 0 are not compared.
  if (on_paper.designs.empty() || on_paper.lower_bound_prices != guaranteed.lower_bound_prices)
    return json;
  const double paper = on_paper.designs.front().objective;
  json["costs"] = Number(objective - paper);
  if (paper > 0.0) json["costs_share"] = Number(objective / paper - 1.0);
  return json;
}

Json AnswerGuaranteed(const DesignRequest& request, const optimizer::SearchOptions& options,
                      const std::vector<catalog::Part>& rows) {
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  optimizer::SearchOptions of_a_list = options;
  of_a_list.time_limit_s = kShareOfAList * options.time_limit_s;
  const optimizer::Answer on_paper = optimizer::Search(request.problem, of_a_list);

  DesignRequest certain = request;
  const optimizer::Problem& problem = certain.problem =
      GuaranteedProblem(request.problem, *request.guarantee, rows);
  of_a_list.select = [&](const optimizer::Problem& other) {
    return GuaranteedProblem(other, *request.guarantee, rows).parts;
  };
  const optimizer::Answer guaranteed = optimizer::Search(problem, of_a_list);

  Json document = RenderAnswer(certain, guaranteed, rows);
  for (std::size_t i = 0; i < guaranteed.designs.size(); ++i)
    document["designs"][i]["guarantee"] = RenderMost(guaranteed.designs[i], problem);
  if (const int left_out = OpenValves(request.problem); left_out > 0)
    document["left_out"]["guarantee"]["valve"] = left_out;
  document["guarantee"] = RenderGuarantee(request.guarantee->tolerance, guaranteed, on_paper);
  document["on_paper"] = OfTheList(RenderAnswer(request, on_paper, rows));
  optimizer::SearchOptions rest = options;
  for (const auto add : {AddMeasureTogether, AddMeasureFirst}) {
    rest.time_limit_s = std::max(0.0, options.time_limit_s - seconds());
    add(request, guaranteed, on_paper, rest, rows, document);
  }
  if (request.explain) AddExplanation(*request.explain, problem, guaranteed, of_a_list, document);
  document["seconds"] = Number(seconds());
  return document;
}

}  // namespace plenum::api
