// Aliases, offers and documents of a part as cells of a table: JSON text, empty where there are
// none.
//
//   aliases    ["V114","V100"]
//   offers     [{"supplier":"Shop","price":12.5,"currency":"EUR","pack":10,"date":"2024-05-31",
//                "link":"https://example.org/v114"}]        pack 1, date and link empty if left out
//   documents  [{"link":"https://example.org/v114.pdf","sha256":"e3b0…"}]
#ifndef PLENUM_CATALOG_FIELDS_PART_LISTS_H_
#define PLENUM_CATALOG_FIELDS_PART_LISTS_H_

#include <string>
#include <string_view>

#include "catalog/fields/part.h"

namespace plenum::catalog {

std::string FormatAliases(const Part& part);
std::string FormatOffers(const Part& part);
std::string FormatDocuments(const Part& part);

// Reads a cell that is not empty into the part; what is wrong with it, or an empty text.
std::string ReadAliases(std::string_view cell, Part& part);
std::string ReadOffers(std::string_view cell, Part& part);
std::string ReadDocuments(std::string_view cell, Part& part);

}  // namespace plenum::catalog

#endif  // PLENUM_CATALOG_FIELDS_PART_LISTS_H_
