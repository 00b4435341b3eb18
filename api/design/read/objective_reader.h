// What a request minimises.
#ifndef PLENUM_API_DESIGN_READ_OBJECTIVE_READER_H_
#define PLENUM_API_DESIGN_READ_OBJECTIVE_READER_H_

#include <vector>

#include "api/json/reader.h"
#include "optimizer/problem/amount.h"
#include "optimizer/problem/problem.h"

namespace plenum::api {

// "objective": weights, mass by default, and the amounts of a front, which orders its designs by
// the first of them unless the weights say otherwise.
void ReadObjective(Reader& request, optimizer::Objective& objective,
                   std::vector<optimizer::Amount>& pareto);

}  // namespace plenum::api

#endif  // PLENUM_API_DESIGN_READ_OBJECTIVE_READER_H_
