#include "api/design/design_document.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "api/catalogue/catalogue_parts.h"
#include "api/design/read/selection.h"
#include "api/design/read/stock_volume.h"
#include "api/design/read/supply/outside.h"
#include "api/design/read/supply/power.h"
#include "api/design/read/supply/vacuum_rail.h"
#include "api/json/units.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/gait.h"
#include "optimizer/sizing/report.h"

namespace plenum::api {
namespace {

// A requirement that is met by less than this is called binding.
constexpr double kBinding = 0.01;

Json Numbers(const std::vector<double>& values, auto&& convert) {
  Json list = Json::array();
  for (const double value : values) list.push_back(Number(convert(value)));
  return list;
}

Json RenderChoice(const optimizer::Choice& choice, const optimizer::Problem& problem,
                  const Rows& rows) {
  const auto found = rows.find(choice.id);
  const bool known = found != rows.end();
  const bool is_tube = choice.family == optimizer::Family::kTubing;
  Json row = {{"family", optimizer::Name(choice.family)},
              {"id", choice.id},
              {"manufacturer", known ? found->second->manufacturer : "made to measure"},
              {"part_number", known ? found->second->part_number : choice.id},
              {"group", choice.group < 0 ? Json(nullptr) : Json(problem.groups[choice.group].name)},
              {"quantity", Number(choice.quantity)},
              {"unit", is_tube ? "m" : "piece"},
              {"mass_kg", Number(choice.mass_kg)},
              {"volume_l", Number(LFromM3(choice.volume_m3))},
              {"cost_eur", OrNull(choice.cost_eur)}};
  if (problem.own.contains(choice.id)) row["own"] = true;
  return row;
}

// What is bought in packs, and what of it is left over.
Json RenderPacks(const std::vector<optimizer::PackRow>& packs) {
  Json list = Json::array();
  for (const optimizer::PackRow& row : packs)
    list.push_back({{"family", optimizer::Name(row.family)},
                    {"id", row.id},
                    {"unit", row.family == optimizer::Family::kTubing ? "m" : "piece"},
                    {"quantity", Number(row.quantity)},
                    {"pack", Number(row.pack)},
                    {"packs", Number(row.packs)},
                    {"left_over", Number(row.packs * row.pack - row.quantity)},
                    {"cost_eur", Number(row.cost_eur)}});
  return list;
}

Json RenderSettings(const optimizer::Settings& settings, const optimizer::Problem& problem) {
  const auto& duty = settings.valve_duty;
  const Json source = Number(optimizer::KpaGauge(problem, settings.source_pressure_pa));
  Json rendered = {
      {"source_pressure_kpa_gauge", source},
      {"valve_duty",
       duty.empty() ? Json(nullptr) : Number(*std::max_element(duty.begin(), duty.end()))},
      {"valve_duty_groups", Numbers(duty, [](double share) { return share; })},
      {"compressor_duty", OrNull(settings.compressor_duty)},
      {"reservoir_volume_ml", settings.reservoir_volume_m3
                                  ? Number(MlFromM3(*settings.reservoir_volume_m3))
                                  : Json(nullptr)},
      {"tank_fill_kpa_gauge", settings.tank_fill_pa
                                  ? Number(optimizer::KpaGauge(problem, *settings.tank_fill_pa))
                                  : Json(nullptr)}};
  if (settings.pump_stop_pa)
    rendered["pump_stop_kpa_gauge"] = Number(optimizer::KpaGauge(problem, *settings.pump_stop_pa));
  if (optimizer::Evacuated(problem)) rendered["vacuum_kpa_gauge"] = source;
  if (settings.rail) {
    const optimizer::RailSettings& rail = *settings.rail;
    rendered["vacuum_kpa_gauge"] = Number(optimizer::KpaGauge(problem, rail.pressure_pa));
    rendered["vacuum_stop_kpa_gauge"] = Number(optimizer::KpaGauge(problem, rail.stop_pa));
    rendered["vacuum_duty"] = Number(rail.duty);
    rendered["vacuum_reservoir_volume_ml"] = Number(MlFromM3(rail.volume_m3));
  } else if (HasVacuumRail(problem)) {
    rendered["vacuum_kpa_gauge"] = Number(VacuumRailKpa(problem));
  }
  if (!settings.group_pressure_pa.empty())
    rendered["group_pressure_kpa_gauge"] = Numbers(
        settings.group_pressure_pa, [&](double pa) { return optimizer::KpaGauge(problem, pa); });
  return rendered;
}

Json RenderTotals(const optimizer::Totals& totals) {
  return {{"mass_kg", Number(totals.mass_kg)},
          {"volume_l", Number(LFromM3(totals.volume_m3))},
          {"cost_eur", OrNull(totals.cost_eur)},
          {"cost_eur_min", Number(totals.cost_known_eur)},
          {"energy_wh", Number(WhFromJ(totals.energy_j))}};
}

Json RenderPerformance(const optimizer::Performance& performance,
                       const optimizer::Problem& problem) {
  Json groups = Json::array();
  for (std::size_t i = 0; i < performance.groups.size(); ++i) {
    const optimizer::GroupPerformance& group = performance.groups[i];
    groups.push_back(
        {{"name", problem.groups[i].name},
         {"rise_time_s", Number(group.rise_time_s)},
         {"fall_time_s", Number(group.fall_time_s)},
         {"inflate_time_s", Number(group.inflate_time_s)},
         {"frequency_hz_max", Number(group.frequency_max_hz)},
         {"peak_kpa_gauge", Number(optimizer::KpaGauge(problem, group.highest_pressure_pa))}});
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

// What is assumed of a part under vacuum that its row does not say (StandsVacuum).
void AddAssumedOfVacuum(const catalog::Part& row, Quality& quality) {
  if (row.family == "valve" && !row.texts.contains("vacuum_rated"))
    quality.estimated.insert("valve.vacuum_rated");
  if (row.family == "vacuum_pump" && !row.numbers.contains("duty_max"))
    quality.estimated.insert("vacuum_pump.duty_max");
  if (row.family == "ejector") quality.estimated.insert("ejector.suction_curve");
}

Json RenderQuality(const Quality& quality, double mass_kg) {
  const double share = mass_kg > 0.0 ? std::min(1.0, quality.mass_estimated_kg / mass_kg) : 0.0;
  return {{"mass_share_estimated", Number(share)},
          {"estimated", quality.estimated},
          {"flow_estimated", quality.flow_estimated},
          {"not_orderable", quality.not_orderable}};
}

Json RenderResponse(const optimizer::Design::Trace& trace, const optimizer::Problem& problem) {
  const auto gauge = [&](double pa) { return optimizer::KpaGauge(problem, pa); };
  Json groups = Json::array();
  const std::vector<optimizer::Squad> squads = optimizer::SquadsOf(problem);
  for (std::size_t i = 0; i < trace.pressure_pa.size(); ++i) {
    const auto& [g, count, phase] = squads[i];
    Json group = {{"name", problem.groups[g].name},
                  {"pressure_kpa_gauge", Numbers(trace.pressure_pa[i], gauge)}};
    if (count < problem.groups[g].count) {
      group["count"] = count;
      group["phase"] = Number(phase);
    }
    groups.push_back(std::move(group));
  }
  return {{"t_s", Numbers(trace.t_s, [](double t) { return t; })},
          {"groups", groups},
          {"source_pressure_kpa_gauge", Numbers(trace.source_pressure_pa, gauge)}};
}

// The kind by names: of each part its series, or its id where it has none.
Json RenderKind(const optimizer::Design& design, const optimizer::Problem& problem) {
  std::map<optimizer::KindRole, std::set<std::string>> names;
  for (const optimizer::Choice& choice : design.parts) {
    const int part = optimizer::FindPart(problem.parts, choice.family, choice.id);
    if (part < 0 || IsOutside(choice, problem)) continue;
    const model::PartBasics& basics = optimizer::BasicsOf(problem.parts, choice.family, part);
    names[optimizer::SpecOf(choice.family).kind_role].insert(basics.series.empty() ? basics.id
                                                                                   : basics.series);
  }
  return {{"configuration", optimizer::Name(design.configuration)},
          {"sources", names[optimizer::KindRole::kSource]},
          {"regulators", names[optimizer::KindRole::kRegulator]},
          {"valves", names[optimizer::KindRole::kValve]}};
}

// The rows in which a variant is not as the best of its kind.
Json RenderVariant(const optimizer::Variant& variant, const optimizer::Design& best,
                   const optimizer::Problem& problem, const Rows& rows,
                   std::set<std::string>& differ_in) {
  Json parts = Json::array();
  for (const optimizer::Choice& choice : variant.parts) {
    const bool same = std::any_of(
        best.parts.begin(), best.parts.end(),
        [&](const optimizer::Choice& other) { return optimizer::SameRow(other, choice); });
    if (same || IsOutside(choice, problem)) continue;
    differ_in.insert(optimizer::Name(choice.family));
    parts.push_back(RenderChoice(choice, problem, rows));
  }
  return {{"objective", Number(variant.objective)}, {"parts", std::move(parts)}};
}

Json RenderVariants(const optimizer::Design& design, const optimizer::Problem& problem,
                    const Rows& rows) {
  Json examples = Json::array();
  std::set<std::string> differ_in;
  for (const optimizer::Variant& variant : design.variants->found)
    examples.push_back(RenderVariant(variant, design, problem, rows, differ_in));
  return {{"found", design.variants->found.size()},
          {"complete", design.variants->complete},
          {"differ_in", differ_in},
          {"examples", std::move(examples)}};
}

}  // namespace

Rows RowsOf(const std::vector<catalog::Part>& parts) {
  Rows rows;
  for (const catalog::Part& part : parts) rows[part.id] = &part;
  return rows;
}

Quality QualityOf(const optimizer::Design& design, const optimizer::Problem& problem,
                  const Rows& rows) {
  const bool kept_by_pumps = problem.pump_feed == optimizer::PumpFeed::kPerActuator;
  Quality quality;
  for (const optimizer::Choice& choice : design.parts) {
    if (IsMadeToMeasure(choice)) {
      quality.mass_estimated_kg += choice.mass_kg;
      quality.estimated.insert({"reservoir.body_volume_ml", "reservoir.mass_kg"});
    } else if (const auto row = rows.find(choice.id); row != rows.end()) {
      AddEstimates(*row->second, choice.quantity, quality);
      if (optimizer::Evacuated(problem) || HasVacuumRail(problem))
        AddAssumedOfVacuum(*row->second, quality);
      if (choice.family == optimizer::PumpFamily(design.configuration) && kept_by_pumps &&
          !row->second->texts.contains("check_valve"))
        quality.estimated.insert(row->second->family + ".check_valve");
      if (choice.family == optimizer::Family::kValve &&
          !row->second->numbers.contains("response_time_ms"))
        quality.estimated.insert("valve.response_time_ms");
      if (!row->second->orderable.value_or(true)) quality.not_orderable.insert(choice.id);
    }
  }
  return quality;
}

// What the ejectors of a design take all the while, L/min ANR; null without any.
Json RenderCompressedAir(const optimizer::Design& design, const optimizer::Problem& problem) {
  for (const optimizer::Choice& row : design.parts) {
    if (row.family != optimizer::Family::kEjector) continue;
    const int part = optimizer::FindPart(problem.parts, row.family, row.id);
    if (part >= 0)
      return Number(
          LPerMinFromM3PerS(row.quantity * problem.parts.ejectors[part].air_consumption_m3_per_s));
  }
  return nullptr;
}

Json RenderFigures(const optimizer::Design& design, const optimizer::Problem& problem) {
  Json settings = RenderSettings(design.settings, problem);
  settings["power"] = RenderPower(design, problem);
  Json performance = RenderPerformance(design.performance, problem);
  performance["compressed_air_l_per_min_anr"] = RenderCompressedAir(design, problem);
  return {{"settings", std::move(settings)},
          {"totals", RenderTotals(design.totals)},
          {"performance", std::move(performance)},
          {"margins", RenderMargins(design.margins)}};
}

Json RenderClaim(const optimizer::Design& design, int rank, const optimizer::Problem& problem,
                 const Rows& rows) {
  Json parts = Json::array();
  for (const optimizer::Choice& choice : design.parts)
    if (!IsOutside(choice, problem)) parts.push_back(RenderChoice(choice, problem, rows));
  Json json = {{"rank", rank},
               {"configuration", optimizer::Name(design.configuration)},
               {"objective", Number(design.objective)},
               {"parts", parts},
               {"packs", RenderPacks(design.packs)}};
  json.update(RenderFigures(design, problem));
  return json;
}

Json RenderDesign(const optimizer::Design& design, int rank, const Quality& quality,
                  const optimizer::Problem& problem, const Rows& rows) {
  Json json = RenderClaim(design, rank, problem, rows);
  json["data_quality"] = RenderQuality(quality, design.totals.mass_kg);
  json["response"] = RenderResponse(design.response, problem);
  if (problem.list == optimizer::ListOf::kKinds) json["kind"] = RenderKind(design, problem);
  if (design.variants) json["variants"] = RenderVariants(design, problem, rows);
  return json;
}

}  // namespace plenum::api
