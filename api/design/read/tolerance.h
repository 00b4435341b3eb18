// Part numbers within the tolerance that their provenance deserves.
#ifndef PLENUM_API_DESIGN_READ_TOLERANCE_H_
#define PLENUM_API_DESIGN_READ_TOLERANCE_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "api/json/reader.h"
#include "catalog/fields/half_width.h"
#include "catalog/fields/part.h"
#include "optimizer/explain/robust.h"

namespace plenum::api {

using catalog::Tolerance;

// "tolerance" of "robust" and "guarantee".
Tolerance ReadTolerance(Reader& request);
Json RenderTolerance(const Tolerance& tolerance);

// What says which parts go together, and what is counted or cut: counts, diameters, nominal
// voltages.
bool IsExact(std::string_view field);
// The number within what the catalogue takes for this field.
double WithinRange(const catalog::Part& row, std::string_view field, double value);

// A number uniform in [1 − half_width, 1 + half_width] that depends on nothing but its arguments:
// the same part has the same error wherever it is used. (Uniform is what GUM 4.3.7 asks where only
// limits are known.)
double Factor(std::uint64_t seed, int draw, const std::string& id, const std::string& field,
              double half_width);

// The row with each number that is not exact times its factor, kept within the field's range; a
// pump's delivery and current have one factor each for the whole curve.
catalog::Part Perturbed(catalog::Part row, const Tolerance& tolerance, std::uint64_t seed,
                        int draw);

// Rows of a draw.
using PerturbRow = std::function<catalog::Part(catalog::Part row, int draw)>;

// The parts of a design's rows as `perturb` has them; `rows` must outlive it. A made-to-measure
// reservoir becomes a part of the volume that the design gave it, as exact as a data sheet, with
// the estimated mass and outer volume of its rule. A part that no row has is in no draw.
optimizer::DrawParts MakeDraws(const std::vector<catalog::Part>& rows,
                               const optimizer::Problem& problem, PerturbRow perturb);
// The same of Perturbed rows.
optimizer::DrawParts MakeDraws(const std::vector<catalog::Part>& rows,
                               const optimizer::Problem& problem, const Tolerance& tolerance,
                               std::uint64_t seed);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_TOLERANCE_H_
