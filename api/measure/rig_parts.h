// Parts of the catalogue in the rig of a measurement: a document that names them becomes one that
// has their numbers, so that it can be read, diagnosed and kept without the catalogue.
//
//   line element  { "part", "measure"? }: a valve, fitting, regulator, check valve, manifold or
//                 silencer gets its pairs (C, b); tubing with "length_m" becomes a tube
//   "actuator"    { "part", "measure"? }: a reservoir gets its volume, rigid
//   "supply"      { "kind": "compressor", "part", "measure"? }: a pump gets its curve
// Numbers that stand there already are kept: they are what the rig declares.
#ifndef PLENUM_API_MEASURE_RIG_PARTS_H_
#define PLENUM_API_MEASURE_RIG_PARTS_H_

#include <string>
#include <string_view>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"

namespace plenum::api {

// Whether a rig of the document names a part.
bool NamesParts(const Json& measurement);

// With errors the document has the numbers of those parts that could be found.
Json WithParts(Json measurement, const std::vector<catalog::Part>& parts, Errors& errors);

// The field of the part, or its curve "free_air", that a name of "measure" stands for.
std::string FieldOfMeasured(std::string_view name);

}  // namespace plenum::api

#endif  // PLENUM_API_MEASURE_RIG_PARTS_H_
