#include "api/catalogue/families.h"

#include "api/catalogue/catalogue_parts.h"
#include "api/json/json.h"
#include "catalog/fields/fields.h"

namespace plenum::api {
namespace {

Json SearchUse(const catalog::Family& family, std::string_view field) {
  const auto use = UseInSearch(family.name, field);
  return use ? Json(*use) : Json(nullptr);
}

}  // namespace

Json RenderFamilies() {
  Json families = Json::array();
  for (const catalog::Family& family : catalog::Families()) {
    Json numbers = Json::array(), texts = Json::array();
    for (const catalog::NumberField& field : family.numbers)
      numbers.push_back({{"name", field.name},
                         {"min", field.min},
                         {"max", field.max},
                         {"required", field.required},
                         {"meaning", field.meaning},
                         {"search", SearchUse(family, field.name)}});
    for (const catalog::TextField& field : family.texts)
      texts.push_back({{"name", field.name},
                       {"allowed", field.allowed},
                       {"required", field.required},
                       {"meaning", field.meaning},
                       {"search", SearchUse(family, field.name)}});
    families.push_back({{"name", family.name},
                        {"numbers", std::move(numbers)},
                        {"texts", std::move(texts)},
                        {"has_curve", family.has_curve()}});
  }
  return {{"families", std::move(families)}};
}

}  // namespace plenum::api
