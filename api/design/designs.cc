#include "api/design/designs.h"

#include <algorithm>
#include <cmath>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/design_document.h"
#include "api/design/proof_record.h"
#include "api/design/read/selection.h"
#include "api/design/read/supply/own_pumps.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/json.h"
#include "api/json/version.h"
#include "optimizer/evaluate/line.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::api {
namespace {

// A count that is a number in the contract: a decimal string only past 2⁵³.
Json Count(const optimizer::BigCount& count) {
  if (count <= std::uint64_t{1} << 53) return static_cast<std::int64_t>(count.ToDouble());
  return count.str();
}

Json RenderProof(const optimizer::Proof& proof, const model::Parts& parts) {
  Json json = {{"combinations", proof.combinations.str()},
               {"complete", proof.complete},
               {"lower_bound", Number(proof.lower_bound)},
               {"gap", Number(proof.gap)},
               {"evaluated", Count(proof.evaluated)},
               {"simulated", proof.simulated},
               {"undecided", proof.undecided},
               {"pruned",
                {{"incompatible", proof.pruned.incompatible.str()},
                 {"infeasible", proof.pruned.infeasible.str()},
                 {"bound", proof.pruned.bound.str()},
                 {"dominated", proof.pruned.dominated.str()},
                 {"unpriced", proof.pruned.unpriced.str()}}}};
  if (proof.record) json["record"] = RenderRecord(*proof.record, parts);
  return json;
}

// How many of the first designs keep their places, since nothing that is not listed beats them.
int ProvedOf(const optimizer::Answer& answer) {
  constexpr double kRounding = 1e-9;
  const double bound = answer.proof.lower_bound * (1.0 + kRounding);
  return static_cast<int>(
      std::count_if(answer.designs.begin(), answer.designs.end(),
                    [&](const optimizer::Design& design) { return design.objective <= bound; }));
}

Json RenderConflict(const std::vector<optimizer::Conflict>& conflict) {
  Json list = Json::array();
  for (const optimizer::Conflict& entry : conflict) {
    const bool reached = entry.best && entry.required && *entry.required != 0.0;
    list.push_back({{"requirement", entry.requirement},
                    {"required", OrNull(entry.required)},
                    {"best", OrNull(entry.best)},
                    {"best_interval", entry.best && entry.bound
                                          ? Json({Number(*entry.bound), Number(*entry.best)})
                                          : Json(nullptr)},
                    {"relaxation", reached ? Number(std::abs(*entry.best / *entry.required - 1.0))
                                           : Json(nullptr)},
                    {"proved", entry.proved}});
  }
  return list;
}

// Why there is no design, and what would give way.
void AddInfeasibility(const optimizer::Infeasibility& why, Json& document) {
  Json conflicts = Json::array(), relaxation = Json::array();
  for (const std::vector<optimizer::Conflict>& conflict : why.conflicts)
    conflicts.push_back(RenderConflict(conflict));
  for (const optimizer::Concession& concession : why.relaxation)
    relaxation.push_back({{"requirement", concession.requirement},
                          {"required", OrNull(concession.required)},
                          {"value", OrNull(concession.value)},
                          {"relative_change", Number(concession.change)}});
  document["conflict"] = conflicts.empty() ? Json::array() : conflicts.front();
  document["conflicts"] = std::move(conflicts);
  document["relaxation"] = std::move(relaxation);
  document["conflicts_complete"] = why.complete;
}

Json RenderBest(const optimizer::BestDesign& best, const optimizer::Answer& answer,
                const optimizer::Problem& problem, const Rows& rows) {
  Json row = {{"configuration", optimizer::Name(best.configuration)},
              {"status", optimizer::Name(best.status)},
              {"objective", nullptr},
              {"relative_distance", nullptr},
              {"lower_bound", Number(best.lower_bound)},
              {"design", nullptr},
              {"conflict", RenderConflict(best.conflict)}};
  if (!best.design) return row;
  const double first = answer.designs.front().objective;
  row["objective"] = Number(best.design->objective);
  if (first > 0.0) row["relative_distance"] = Number(best.design->objective / first - 1.0);
  row["design"] =
      RenderDesign(*best.design, best.rank, QualityOf(*best.design, problem, rows), problem, rows);
  if (best.rank == 0) row["design"]["rank"] = nullptr;
  return row;
}

void AddBests(const optimizer::Answer& answer, const optimizer::Problem& problem, const Rows& rows,
              Json& document) {
  for (const optimizer::BestDesign& best : answer.by_configuration)
    document["by_configuration"].push_back(RenderBest(best, answer, problem, rows));
  if (!answer.orderable) return;
  document["orderable"] = RenderBest(*answer.orderable, answer, problem, rows);
  if (!answer.orderable->design) document["orderable"]["configuration"] = nullptr;
}

// How many parts of each family have no price; families without such parts are left out.
Json RenderUnpriced(const model::Parts& parts) {
  Json counts = Json::object();
  for (const optimizer::FamilySpec& spec : optimizer::Families()) {
    int unpriced = 0;
    for (int part = 0; part < optimizer::FamilySize(parts, spec.family); ++part)
      unpriced += !optimizer::BasicsOf(parts, spec.family, part).cost_eur;
    if (unpriced > 0) counts[spec.name] = unpriced;
  }
  return counts;
}

// What of the catalogue the search could not choose, and why: ids that are excluded, else how many
// of each family.
Json RenderLeftOut(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                   bool priced) {
  std::map<std::string, std::map<std::string, int>> counts;
  Json excluded = Json::array();
  for (const optimizer::FamilySpec& spec : optimizer::Families())
    for (const catalog::Part& part : parts) {
      if (part.family != spec.name || optimizer::CatalogueFamily(spec.family) != spec.family ||
          !MayUse(problem, spec) || !SuitsFeed(problem, part))
        continue;
      const auto required = problem.require.find(spec.family);
      if (problem.exclude.contains(part.id))
        excluded.push_back(part.id);
      else if (required != problem.require.end() && !required->second.contains(part.id))
        ++counts["require"][part.family];
      else if (!SuitsOrder(problem, part))
        ++counts["orderable"][part.family];
      else if (optimizer::Evacuated(problem) && !StandsVacuum(part))
        ++counts["vacuum"][part.family];
      else if (!SuitsVacuumRail(problem, part))
        ++counts[StandsVacuum(part) ? "holding" : "vacuum"][part.family];
      else if (!HasItsPressure(problem, part))
        ++counts["supply_pressure"][part.family];
    }
  Json left_out = Json::object();
  if (!excluded.empty()) left_out["exclude"] = std::move(excluded);
  for (const auto& [why, families] : counts) left_out[why] = families;
  Json unpriced = priced ? RenderUnpriced(problem.parts) : Json::object();
  if (!unpriced.empty()) left_out["prices"] = std::move(unpriced);
  return left_out;
}

}  // namespace

