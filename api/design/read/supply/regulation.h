// One regulator for all groups, or one for each (optimizer/problem/own_regulators.h): what a
// request asks for, and whether a given design is one or the other.
#ifndef PLENUM_API_DESIGN_READ_SUPPLY_REGULATION_H_
#define PLENUM_API_DESIGN_READ_SUPPLY_REGULATION_H_

#include <functional>
#include <string>

#include "api/json/reader.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// `regulation` of the supply.
void ReadRegulation(Reader& supply, optimizer::Problem& problem);

// Names the configurations whose groups have no regulators of their own though they are asked for.
void WarnOfRegulation(const optimizer::Problem& problem);

// ", unless …" of a regulator that is one group's; empty of other families.
std::string UnlessOwn(optimizer::Family family);

// Whether each group of the design has its own: the request wants that, or lets it and a row of the
// design is one group's.
bool HaveOwnRegulators(const optimizer::Design& design, const optimizer::Problem& problem);

// Missing rows, and pressures of groups that are missing or too many.
void CheckRegulation(const optimizer::Design& design, const optimizer::Problem& problem,
                     const std::function<void(const char* place, std::string detail)>& fail);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_SUPPLY_REGULATION_H_
