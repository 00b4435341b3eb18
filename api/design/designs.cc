#include "api/design/designs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/proof_record.h"
#include "api/design/read/requirements_reader.h"
#include "api/design/read/selection.h"
#include "api/json/json.h"
#include "api/json/units.h"
#include "api/json/version.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {
namespace {

// A requirement that is met by less than this is called binding.
constexpr double kBinding = 0.01;

using Rows = std::map<std::string, const catalog::Part*>;

Rows RowsOf(const std::vector<catalog::Part>& parts) {
  Rows rows;
  for (const catalog::Part& part : parts) rows[part.id] = &part;
  return rows;
}

Json Numbers(const std::vector<double>& values, auto&& convert) {
  Json list = Json::array();
  for (const double value : values) list.push_back(Number(convert(value)));
  return list;
}

Json OrNull(const std::optional<double>& value) { return value ? Number(*value) : Json(nullptr); }

bool IsCustom(const optimizer::Choice& choice) {
  return choice.id == kCustomReservoir && optimizer::SpecOf(choice.family).made_to_measure;
}

Json RenderChoice(const optimizer::Choice& choice, const optimizer::Problem& problem,
                  const Rows& rows) {
  const auto found = rows.find(choice.id);
  const bool known = found != rows.end();
  const bool is_tube = choice.family == optimizer::Family::kTubing;
  return {{"family", optimizer::Name(choice.family)},
          {"id", choice.id},
          {"manufacturer", known ? found->second->manufacturer : "made to measure"},
          {"part_number", known ? found->second->part_number : choice.id},
          {"group", choice.group < 0 ? Json(nullptr) : Json(problem.groups[choice.group].name)},
          {"quantity", Number(choice.quantity)},
          {"unit", is_tube ? "m" : "piece"},
          {"mass_kg", Number(choice.mass_kg)},
          {"volume_l", Number(LFromM3(choice.volume_m3))},
          {"cost_eur", OrNull(choice.cost_eur)}};
}

Json RenderSettings(const optimizer::Settings& settings, const model::Ambient& ambient) {
  const auto& duty = settings.valve_duty;
  Json source = Number(KpaGaugeFromPa(settings.source_pressure_pa, ambient));
  return {{"source_pressure_kpa_gauge", source},
          {"valve_duty",
           duty.empty() ? Json(nullptr) : Number(*std::max_element(duty.begin(), duty.end()))},
          {"valve_duty_groups", Numbers(duty, [](double share) { return share; })},
          {"compressor_duty", OrNull(settings.compressor_duty)},
          {"reservoir_volume_ml", settings.reservoir_volume_m3
                                      ? Number(MlFromM3(*settings.reservoir_volume_m3))
                                      : Json(nullptr)}};
}

Json RenderTotals(const optimizer::Totals& totals) {
  return {{"mass_kg", Number(totals.mass_kg)},
          {"volume_l", Number(LFromM3(totals.volume_m3))},
          {"cost_eur", OrNull(totals.cost_eur)},
          {"energy_wh", Number(WhFromJ(totals.energy_j))}};
}

Json RenderPerformance(const optimizer::Performance& performance,
                       const optimizer::Problem& problem) {
  Json groups = Json::array();
  for (std::size_t i = 0; i < performance.groups.size(); ++i) {
    const optimizer::GroupPerformance& group = performance.groups[i];
    groups.push_back({{"name", problem.groups[i].name},
                      {"rise_time_s", Number(group.rise_time_s)},
                      {"fall_time_s", Number(group.fall_time_s)},
                      {"inflate_time_s", Number(group.inflate_time_s)},
                      {"frequency_hz_max", Number(group.frequency_max_hz)}});
  }
  return {{"groups", groups},
          {"frequency_hz_sustained", Number(performance.frequency_sustained_hz)},
          {"air_per_actuation_l_anr", Number(LFromM3(performance.air_per_actuation_m3))},
          {"air_total_l_anr", Number(LFromM3(performance.air_total_m3))},
          {"run_time_s", Number(performance.run_time_s)}};
}

Json RenderMargins(const std::vector<optimizer::Margin>& margins) {
  Json list = Json::array();
  for (const optimizer::Margin& margin : margins)
    list.push_back({{"requirement", margin.requirement},
                    {"required", Number(margin.required)},
                    {"achieved", Number(margin.achieved)},
                    {"relative_margin", Number(margin.relative_margin)},
                    {"binding", margin.relative_margin < kBinding}});
  return list;
}

// What of a design rests on estimates.
struct Quality {
  double mass_estimated_kg = 0.0;
  std::set<std::string> estimated;  // "family.field"
  bool flow_estimated = false;
  std::set<std::string> not_orderable;  // ids of classes of parts and the like
};

void AddEstimates(const catalog::Part& row, double quantity, Quality& quality) {
  const auto add = [&](const std::string& field) {
    if (!UseInSearch(row.family, field)) return;
    quality.estimated.insert(row.family + "." + field);
    quality.flow_estimated |= IsFlowData(row.family, field);
  };
  for (const auto& [field, number] : row.numbers) {
    if (number.provenance != catalog::Provenance::kEstimated) continue;
    add(field);
    // Of the part alone: a gas charge in its row is computed, not estimated.
    if (field == "mass_kg" || field == "mass_kg_per_m")
      quality.mass_estimated_kg += quantity * number.value;
  }
  if (!row.curve) return;
  if (row.curve->free_air_provenance == catalog::Provenance::kEstimated) add("free_air");
  if (row.curve->current_provenance == catalog::Provenance::kEstimated) add("current");
}

Quality QualityOf(const optimizer::Design& design, const Rows& rows) {
  Quality quality;
  for (const optimizer::Choice& choice : design.parts) {
    if (IsCustom(choice)) {
      quality.mass_estimated_kg += choice.mass_kg;
      quality.estimated.insert({"reservoir.body_volume_ml", "reservoir.mass_kg"});
    } else if (const auto row = rows.find(choice.id); row != rows.end()) {
      AddEstimates(*row->second, choice.quantity, quality);
      if (!row->second->orderable.value_or(true)) quality.not_orderable.insert(choice.id);
    }
  }
  return quality;
}

Json RenderQuality(const Quality& quality, double mass_kg) {
  const double share = mass_kg > 0.0 ? std::min(1.0, quality.mass_estimated_kg / mass_kg) : 0.0;
  return {{"mass_share_estimated", Number(share)},
          {"estimated", quality.estimated},
          {"flow_estimated", quality.flow_estimated},
          {"not_orderable", quality.not_orderable}};
}

Json RenderResponse(const optimizer::Design::Trace& trace, const optimizer::Problem& problem) {
  const auto gauge = [&](double pa) { return KpaGaugeFromPa(pa, problem.ambient); };
  Json groups = Json::array();
  for (std::size_t i = 0; i < trace.pressure_pa.size(); ++i)
    groups.push_back({{"name", problem.groups[i].name},
                      {"pressure_kpa_gauge", Numbers(trace.pressure_pa[i], gauge)}});
  return {{"t_s", Numbers(trace.t_s, [](double t) { return t; })},
          {"groups", groups},
          {"source_pressure_kpa_gauge", Numbers(trace.source_pressure_pa, gauge)}};
}

// What `verify` reads of a design.
Json RenderClaim(const optimizer::Design& design, int rank, const optimizer::Problem& problem,
                 const Rows& rows) {
  Json parts = Json::array();
  for (const optimizer::Choice& choice : design.parts)
    parts.push_back(RenderChoice(choice, problem, rows));
  Json json = {{"rank", rank},
               {"configuration", optimizer::Name(design.configuration)},
               {"objective", Number(design.objective)},
               {"parts", parts}};
  json.update(RenderFigures(design, problem));
  return json;
}

Json RenderDesign(const optimizer::Design& design, int rank, const Quality& quality,
                  const optimizer::Problem& problem, const Rows& rows) {
  Json json = RenderClaim(design, rank, problem, rows);
  json["data_quality"] = RenderQuality(quality, design.totals.mass_kg);
  json["response"] = RenderResponse(design.response, problem);
  return json;
}

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

}  // namespace

