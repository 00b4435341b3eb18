// Parts at the worst of their tolerances: what a guarantee is proved with.
#ifndef PLENUM_API_DESIGN_READ_WORST_PARTS_H_
#define PLENUM_API_DESIGN_READ_WORST_PARTS_H_

#include <functional>
#include <string_view>
#include <vector>

#include "api/design/read/tolerance.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Where in its tolerance a number does a design most harm.
enum class Worst {
  kLow,       // more is better
  kHigh,      // less is better
  kBothEnds,  // both ends count: the part carries a spread
  kSum,       // mass and outer volume, which rank as printed: limits hold with a slack
  kExact      // counts, diameters, nominal voltages, prices; what no search looks at
};
// Of a number or curve ("free_air", "current") of a family. The search's own order of parts says
// it (optimizer/problem/part_tables.h): a part that is no worse in any of these numbers never makes
// a design worse, so that a design that meets its requirements with all numbers at their worst
// meets them with all numbers within.
Worst WorstOf(std::string_view family, std::string_view field);

// Whether a number, or a curve, is known exactly, whatever its provenance.
using Settled = std::function<bool(const catalog::Part& row, std::string_view field)>;

// Half-width, as a share, of a number of the row; 0 where it is exact or settled.
double HalfWidth(const catalog::Part& row, std::string_view field, const Tolerance& tolerance,
                 const Settled& settled = {});

// The rows, allowed in the problem, as parts at the worst of their tolerances. What ranks is as
// printed: mass, outer volume and price, the gas of a full bottle included.
model::Parts ToWorstParts(const optimizer::Problem& problem, const std::vector<catalog::Part>& rows,
                          const Tolerance& tolerance, const Settled& settled = {});

// The row with each number at one end of its tolerance or the other, by a hash of part, number and
// `corner`; with every second corner at its worst end three times of four.
catalog::Part AtCorner(catalog::Part row, const Tolerance& tolerance, int corner);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_WORST_PARTS_H_
