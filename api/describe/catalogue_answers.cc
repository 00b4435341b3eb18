#include "api/describe/catalogue_answers.h"

#include <string>
#include <utility>

#include "api/catalogue/part_query.h"
#include "api/catalogue/part_table.h"
#include "api/json/request_limits.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/part.h"

namespace plenum::api {
namespace {

Json Parameter(const std::string& name, Json schema, std::string_view description) {
  return {
      {"name", name}, {"in", "query"}, {"schema", std::move(schema)}, {"description", description}};
}

Json Object(const Json& properties) {
  Json required = Json::array();
  for (const auto& [name, schema] : properties.items()) required.push_back(name);
  return {{"type", "object"}, {"properties", properties}, {"required", required}};
}
Json ListOf(const Json& items) { return {{"type", "array"}, {"items", items}}; }
Json MapOf(const Json& values) { return {{"type", "object"}, {"additionalProperties", values}}; }

Json FacetsSchema() {
  const Json integer = {{"type", "integer"}}, number = {{"type", "number"}};
  const Json range = Object({{"count", integer}, {"min", number}, {"max", number}});
  Json spread = range;
  spread["properties"]["ranges"] = ListOf(range);
  return Object(
      {{"texts", MapOf(MapOf(integer))}, {"more", MapOf(integer)}, {"numbers", MapOf(spread)}});
}

Json CheckSchema() {
  const Json text = {{"type", "string"}}, number = {{"type", "number"}};
  const Json integer = {{"type", "integer"}}, ids = ListOf(text);
  return Object({{"parts", integer},
                 {"duplicates", ListOf(Object({{"family", text}, {"why", text}, {"ids", ids}}))},
                 {"outliers", ListOf(Object({{"id", text}, {"field", text}, {"value", number}}))},
                 {"gaps", ListOf(Object({{"family", text}, {"field", text}, {"missing", ids}}))},
                 {"families", ListOf(Object({{"family", text},
                                             {"parts", integer},
                                             {"without_price", ids},
                                             {"without_document", ids},
                                             {"values", integer},
                                             {"estimated", integer},
                                             {"estimated_share", number}}))},
                 {"catalogue_revision", Object({{"number", integer}, {"hash", text}})}});
}

}  // namespace

Json DescribeCatalogueAnswers() {
  const Json text = {{"type", "string"}}, integer = {{"type", "integer"}};
  const Json flag = {{"type", "boolean"}}, maybe_text = {{"type", {"string", "null"}}};
  const Json ids = ListOf(text);
  const Json parts = ListOf({{"$ref", "#/components/schemas/StoredPart"}});
  const Json revision = Object({{"number", integer}, {"hash", text}});
  Json page = Object({{"parts", parts},
                      {"next_cursor", maybe_text},
                      {"total", integer},
                      {"catalogue_revision", revision}});
  page["properties"]["facets"] = FacetsSchema();
  const Json field = Object({{"field", text},
                             {"differs", flag},
                             {"values", ListOf(Json::object())},
                             {"provenance", ListOf(maybe_text)}});
  return {{"PartsPage", std::move(page)},
          {"Comparison",
           Object({{"parts", parts}, {"fields", ListOf(field)}, {"catalogue_revision", revision}})},
          {"Import", Object({{"added", ids},
                             {"replaced", ids},
                             {"unchanged", ids},
                             {"dry_run", flag},
                             {"understood", Json::object()}})},
          {"CatalogCheck", CheckSchema()}};
}

Json DescribePartFilters() {
  Json filters = Json::array();
  Json seen = Json::object();  // fields by name; several families share some
  const auto is_new = [&](std::string_view name) {
    return std::exchange(seen[std::string(name)], true).is_null();
  };
  Json families = Json::array();
  for (const catalog::Family& family : catalog::Families()) families.push_back(family.name);
  filters.push_back(Parameter("q", {{"type", "string"}, {"maxLength", kSearchBytesMax}},
                              "words in any text of a part, in any order"));
  filters.push_back(Parameter("family", {{"enum", families}}, "only parts of this family"));
  for (const char* name : {"manufacturer", "part_number", "origin", "series"})
    filters.push_back(Parameter(name, {{"type", "string"}}, "exactly this"));
  const Json flag = {{"enum", {"true", "false"}}};
  filters.push_back(
      Parameter("orderable", flag, "known to be a product that one can order, or known not to be"));
  filters.push_back(Parameter("priced", flag, "with a price"));
  filters.push_back(Parameter("documented", flag, "with a document"));
  for (const std::string_view share : ProvenanceShares()) {
    const Json number = {{"type", "number"}, {"minimum", 0}, {"maximum", 1}};
    const std::string name(share);
    filters.push_back(
        Parameter(name + "_min", number, "of the part's numbers and texts, at least"));
    filters.push_back(Parameter(name + "_max", number, "of the part's numbers and texts, at most"));
  }
  for (const catalog::Family& family : catalog::Families()) {
    for (const catalog::NumberField& field : family.numbers) {
      if (!is_new(field.name)) continue;
      const std::string name(field.name);
      const Json number = {{"type", "number"}};
      filters.push_back(Parameter(name, number, field.meaning));
      filters.push_back(Parameter(name + "_min", number, "at least"));
      filters.push_back(Parameter(name + "_max", number, "at most"));
    }
    for (const catalog::TextField& field : family.texts)
      if (is_new(field.name))
        filters.push_back(Parameter(std::string(field.name), {{"type", "string"}}, field.meaning));
  }
  filters.push_back(
      Parameter("sort", {{"type", "string"}}, "a field, id or match; - before it turns it round"));
  filters.push_back(
      Parameter("facets", {{"type", "boolean"}}, "counts and ranges of what matches"));
  filters.push_back(Parameter("limit", {{"type", "integer"}, {"minimum", 1}, {"maximum", kPageMax}},
                              "parts of a page"));
  filters.push_back(Parameter("cursor", {{"type", "string"}}, "next_cursor of the page before"));
  filters.push_back(Parameter("revision", {{"type", "integer"}, {"minimum", 0}},
                              "parts as they were in this revision"));
  return filters;
}

}  // namespace plenum::api