Json RenderFigures(const optimizer::Design& design, const optimizer::Problem& problem) {
  return {{"settings", RenderSettings(design.settings, problem.ambient)},
          {"totals", RenderTotals(design.totals)},
          {"performance", RenderPerformance(design.performance, problem)},
          {"margins", RenderMargins(design.margins)}};
}

Json RenderAnswer(const DesignRequest& request, const optimizer::Answer& answer,
                  const std::vector<catalog::Part>& parts) {
  const Rows rows = RowsOf(parts);
  Json designs = Json::array();
  Json best_on_measured_flow = nullptr;
  for (std::size_t i = 0; i < answer.designs.size(); ++i) {
    const int rank = static_cast<int>(i) + 1;
    const Quality quality = QualityOf(answer.designs[i], rows);
    if (!quality.flow_estimated && best_on_measured_flow.is_null()) best_on_measured_flow = rank;
    designs.push_back(RenderDesign(answer.designs[i], rank, quality, request.problem, rows));
  }

  Json document = AnswerDocument("designs/1");
  if (!request.name.empty()) document["name"] = request.name;
  document["status"] = optimizer::Name(answer.status);
  document["designs"] = std::move(designs);
  document["best_on_measured_flow"] = best_on_measured_flow;
  document["proof"] = RenderProof(answer.proof, request.problem.parts);
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
