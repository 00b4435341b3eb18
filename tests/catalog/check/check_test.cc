#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "catalog/check/coverage.h"
#include "catalog/check/duplicates.h"
#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace check_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Part Named(const std::string& id, const std::string& maker, const std::string& number) {
  Part part = Reservoir(id);
  part.manufacturer = maker;
  part.part_number = number;
  return part;
}

TEST(Duplicates, OfOneMakerUpToCaseAndSeparators) {
  const std::vector<Part> parts = {Named("a", "SMC", "VBAT-05A1"),
                                   Named("b", "SMC Corporation", "vbat05 a1"),
                                   Named("c", "Festo", "VBAT-05A2"), Named("d", "SMC", "VBAT-05A")};
  EXPECT_THAT(FindDuplicates(parts),
              ElementsAre(Duplicates{"reservoir", "same maker and part number", {"a", "b"}}));
}

TEST(Duplicates, ByAliases) {
  std::vector<Part> parts = {Named("a", "Festo", "CRVZS-2"), Named("b", "Festo", "160235"),
                             Named("c", "Norgren", "160235")};
  parts[0].aliases = {"Festo 160 235", "tank of 2 L"};
  parts[0].numbers["mass_kg"].value = 0.3;  // so that c, of another maker, is another part
  parts[1].numbers["mass_kg"].value = 0.3;
  EXPECT_THAT(
      FindDuplicates(parts),
      ElementsAre(Duplicates{"reservoir", "a name of one is one of another's", {"a", "b"}}));
}

TEST(Duplicates, OfASellerThatNamesItselfTheMaker) {
  std::vector<Part> parts = {Named("a", "Festo", "CRVZS-2"), Named("b", "RS Components", "crvzs 2"),
                             Named("c", "Other", "CRVZS-2")};
  parts[2].numbers["mass_kg"].value = 7;
  EXPECT_THAT(FindDuplicates(parts),
              ElementsAre(Duplicates{
                  "reservoir", "same part number and numbers, another maker", {"a", "b"}}));
}

TEST(Duplicates, ShortNumbersOfOtherMakersAndOtherFamiliesAreNone) {
  std::vector<Part> parts = {Named("a", "Festo", "2"), Named("b", "SMC", "2"),
                             Named("c", "Festo", "12345"), Named("d", "SMC", "12345")};
  parts.push_back(Named("e", "Festo", "2"));
  parts.back().family = "silencer";
  EXPECT_THAT(FindDuplicates(parts), IsEmpty());
}

TEST(Coverage, CountsValuesByFamily) {
  std::vector<Part> parts = {Reservoir("a"), Reservoir("b")};
  parts[0].numbers["mass_kg"].provenance = Provenance::kEstimated;
  parts[0].numbers["price_eur"] = {3, Provenance::kDerived, ""};
  parts[1].documents = {{"https://example.org", ""}};
  parts[1].texts["material"] = {"steel", Provenance::kEstimated, ""};
  Coverage expected{"reservoir", 2, {"b"}, {"a"}, 10, 2};
  EXPECT_THAT(CoverageOf(parts), ElementsAre(expected));
}

}  // namespace check_test
}  // namespace plenum::catalog