Json RenderAnswer(const DesignRequest& request, const optimizer::Answer& answer,
                  const std::vector<catalog::Part>& parts) {
  const Rows rows = RowsOf(parts);
  Json designs = Json::array();
  Json best_on_measured_flow = nullptr;
  for (std::size_t i = 0; i < answer.designs.size(); ++i) {
    const int rank = static_cast<int>(i) + 1;
    const Quality quality = QualityOf(answer.designs[i], request.problem, rows);
    if (!quality.flow_estimated && best_on_measured_flow.is_null()) best_on_measured_flow = rank;
    designs.push_back(RenderDesign(answer.designs[i], rank, quality, request.problem, rows));
  }

  Json document = AnswerDocument("designs/1");
  if (!request.name.empty()) document["name"] = request.name;
  document["status"] = optimizer::Name(answer.status);
  document["list"] = optimizer::Name(request.problem.list);
  document["designs"] = std::move(designs);
  AddBests(answer, request.problem, rows, document);
  document["left_out"] =
      RenderLeftOut(parts, request.problem,
                    optimizer::PricesNeeded(request.problem) && !answer.lower_bound_prices);
  if (optimizer::CostCounts(request.problem)) {
    document["price_basis"] = answer.lower_bound_prices ? "lower_bound" : "known";
    document["unpriced"] = RenderUnpriced(request.problem.parts);
  }
  document["best_on_measured_flow"] = best_on_measured_flow;
  document["proof"] = RenderProof(answer.proof, request.problem.parts);
  if (request.pareto.empty()) document["proof"]["proved_designs"] = ProvedOf(answer);
  if (answer.status == optimizer::Status::kInfeasible)
    AddInfeasibility(answer.infeasibility, document);
  document["seconds"] = Number(answer.seconds);
  request.remarks.AddTo(document);
  document["requirements"] = request.request;
  return document;
}

Json RenderSearched(const optimizer::Problem& problem, const optimizer::Searched& searched,
                    const std::vector<catalog::Part>& parts) {
  const Rows rows = RowsOf(parts);
  Json designs = Json::array();
  for (std::size_t i = 0; i < searched.place.size(); ++i) {
    const int rank = static_cast<int>(i) + 1;
    if (searched.place[i] >= 0)
      designs.push_back({{"rank", rank}, {"listed", searched.place[i] + 1}});
    else
      designs.push_back(RenderClaim(searched.answer.designs[i], rank, problem, rows));
  }
  return {{"count", searched.count},
          {"status", optimizer::Name(searched.answer.status)},
          {"lower_bound", Number(searched.answer.proof.lower_bound)},
          {"gap", Number(searched.answer.proof.gap)},
          {"designs", std::move(designs)}};
}

}  // namespace plenum::api
