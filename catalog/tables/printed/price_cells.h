// Prices, packs and dates as the cells of a price list write them.
#ifndef PLENUM_CATALOG_TABLES_PRINTED_PRICE_CELLS_H_
#define PLENUM_CATALOG_TABLES_PRINTED_PRICE_CELLS_H_

#include <optional>
#include <string>
#include <string_view>

#include "catalog/tables/decimal.h"

namespace plenum::catalog {

// The code of a currency that can be converted (catalog/fields/price.h), by code or sign: "usd",
// "€", "$" (the US dollar; others are written C$, A$, CAD …), "Fr."; empty: not known, or one of
// several ("¥"). "/m" behind it does not matter.
std::string CurrencyOf(std::string_view text);

// "$19.99", "19.99 USD", "EUR 12,50", "1.250,00 €": the number and its currency, which may be
// missing.
struct Money {
  CellNumber number;     // without digits: the cell holds no price
  std::string currency;  // a code, or what stood there and is none
};
Money MoneyOf(std::string_view cell);

// "10", "10 pcs", "Pack of 10", "VE 10"; none: not a number of pieces.
std::optional<std::string> PackOf(std::string_view cell);

struct DateRead {
  std::string date;   // 2024-05-31, 2024-05 or 2024
  std::string error;  // in words
};
// ISO dates, 31.05.2024, 31 May 2024 and, where only one of them can be the month, 5/31/2024.
DateRead DateOf(std::string_view cell);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_PRINTED_PRICE_CELLS_H_
