// Numbers of a part that were read from a scale or another instrument, as the answer that a
// revision of the part is made of (part_revision.h).
#ifndef PLENUM_API_PROTOCOL_READ_BY_HAND_H_
#define PLENUM_API_PROTOCOL_READ_BY_HAND_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"

namespace plenum::api {

inline constexpr double kLeastReadShare = 1e-5, kMostReadShare = 0.25;

// `readings` are "FIELD=VALUE", the value in the field's unit or with another: "mass_kg=25.3 g".
// `uncertainty` is relative, one standard deviation, of all: "0.005" or "0.5 %". `note` says how it
// was read; may be empty.
Parsed<Json> ReadByHandAnswer(const catalog::Part& part, const std::vector<std::string>& readings,
                              const std::string& uncertainty, const std::string& note);

}  // namespace plenum::api

#endif  // PLENUM_API_PROTOCOL_READ_BY_HAND_H_
