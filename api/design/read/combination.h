// Whether a given design is one of the combinations of the problem that it is given for. Nothing is
// assumed: what is missing, too much or does not fit is named.
#ifndef PLENUM_API_DESIGN_READ_COMBINATION_H_
#define PLENUM_API_DESIGN_READ_COMBINATION_H_

#include <string>
#include <vector>

#include "api/json/json.h"
#include "catalog/fields/part.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// Records an error below `pointer` for each rule that the design breaks:
// * the configuration is one of those asked for;
// * each row is a part of its family in `catalogue` that `require` and `exclude` leave, is needed
// by
//   the configuration, and stands there once for its group (valve, fitting, tubing) or for all;
// * each group has its tube in metres, its fittings and a valve channel for each actuator; the
//   source has a part of each family in a number that `limits` allow;
// * tube and fitting, fitting and valve, battery and pump, regulator and supply mate;
// * the reservoir's volume is that of the reservoir named, or one that can be made to measure.
void CheckCombination(const optimizer::Design& design, const optimizer::Problem& problem,
                      const std::vector<catalog::Part>& catalogue, const std::string& pointer,
                      Errors& errors);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_COMBINATION_H_
