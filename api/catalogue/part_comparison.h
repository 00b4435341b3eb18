// Parts side by side.
#ifndef PLENUM_API_CATALOGUE_PART_COMPARISON_H_
#define PLENUM_API_CATALOGUE_PART_COMPARISON_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"

namespace plenum::api {

inline constexpr std::size_t kComparedMin = 2, kComparedMax = 8;

// The ids between commas; no part's id holds one.
std::vector<std::string> SplitIds(std::string_view listed);

// What is wrong with the ids of a comparison, pointing to "/ids": too few, too many, one twice.
Errors CheckCompared(const std::vector<std::string>& ids);

// { "parts":  [ part, … ],
//   "fields": [ { "field", "differs", "values": [ value or null, one a part ],
//                 "provenance": [ kind or null, one a part ] } ] }
// of the fields that at least one part has, in the order of the families' fields. A field differs
// where not all parts have the same value. `curve` has the points as its values.
Json RenderComparison(const std::vector<catalog::Part>& parts);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_PART_COMPARISON_H_
