#include "catalog/fields/price.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/catalog/samples.h"

namespace plenum::catalog {
namespace price_test {

using ::testing::HasSubstr;

TEST(Price, EveryRateIsReadInOrderAndSane) {
  ASSERT_GE(Rates().size(), 14u);
  for (std::size_t i = 0; i < Rates().size(); ++i) {
    const Rate& rate = Rates()[i];
    EXPECT_GT(rate.units_per_eur, 0.1) << rate.currency;
    EXPECT_LT(rate.units_per_eur, 1000) << rate.currency;
    if (i == 0) continue;
    const Rate& last = Rates()[i - 1];
    EXPECT_LT(std::pair(last.currency, last.date), std::pair(rate.currency, rate.date));
  }
  EXPECT_EQ(Currencies().front(), "EUR");
}

// Of the rows of catalog/data/rates.csv for USD: 1.18 in 2018, 1.05 in 2022, 1.08 in 2023.
TEST(Price, ARateHoldsUntilTheNext) {
  EXPECT_EQ(UnitsPerEuro("EUR", "2001"), 1.0);
  EXPECT_EQ(UnitsPerEuro("USD", "2018"), 1.18);
  EXPECT_EQ(UnitsPerEuro("USD", "2022-12-31"), 1.05);
  EXPECT_EQ(UnitsPerEuro("USD", "2023-01"), 1.08);
  std::vector<double> dollars;
  for (const Rate& rate : Rates())
    if (rate.currency == "USD") dollars.push_back(rate.units_per_eur);
  EXPECT_EQ(UnitsPerEuro("USD", "2099"), dollars.back());
  EXPECT_EQ(UnitsPerEuro("USD", "1999"), dollars.front());  // before the first
  EXPECT_EQ(UnitsPerEuro("USD", ""), UnitsPerEuro("USD", "2099"));
  EXPECT_FALSE(UnitsPerEuro("XYZ", "2024"));
}

// Where the rate of the offer's year is not known the price says which it is; an offer without a
// date takes the newest.
TEST(Price, TheSourceNamesTheYearOfTheRate) {
  Part part = Reservoir("r");
  part.offers = {{"Shop", 1, "USD", 1, "2014-07", ""}};
  DerivePrice(part);
  EXPECT_EQ(part.numbers["price_eur"].source,
            "offer of Shop, 2014-07: 1 USD, 1.33 USD/EUR of 2013");
  part.offers = {{"Shop", 1, "USD", 1, "", ""}};
  DerivePrice(part);
  EXPECT_EQ(part.numbers["price_eur"].source, "offer of Shop: 1 USD, 1.17 USD/EUR of 2026");
}

TEST(Price, TheNewestOfferCounts) {
  EXPECT_EQ(NewestOffer({}), nullptr);
  const std::vector<Offer> offers = {{"no date", 1, "EUR", 1, "", ""},
                                     {"old", 2, "EUR", 1, "2023-12-31", ""},
                                     {"dear", 50, "EUR", 10, "2024-05", ""},
                                     {"cheap", 4.9, "EUR", 1, "2024-05", ""},
                                     {"foreign", 1, "XYZ", 1, "2025", ""}};
  EXPECT_EQ(NewestOffer(offers)->supplier, "cheap");
}

TEST(Price, IsThatOfAPiece) {
  Part part = Reservoir("r");
  part.numbers["price_eur"] = {99, Provenance::kDatasheet, "list"};
  DerivePrice(part);
  EXPECT_EQ(part.numbers["price_eur"].value, 99);  // without an offer it stays
  part.offers = {{"Shop", 21.6, "USD", 10, "2024-03-01", ""}};
  DerivePrice(part);
  const Number& price = part.numbers["price_eur"];
  EXPECT_DOUBLE_EQ(price.value, 2.0);
  EXPECT_EQ(price.provenance, Provenance::kDerived);
  EXPECT_EQ(price.source, "offer of Shop, 2024-03-01: 21.6 USD for 10, 1.08 USD/EUR of 2024");
  EXPECT_FALSE(price.uncertainty);
  const Part once = part;
  DerivePrice(part);
  EXPECT_EQ(part, once);
}

TEST(Price, OfTubingIsThatOfAMetre) {
  Part tube;
  tube.family = "tubing";
  tube.offers = {{"Shop", 30, "EUR", 20, "", ""}};
  DerivePrice(tube);
  EXPECT_EQ(tube.numbers.at("price_eur_per_m").value, 1.5);
  EXPECT_FALSE(tube.numbers.contains("price_eur"));
}

}  // namespace price_test
}  // namespace plenum::catalog
