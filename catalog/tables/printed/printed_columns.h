// Columns of price lists and data sheets that the catalogue keeps otherwise: sides and diameter of
// a body, free flow and current of a pump, C-rate and energy of a battery, price with its currency,
// pack, supplier and date.
#ifndef PLENUM_CATALOG_TABLES_PRINTED_PRINTED_COLUMNS_H_
#define PLENUM_CATALOG_TABLES_PRINTED_PRINTED_COLUMNS_H_

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "catalog/fields/fields.h"

namespace plenum::catalog {

struct PrintedColumn {
  NumberField field;       // name and meaning; its range does not matter
  std::string_view gives;  // the column of the catalogue that it goes into
  bool is_number = true;   // of numbers with a unit by its name
};

// Those of a family.
std::vector<const PrintedColumn*> PrintedColumns(const Family& family);
// Null: it is none of this family.
const PrintedColumn* FindPrinted(const Family& family, std::string_view name);

inline constexpr std::string_view kBodySize = "body_size_mm";          // 70 x 30 x 50
inline constexpr std::string_view kBodyCylinder = "body_cylinder_mm";  // 18.5 x 65: d x l
inline constexpr std::string_view kOfferPrice = "offer_price";
inline constexpr std::string_view kOfferCurrency = "offer_currency";

// What the printed cells of a row, by name, come to: the cells of the columns that they give, each
// a text that catalog/fields/row_reader.h reads. A column that cannot be made of what is there is
// empty.
std::string CellFromPrinted(std::string_view column,
                            const std::map<std::string, std::string, std::less<>>& printed);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_TABLES_PRINTED_PRINTED_COLUMNS_H_
