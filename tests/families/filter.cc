#include "tests/families/filter.h"

#include "api/catalogue/catalogue_parts.h"
#include "api/json/units.h"
#include "catalog/fields/fields.h"
#include "optimizer/choices/plant/corner_table.h"
#include "optimizer/problem/family_specs.h"

namespace plenum::test {
namespace {

using optimizer::PartField;
using optimizer::Use;

// ── the table of fields ──
catalog::Family CatalogueTable() {
  return {"filter",
          {{"sonic_conductance_dm3_per_s_bar", 1e-6, 1e4, true, "sonic conductance C, shared"},
           {"critical_ratio", 0, 0.95, true, "critical pressure ratio b"},
           {"mass_kg", 1e-6, 500, true, "mass of one piece, empty"},
           {"body_volume_ml", 1e-4, 1e6, true, "outer envelope of one piece"},
           {"price_eur", 0, 1e6, false, "price of one piece"},
           {"pressure_max_kpa_gauge", 1, 5e4, true, "highest working pressure"}},
          {{"thread", true, {}, "thread of its ports"}, {"material", false, {}, "material"}}};
}

template <auto member>
optimizer::FieldValue Of(const model::Parts&, int part) {
  return Filters()[part].*member;
}

constexpr PartField kFields[] = {
    {.name = "thread", .use = Use::kMate, .of = &Of<&Filter::thread>},
    {.name = "sonic_conductance_dm3_per_s_bar",
     .use = Use::kSharedFlow,
     .of = &Of<&Filter::flow>,
     .weight = 1.0},
    {.name = "pressure_max_kpa_gauge",
     .use = Use::kRating,
     .of = &Of<&Filter::pressure_max_pa>,
     .weight = 1.0},
};

// ── how it combines: one piece in every source ──
const optimizer::FamilySpec kSpec{
    .family = kFilter,
    .name = "filter",
    .fields = kFields,
    .size = [](const model::Parts&) { return Filters().size(); },
    .basics = [](const model::Parts&, int part) -> const model::PartBasics& {
      return Filters()[part].basics;
    },
    .place = 9,
    .in_source = {true, true, true, true}};

using namespace optimizer::corner_table;

constexpr std::tuple kRows{
    Mates{&FilterCorner::threads},
    Flow{optimizer::FieldNamed(kFields, "sonic_conductance_dm3_per_s_bar"), &FilterCorner::flow},
    Best{optimizer::FieldNamed(kFields, "pressure_max_kpa_gauge"), &FilterCorner::pressure_max_pa}};

}  // namespace

std::vector<Filter>& Filters() {
  static std::vector<Filter> filters;
  return filters;
}

Filter ToFilter(const catalog::Part& row, const model::Ambient& ambient) {
  Filter filter{{row.id, row.numbers.at("mass_kg").value,
                 api::M3FromMl(row.numbers.at("body_volume_ml").value), std::nullopt},
                row.texts.at("thread").value,
                api::ElementOf(row, "sonic_conductance_dm3_per_s_bar", "critical_ratio"),
                api::PaFromKpaGauge(row.numbers.at("pressure_max_kpa_gauge").value, ambient)};
  if (row.numbers.contains("price_eur")) filter.basics.cost_eur = row.numbers.at("price_eur").value;
  return filter;
}

void Widen(FilterCorner& a, const FilterCorner& b) { WidenBy(kRows, a, b); }
std::array<double, 3> SplitKeys(const FilterCorner& c) {
  return KeysBy<KeyCountOf(kRows)>(kRows, c);
}
optimizer::Kinds MatingClass(const FilterCorner& c) { return c.threads; }
void SetNumbers(const optimizer::PartNumbers& numbers, FilterCorner& corner) {
  SetNumbersBy(kRows, numbers, corner);
}

}  // namespace plenum::test

// ── the two lists, with one line more ──
std::span<const plenum::catalog::Family> plenum::catalog::Families() {
  static const std::vector<Family> families = [] {
    std::vector<Family> all = OwnFamilies();
    all.push_back(test::CatalogueTable());
    return all;
  }();
  return families;
}

std::span<const plenum::optimizer::FamilySpec> plenum::optimizer::Families() {
  static const std::vector<FamilySpec> families = [] {
    std::vector<FamilySpec> all = OwnFamilies();
    all.push_back(test::kSpec);
    return all;
  }();
  return families;
}
