#include "api/catalogue/part_facets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "api/catalogue/part_query.h"
#include "tests/api/support.h"
#include "tests/catalog/samples.h"

namespace plenum::api {
namespace part_facets_test {

Json FacetsOfAll(const std::vector<catalog::Part>& parts) {
  std::vector<std::uint32_t> rows(parts.size());
  std::iota(rows.begin(), rows.end(), 0u);
  return RenderFacets(rows, PartTable(parts));
}

std::vector<catalog::Part> WithMasses(const std::vector<double>& masses) {
  std::vector<catalog::Part> parts;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    parts.push_back(catalog::Reservoir("r" + std::to_string(1000 + i)));
    parts.back().numbers["mass_kg"].value = masses[i];
  }
  return parts;
}

TEST(PartFacets, RangesAreEquallyWide) {
  const Json mass = FacetsOfAll(WithMasses({1.0, 1.1, 2.0, 4.9, 11.0}))["numbers"]["mass_kg"];
  EXPECT_EQ(mass, Parse(R"({"count": 5, "min": 1.0, "max": 11.0, "ranges": [
    {"count": 2, "min": 1.0, "max": 1.1}, {"count": 1, "min": 2.0, "max": 2.0},
    {"count": 1, "min": 4.9, "max": 4.9}, {"count": 1, "min": 11.0, "max": 11.0}]})"));
}

TEST(PartFacets, RangesOfWideSpreadsAreLogarithmic) {
  const Json mass = FacetsOfAll(WithMasses({0.001, 0.0015, 0.003, 0.9, 1.0}))["numbers"]["mass_kg"];
  ASSERT_EQ(mass["ranges"].size(), 3u);  // edges at 0.002, 0.004, … 0.5
  EXPECT_EQ(mass["ranges"][0], Parse(R"({"count": 2, "min": 0.001, "max": 0.0015})"));
  EXPECT_EQ(mass["ranges"][1], Parse(R"({"count": 1, "min": 0.003, "max": 0.003})"));
  EXPECT_EQ(mass["ranges"][2]["count"], 2);
}

TEST(PartFacets, EachRangeFindsItsPartsAndNoOther) {
  std::mt19937 random(4);
  std::vector<catalog::Part> parts;
  for (int i = 1000; i < 1200; ++i)
    parts.push_back(catalog::AnyPart(catalog::Families()[i % catalog::Families().size()],
                                     "p" + std::to_string(i), random));
  const PartTable table(parts);
  const Json facets = FacetsOfAll(parts);
  ASSERT_GT(facets["numbers"].size(), 20u);
  for (const auto& [field, spread] : facets["numbers"].items()) {
    int all = 0;
    for (const Json& range : spread["ranges"]) {
      PartQuery query;
      query.numbers[field] = {range["min"], range["max"]};
      EXPECT_EQ(Select(query, table).size(), range["count"]) << field;
      all += range["count"].get<int>();
    }
    EXPECT_EQ(all, spread["count"]) << field;
    EXPECT_LE(spread["ranges"].size(), 10u);
  }
}

TEST(PartFacets, CountsPricesDocumentsAndProvenance) {
  auto parts = WithMasses({1.0, 2.0, 3.0, 4.0});  // four numbers each
  parts[1].numbers["price_eur"] = {5.0, catalog::Provenance::kThirdParty, "shop"};
  parts[2].documents = {{"https://maker.example", ""}};
  for (auto& [field, number] : parts[3].numbers)
    number.provenance = catalog::Provenance::kEstimated;
  const Json facets = FacetsOfAll(parts);
  EXPECT_EQ(facets["texts"]["priced"], Parse(R"({"false": 3, "true": 1})"));
  EXPECT_EQ(facets["texts"]["documented"], Parse(R"({"false": 3, "true": 1})"));
  EXPECT_EQ(
      facets["numbers"]["estimated_share"]["ranges"],
      Parse(R"([{"count": 3, "min": 0.0, "max": 0.0}, {"count": 1, "min": 1.0, "max": 1.0}])"));
  EXPECT_EQ(facets["numbers"]["third_party_share"]["max"], 0.2);
}

TEST(PartFacets, OfManyValuesShowsThoseThatMostPartsHave) {
  auto parts = WithMasses(std::vector<double>(kFacetValuesMax + 6, 1.0));
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].series = i < 3 ? "zz common" : "s" + std::to_string(10'000 + i);
  const Json facets = FacetsOfAll(parts);
  EXPECT_EQ(facets["texts"]["series"].size(), kFacetValuesMax);
  EXPECT_EQ(facets["texts"]["series"]["zz common"], 3);
  EXPECT_EQ(facets["more"], Parse(R"({"series": 4})"));
}

}  // namespace part_facets_test
}  // namespace plenum::api
