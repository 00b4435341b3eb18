// The price of a piece in euro, derived from what suppliers ask.
#ifndef PLENUM_CATALOG_FIELDS_PRICE_H_
#define PLENUM_CATALOG_FIELDS_PRICE_H_

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"

namespace plenum::catalog {

// A row of catalog/data/rates.csv.
struct Rate {
  std::string currency;
  std::string date;  // like that of an offer; the rate holds until the next row of its currency
  double units_per_eur = 1.0;
};

// In order of currency and date; the euro itself is not listed.
const std::vector<Rate>& Rates();

// Currencies that can be converted, EUR first.
std::vector<std::string_view> Currencies();

// The newest rate of `currency` that is not newer than `date`, else its oldest; of an empty date
// the newest. Units of the currency for one euro, > 0; none: the currency is not known.
std::optional<double> UnitsPerEuro(std::string_view currency, std::string_view date);

// The offer of the latest date; of several, the one with the cheapest piece. Offers whose currency
// is not known, whose price is not ≥ 0 or whose pack is not > 0 do not count; nullptr: there is
// none.
const Offer* NewestOffer(const std::vector<Offer>& offers);

// Makes the part's price that of its newest offer,
//
//   price_eur = price / (units per euro · pack),
//
// with provenance `derived`, whatever the price was; its source says which rate that is. For tubing
// the field is price_eur_per_m and `pack` counts metres. A part without an offer that counts keeps
// its price.
void DerivePrice(Part& part);

// How many pieces, of tubing metres, the newest offer sells together; 0: any number, as of a part
// that is sold by the piece, of a tube by the metre, or without an offer that counts.
double PackOf(const Part& part);

// Makes the part's price 0 and takes its offers out, as of one that is at hand.
void MakeFree(Part& part);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_PRICE_H_
