// What a request allows of the catalogue: "require" and "exclude", and whether each allowed
// configuration still finds a part of every family that it needs.
#ifndef PLENUM_API_DESIGN_READ_SELECTION_H_
#define PLENUM_API_DESIGN_READ_SELECTION_H_

#include <vector>

#include "api/json/reader.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/family_specs.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

inline constexpr const char* kCustomReservoir = "custom";

// Whether it is a product where products alone are asked for, or a class of products that may join
// what none does (optimizer/problem/joints.h).
bool SuitsOrder(const optimizer::Problem& problem, const catalog::Part& part);
// Whether the wall has the pressure at which an ejector's numbers hold; true of other parts.
bool HasItsPressure(const optimizer::Problem& problem, const catalog::Part& part);
// Whether `require` and `exclude` leave the part; of a row of the catalogue also `supply.parts`.
bool IsAllowed(const optimizer::Problem& problem, optimizer::Family family, const std::string& id);
bool IsAllowed(const optimizer::Problem& problem, optimizer::Family family,
               const catalog::Part& part);

// Reads "require", "exclude" and "own" into the problem; ids must exist in `parts`, and required
// ones belong to their family.
void ReadSelection(Reader& request, const std::vector<catalog::Part>& parts,
                   optimizer::Problem& problem);

// The row as the problem counts it: a part at hand costs nothing.
catalog::Part AsCounted(catalog::Part part, const optimizer::Problem& problem);

// The parts that the problem leaves, as it counts them; by family, else in their order.
std::vector<catalog::Part> AllowedParts(const std::vector<catalog::Part>& parts,
                                        const optimizer::Problem& problem);

// Whether a design of the problem may have parts of a family: vacuum pumps only evacuate, and what
// evacuates has no other source.
bool MayUse(const optimizer::Problem& problem, const optimizer::FamilySpec& spec);

// Rows as the search of this problem sees them: as they are, or for evacuated actuators.
model::Parts ModelPartsFor(const optimizer::Problem& problem,
                           const std::vector<catalog::Part>& rows);

// These as the search takes them, with the power that the problem has.
model::Parts AllowedModelParts(const std::vector<catalog::Part>& parts,
                               const optimizer::Problem& problem);

// Records an error for each empty family if that leaves no allowed configuration: at
// /require/<family> or /exclude where the request emptied it, at "" where the catalogue has none.
// `needs_fittings`: some line has any.
void CheckFamilies(const std::vector<catalog::Part>& parts, const optimizer::Problem& problem,
                   bool needs_fittings, Errors& errors);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SELECTION_H_
