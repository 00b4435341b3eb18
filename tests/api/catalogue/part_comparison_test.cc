#include "api/catalogue/part_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/api/support.h"
#include "tests/catalog/samples.h"

namespace plenum::api {
namespace part_comparison_test {

using testing::ElementsAre;
using testing::HasSubstr;

Json FieldOf(const Json& comparison, const std::string& name) {
  for (const Json& field : comparison["fields"])
    if (field["field"] == name) return field;
  return nullptr;
}

TEST(PartComparison, ShowsEachFieldOnceAndMarksWhatDiffers) {
  auto one = catalog::Reservoir("a"), other = catalog::Reservoir("b");
  other.numbers["mass_kg"] = {0.3, catalog::Provenance::kEstimated, "rule"};
  other.numbers["price_eur"] = {12.0, catalog::Provenance::kDatasheet, "list"};
  one.part_number = other.part_number;
  const Json comparison = RenderComparison({one, other});
  EXPECT_EQ(comparison["parts"].size(), 2u);
  EXPECT_EQ(FieldOf(comparison, "mass_kg"),
            Parse(R"({"field": "mass_kg", "differs": true, "values": [0.2, 0.3],
                      "provenance": ["datasheet", "estimated"]})"));
  EXPECT_EQ(FieldOf(comparison, "body_volume_ml")["differs"], false);
  EXPECT_EQ(FieldOf(comparison, "price_eur"),
            Parse(R"({"field": "price_eur", "differs": true, "values": [null, 12.0],
                      "provenance": [null, "datasheet"]})"));
  EXPECT_EQ(FieldOf(comparison, "part_number")["differs"], false);
  EXPECT_EQ(FieldOf(comparison, "port"), nullptr);  // neither has it
  EXPECT_EQ(FieldOf(comparison, "series"), nullptr);
}

TEST(PartComparison, TakesPartsOfDifferentFamilies) {
  const Json comparison = RenderComparison({PartOf("compressor"), PartOf("battery")});
  EXPECT_EQ(FieldOf(comparison, "family")["values"], Parse(R"(["compressor", "battery"])"));
  EXPECT_EQ(FieldOf(comparison, "curve")["values"][1], nullptr);
  EXPECT_TRUE(FieldOf(comparison, "curve")["values"][0].is_array());
  EXPECT_FALSE(FieldOf(comparison, "curve")["provenance"][0].is_null());
  int masses = 0;
  for (const Json& field : comparison["fields"]) masses += field["field"] == "mass_kg";
  EXPECT_EQ(masses, 1);
}

TEST(PartComparison, TakesTwoToEightDifferentParts) {
  EXPECT_THAT(SplitIds("a,b,,c"), ElementsAre("a", "b", "", "c"));
  EXPECT_THAT(SplitIds(""), ElementsAre());
  EXPECT_TRUE(CheckCompared({"a", "b"}).empty());
  EXPECT_TRUE(CheckCompared(SplitIds("a,b,c,d,e,f,g,h")).empty());
  EXPECT_THAT(DetailAt(CheckCompared({"a"}), "/ids"), HasSubstr("2 to 8 parts, not 1"));
  EXPECT_THAT(DetailAt(CheckCompared(SplitIds("a,b,c,d,e,f,g,h,i")), "/ids"), HasSubstr("not 9"));
  EXPECT_THAT(DetailAt(CheckCompared({"a", "b", "a"}), "/ids"), HasSubstr("\"a\" more than once"));
}

}  // namespace part_comparison_test
}  // namespace plenum::api
