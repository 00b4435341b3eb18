#include "api/catalogue/part_comparison.h"

#include <algorithm>
#include <set>
#include <utility>

#include "api/catalogue/part_document.h"
#include "api/json/words.h"
#include "catalog/fields/fields.h"
#include "catalog/units/text.h"

namespace plenum::api {
namespace {

// Of the families of the parts, each once.
std::vector<std::string> FieldsOf(const std::vector<catalog::Part>& parts) {
  std::vector<std::string> fields = {"family", "manufacturer", "part_number", "series",
                                     "orderable"};
  std::set<std::string> known(fields.begin(), fields.end());
  const auto add = [&](std::string_view name) {
    if (known.emplace(name).second) fields.emplace_back(name);
  };
  for (const catalog::Family& family : catalog::Families()) {
    if (std::none_of(parts.begin(), parts.end(),
                     [&](const catalog::Part& part) { return part.family == family.name; }))
      continue;
    for (const catalog::TextField& field : family.texts) add(field.name);
    for (const catalog::NumberField& field : family.numbers) add(field.name);
  }
  add("curve");
  return fields;
}

// Null where the part has no such value.
Json ValueOf(const Json& document, const std::string& field) {
  const auto found = document.find(field);
  return found == document.end() || *found == Json("") ? Json() : *found;
}

// Of a curve, that of its flow.
Json ProvenanceOf(const Json& document, const std::string& field) {
  const Json& all = document.at("provenance");
  const auto found = all.find(field == "curve" ? "free_air" : field);
  return found == all.end() ? Json() : found->at("kind");
}

}  // namespace

std::vector<std::string> SplitIds(std::string_view listed) {
  std::vector<std::string> ids;
  if (listed.empty()) return ids;
  for (const std::string_view id : catalog::Split(listed, ',')) ids.emplace_back(id);
  return ids;
}

Errors CheckCompared(const std::vector<std::string>& ids) {
  if (ids.size() < kComparedMin || ids.size() > kComparedMax)
    return {{"/ids", "must name " + std::to_string(kComparedMin) + " to " +
                         std::to_string(kComparedMax) + " parts, not " +
                         std::to_string(ids.size())}};
  for (auto id = ids.begin(); id != ids.end(); ++id)
    if (std::find(ids.begin(), id, *id) != id)
      return {{"/ids", "names " + Quoted(*id) + " more than once"}};
  return {};
}

Json RenderComparison(const std::vector<catalog::Part>& parts) {
  Json documents = Json::array(), fields = Json::array();
  for (const catalog::Part& part : parts) documents.push_back(RenderPart(part));
  for (const std::string& field : FieldsOf(parts)) {
    Json values = Json::array(), provenance = Json::array();
    for (const Json& document : documents) {
      values.push_back(ValueOf(document, field));
      provenance.push_back(ProvenanceOf(document, field));
    }
    const auto equal = [&](const Json& value) { return value == values.front(); };
    const bool all_equal = std::all_of(values.begin(), values.end(), equal);
    if (all_equal && values.front().is_null()) continue;
    fields.push_back({{"field", field},
                      {"differs", !all_equal},
                      {"values", std::move(values)},
                      {"provenance", std::move(provenance)}});
  }
  return {{"parts", std::move(documents)}, {"fields", std::move(fields)}};
}

}  // namespace plenum::api
