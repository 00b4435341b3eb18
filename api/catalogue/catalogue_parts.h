// Rows of the catalogue as the model's parts: SI, absolute pressures (gauge ratings on top of the
// ambient pressure of the requirements).
#ifndef PLENUM_API_CATALOGUE_CATALOGUE_PARTS_H_
#define PLENUM_API_CATALOGUE_CATALOGUE_PARTS_H_

#include <optional>
#include <string_view>
#include <vector>

#include "catalog/fields/part.h"
#include "model/flow/parts.h"
#include "model/physics/air.h"

namespace plenum::api {

// `rows` have passed catalog::Validate (a required field that is missing throws std::out_of_range).
// Optional numbers that are missing: price → not known; a regulator's flow limit → +∞; the water
// volume of a CO2 bottle → 0 (not known). Check valves are among them whose mass, volume,
// conductance, cracking pressure and pressure are known.
model::Parts ToModelParts(const std::vector<catalog::Part>& rows, const model::Ambient& ambient);

// Whether a part is a manifold that joins any lines (optimizer/problem/joints.h): it has two
// stations or more, is no base for valves of one series, and mass, volume, conductance and pressure
// are known.
bool IsJoint(const catalog::Part& row);

// Whether a part serves under vacuum: tubes that are no soft silicone and reservoirs that are no
// PET bottles, which a pressure from outside flattens, and valves that say so (`vacuum_rated`) or,
// where they do not say, switch without pressure at their inlet (direct-acting ones). A vacuum pump
// must have mass, volume and curve.
bool StandsVacuum(const catalog::Part& row);

// The same parts for evacuated actuators: those that stand vacuum, vacuum pumps in place of all
// other sources, all pressures mirrored (model/physics/chamber.h).
model::Parts ToVacuumParts(const std::vector<catalog::Part>& rows, const model::Ambient& ambient);

// The functions of a valve in the catalogue: "3/2", "2/2 pair", "proportional", "2/2".
model::ValveKind ValveKindFromFunction(std::string_view function);

// C and b of a row, in SI; the names of the two fields differ between families.
model::FlowElement ElementOf(const catalog::Part& row, const char* conductance, const char* ratio);

// What a field or curve ("free_air", "current") of a family does for the search, in words; none:
// the search does not look at it, it is kept for the reader.
std::optional<std::string_view> UseInSearch(std::string_view family, std::string_view field);
// Whether it is flow data: conductances, critical ratios, a tube's bore, a pump's delivery.
bool IsFlowData(std::string_view family, std::string_view field);

}  // namespace plenum::api

#endif  // PLENUM_API_CATALOGUE_CATALOGUE_PARTS_H_
