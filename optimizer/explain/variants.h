// What else there is beside a list of kinds.
#ifndef PLENUM_OPTIMIZER_EXPLAIN_VARIANTS_H_
#define PLENUM_OPTIMIZER_EXPLAIN_VARIANTS_H_

#include "optimizer/problem/problem.h"

namespace plenum::optimizer {

// Of a list of kinds: gives each design its variants; and the answer the best design of each
// configuration, and of the parts that are products where SearchOptions::select can tell. All are
// searches of their own; `used_s` of the time limit are gone, and what it does not leave time for,
// or takes too many steps, is not complete.
void AddVariants(const Problem& problem, const SearchOptions& options, double used_s,
                 Answer& answer);
void AddBests(const Problem& problem, const SearchOptions& options, double used_s, Answer& answer);

}  // namespace plenum::optimizer

#endif  // PLENUM_OPTIMIZER_EXPLAIN_VARIANTS_H_
