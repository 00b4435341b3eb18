#include "api/describe/part_forms.h"

#include <string>
#include <utility>
#include <vector>

#include "api/catalogue/part_details.h"
#include "api/json/reader.h"
#include "api/json/request_limits.h"
#include "api/json/schema_recorder.h"
#include "api/json/shared_fields.h"
#include "catalog/fields/laws/printed_part.h"
#include "catalog/units/printed_flow.h"

namespace plenum::api {
namespace {

Json Text(std::size_t most) { return {{"type", "string"}, {"maxLength", most}}; }

Json ProvenanceForm(bool of_number) {
  Json properties = {{"kind", {{"enum", catalog::ProvenanceNames()}}},
                     {"source", {{"type", "string"}}}};
  if (of_number)
    properties["uncertainty"] = {{"type", {"number", "null"}},
                                 {"minimum", 1e-6},
                                 {"maximum", 1},
                                 {"description", "relative, one standard deviation"}};
  return {{"type", {"object", "null"}},
          {"properties", std::move(properties)},
          {"additionalProperties", false}};
}

Json CurveForm(catalog::CurveKind kind) {
  const auto [lowest, highest] = catalog::CurvePressuresKpaGauge(kind);
  const Json point = {
      {"type", "object"},
      {"properties",
       {{"pressure_kpa_gauge", NumberOrQuantityForm("pressure_kpa_gauge", {lowest, highest})},
        {"free_air_l_per_min", NumberOrQuantityForm("free_air_l_per_min", {0, 1e6})},
        {"current_a", NumberOrQuantityForm("current_a", {0, 1e4})}}},
      {"required", {"pressure_kpa_gauge", "free_air_l_per_min", "current_a"}},
      {"additionalProperties", false}};
  return {{"type", "array"}, {"minItems", 1}, {"maxItems", kTablePointsMax}, {"items", point}};
}

// The ways to give a conductance as it is printed.
Json PrintedForms() {
  Json forms = Json::array();
  for (const catalog::FlowNotationSpec& spec : catalog::FlowNotations()) {
    Json properties = {
        {std::string(spec.field), NumberOrQuantityForm(spec.field, {spec.min, spec.max})}};
    if (spec.notation == catalog::FlowNotation::kQn)
      properties["at"] = {{"type", "string"}, {"examples", Json::array({"6 to 5 bar"})}};
    forms.push_back({{"type", "object"},
                     {"properties", std::move(properties)},
                     {"required", Json::array({spec.field})},
                     {"additionalProperties", false}});
  }
  return forms;
}

// An object of lengths and the like, some of which may be missing.
Json PrintedForm(const std::vector<std::string>& required, const std::vector<std::string>& optional,
                 const Range& range) {
  Json properties = Json::object();
  for (const auto& names : {required, optional})
    for (const std::string& name : names) properties[name] = NumberOrQuantityForm(name, range);
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", required},
          {"additionalProperties", false}};
}

Json FormOf(const catalog::NumberField& field) {
  Json form = NumberOrQuantityForm(field.name, {field.min, field.max});
  const Range side{catalog::kBodySideMinMm, catalog::kBodySideMaxMm};
  if (field.name == "body_volume_ml") {
    form["anyOf"].push_back(PrintedForm({"length_mm", "width_mm", "height_mm"}, {}, side));
    form["anyOf"].push_back(PrintedForm({"diameter_mm", "length_mm"}, {}, side));
  }
  if (field.name == "current_max_a")
    form["anyOf"].push_back(PrintedForm({"c_rate"}, {}, {1e-3, 1e3}));
  if (field.name == "capacity_ah")
    form["anyOf"].push_back(PrintedForm({"energy_wh"}, {}, {1e-3, 1e6}));
  if (catalog::IsConductance(field.name))
    for (const Json& printed : PrintedForms()) form["anyOf"].push_back(printed);
  return form;
}

}  // namespace

Json PartForm(const catalog::Family& family) {
  Json properties = {{"family", {{"const", family.name}}},
                     {"id", Text(100)},
                     {"manufacturer", Text(kTextCharactersMax)},
                     {"part_number", Text(kTextCharactersMax)},
                     {"origin", {{"description", "set by the service"}}},
                     {"notes", {{"type", {"string", "null"}}, {"maxLength", 4000}}}};
  properties.update(DetailForms());
  Json required = {"family", "manufacturer", "part_number"};
  Json provenance = Json::object();
  const auto add = [&](std::string_view name, Json form, bool is_required, bool is_number,
                       std::string_view meaning) {
    const std::string field(name);
    form["description"] = meaning;
    if (is_required) required.push_back(field);
    if (!is_required) form = {{"anyOf", {form, {{"type", "null"}}}}};
    properties[field] = std::move(form);
    provenance[field] = ProvenanceForm(is_number);
  };
  for (const catalog::NumberField& field : family.numbers)
    add(field.name, FormOf(field), field.required, true, field.meaning);
  for (const catalog::TextField& field : family.texts) {
    Json form = Text(kTextCharactersMax);
    if (!field.allowed.empty()) form["enum"] = field.allowed;
    add(field.name, std::move(form), field.required, false, field.meaning);
  }
  if (family.has_curve()) {
    // Points, free flow and current, or these as a text: "free flow 12 L/min, 0.8 A".
    properties["curve"] = {
        {"anyOf",
         {CurveForm(family.curve), PrintedForm({"free_flow_l_per_min"}, {"current_a"}, {1e-6, 1e6}),
          Text(kTextCharactersMax)}}};
    required.push_back("curve");
    for (const char* name : {"free_air", "current"}) provenance[name] = ProvenanceForm(true);
  }
  properties["provenance"] = {{"type", {"object", "null"}},
                              {"properties", std::move(provenance)},
                              {"additionalProperties", false}};
  return {{"title", family.name},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

}  // namespace plenum::api
