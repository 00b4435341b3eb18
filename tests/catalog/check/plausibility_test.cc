#include "catalog/check/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace plausibility_test {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Reservoirs of 0.1 kg · 2^i for i in 0…n-1, all of one density.
std::vector<Part> Doubling(int n) {
  std::vector<Part> parts;
  for (int i = 0; i < n; ++i) {
    Part part = Reservoir("r" + std::to_string(i));
    part.numbers["mass_kg"].value = 0.1 * std::pow(2, i);
    part.numbers["body_volume_ml"].value = 300 * std::pow(2, i);
    parts.push_back(part);
  }
  return parts;
}

TEST(Plausibility, AnEvenSpreadHasNoOutliers) {
  EXPECT_THAT(FindOutliers(Doubling(11)), IsEmpty());
}

TEST(Plausibility, FindsGramsTakenForKilograms) {
  std::vector<Part> parts = Doubling(11);
  parts[5].numbers["mass_kg"].value *= 1000;  // 3200 kg among 0.1 … 102.4 kg
  // By hand: logs of the other ten are ln 0.1 + {0 … 4, 6 … 10} ln 2 and this one lies above all.
  // Median of eleven: ln 0.1 + 6 ln 2. Deviations in ln 2: 6 5 4 3 2 0 1 2 3 4 and 8.97; median 3.
  const std::vector<Outlier> outliers = FindOutliers(parts);
  ASSERT_EQ(outliers.size(), 1u);  // by density only: the masses themselves spread over decades
  EXPECT_EQ(outliers[0].id, "r5");
  EXPECT_EQ(outliers[0].field, "mass_kg / body_volume_ml");
  EXPECT_NEAR(outliers[0].robust_z, std::log(1000) / std::log(1.5), 1e-9);  // the floor
  parts[5].numbers["mass_kg"].value *= 1000;
  const std::vector<Outlier> both = FindOutliers(parts);
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[0].field, "mass_kg");
  EXPECT_NEAR(both[0].median, 0.1 * 64, 1e-12);
  EXPECT_NEAR(both[0].robust_z, (std::log(3.2e6) - std::log(6.4)) / (1.4826 * 3 * std::log(2)),
              1e-9);
}

TEST(Plausibility, ANumberThatAnotherMakerHasIsNotOdd) {
  std::vector<Part> parts = Doubling(11);
  for (Part& part : parts) part.numbers["price_eur"] = {10, Provenance::kDatasheet, ""};
  const auto price = [&](int i, double eur) { parts[i].numbers["price_eur"].value = eur; };
  price(2, 1000), price(3, 1400);
  EXPECT_EQ(FindOutliers(parts).size(), 2u);  // both of one maker
  parts[3].manufacturer = "Another";
  EXPECT_THAT(FindOutliers(parts), IsEmpty());
  price(3, 1600);  // more than a factor 1.5 apart
  EXPECT_EQ(FindOutliers(parts).size(), 2u);
}

TEST(Plausibility, JudgesNeitherZerosNorSmallFamilies) {
  std::vector<Part> few = Doubling(7);
  few[0].numbers["mass_kg"].value = 1e-6;
  EXPECT_THAT(FindOutliers(few), IsEmpty());
  std::vector<Part> parts = Doubling(11);
  for (Part& part : parts) part.numbers["price_eur"] = {10, Provenance::kDatasheet, ""};
  parts[3].numbers["price_eur"].value = 0;
  EXPECT_THAT(FindOutliers(parts), IsEmpty());
  parts[3].numbers["price_eur"].value = 40;  // all others agree; below the floor
  EXPECT_THAT(FindOutliers(parts), IsEmpty());
  parts[3].numbers["price_eur"].value = 42;  // ln 4.2 / ln 1.5 = 3.54
  EXPECT_EQ(FindOutliers(parts).size(), 1u);
}

TEST(Plausibility, NamesPartsWithoutAPrice) {
  std::vector<Part> parts = Doubling(3);
  parts[1].numbers["price_eur"] = {10, Provenance::kDatasheet, ""};
  EXPECT_THAT(FindGaps(parts),
              ElementsAre(Gap{"reservoir", "price_eur", "cost_eur", {"r0", "r2"}, 3}));
  for (Part& part : parts) part.numbers["price_eur"] = {10, Provenance::kDatasheet, ""};
  EXPECT_THAT(FindGaps(parts), IsEmpty());
}

}  // namespace plausibility_test
}  // namespace plenum::catalog
