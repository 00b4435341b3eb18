#include "catalog/fields/price.h"

#include "catalog/fields/csv_table.h"
#include "catalog/fields/fields.h"
#include "catalog/fields/rates_csv.h"
#include "catalog/units/text.h"

namespace plenum::catalog {
namespace {

constexpr std::string_view kEuro = "EUR";

std::vector<Rate> ReadRates() {
  std::vector<Rate> rates;
  for (const CsvRow& row : ParseTable(RatesCsv()).rows)
    if (const auto units = ParseNumber(row.at(2)))  // none in the header
      rates.push_back({row[0], row[1], *units});
  return rates;
}

// The rate of a currency that UnitsPerEuro() gives. Dates compare as texts: "2024" comes before
// "2024-05", which comes before "2024-05-31".
const Rate* RateOf(std::string_view currency, std::string_view date) {
  const Rate* found = nullptr;
  for (const Rate& rate : Rates())
    if (rate.currency == currency && (!found || date.empty() || rate.date <= date)) found = &rate;
  return found;
}

std::optional<double> EuroAPiece(const Offer& offer) {
  const auto units = UnitsPerEuro(offer.currency, offer.date);
  if (!units || !(offer.price >= 0) || !(offer.pack > 0)) return std::nullopt;
  return offer.price / (*units * offer.pack);
}

// Empty where parts of the family have no price.
std::string PriceField(const std::string& family_name) {
  if (const Family* family = FindFamily(family_name))
    for (const NumberField& field : family->numbers)
      if (field.name.starts_with("price_eur")) return std::string(field.name);
  return {};
}

std::string SourceOf(const Offer& offer) {
  std::string source = "offer of " + offer.supplier;
  if (!offer.date.empty()) source += ", " + offer.date;
  source += ": " + FormatNumber(offer.price) + " " + offer.currency;
  if (offer.pack != 1.0) source += " for " + FormatNumber(offer.pack);
  if (const Rate* rate = RateOf(offer.currency, offer.date))
    source +=
        ", " + FormatNumber(rate->units_per_eur) + " " + offer.currency + "/EUR of " + rate->date;
  return source;
}

}  // namespace

const std::vector<Rate>& Rates() {
  static const std::vector<Rate> rates = ReadRates();
  return rates;
}

std::vector<std::string_view> Currencies() {
  std::vector<std::string_view> currencies{kEuro};
  for (const Rate& rate : Rates())
    if (currencies.back() != rate.currency) currencies.push_back(rate.currency);
  return currencies;
}

std::optional<double> UnitsPerEuro(std::string_view currency, std::string_view date) {
  if (currency == kEuro) return 1.0;
  const Rate* rate = RateOf(currency, date);
  return rate != nullptr ? std::optional(rate->units_per_eur) : std::nullopt;
}

const Offer* NewestOffer(const std::vector<Offer>& offers) {
  const Offer* newest = nullptr;
  for (const Offer& offer : offers) {
    const auto price = EuroAPiece(offer);
    if (!price) continue;
    if (newest == nullptr || offer.date > newest->date ||
        (offer.date == newest->date && *price < *EuroAPiece(*newest)))
      newest = &offer;
  }
  return newest;
}

void DerivePrice(Part& part) {
  const Offer* offer = NewestOffer(part.offers);
  const std::string field = PriceField(part.family);
  if (offer == nullptr || field.empty()) return;
  part.numbers[field] = {*EuroAPiece(*offer), Provenance::kDerived, SourceOf(*offer)};
}

double PackOf(const Part& part) {
  const Offer* offer = NewestOffer(part.offers);
  return offer == nullptr || offer->pack == 1.0 ? 0.0 : offer->pack;
}

void MakeFree(Part& part) {
  part.offers.clear();
  const std::string field = PriceField(part.family);
  if (!field.empty()) part.numbers[field] = {0.0, Provenance::kDerived, "at hand"};
}

}  // namespace plenum::catalog
