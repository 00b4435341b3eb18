// What the parts of a list hold, to filter it further.
#ifndef PLENUM_API_CATALOGUE_PART_FACETS_H_
#define PLENUM_API_CATALOGUE_PART_FACETS_H_

#include <cstdint>
#include <vector>

#include "api/catalogue/part_table.h"
#include "api/json/json.h"

namespace plenum::api {

// Values of a text field that are counted at most: those that most parts have.
inline constexpr std::size_t kFacetValuesMax = 1000;

// { "texts":   { field: { value: parts } },
//   "more":    { field: values that are left out },
//   "numbers": { field: { "count", "min", "max", "ranges": [ { "min", "max", "count" } ] } } }
// of fields that at least one part of the rows has. Ranges are up to ten, equally wide, on a
// logarithmic scale where the greatest number is 20 times the least or more; "min" and "max" of a
// range are numbers in it, so F_min and F_max of these values find its parts.
Json RenderFacets(const std::vector<std::uint32_t>& rows, const PartTable& table);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_FACETS_H_
